#pragma once
// The files that a scene file includes.

#include <string>
#include <vector>

#include "engine/load/scene_format.h"

namespace aleph {

/// Appends the content of SceneSource::includes. A file that is included again in the same way shares its meshes,
/// unless they have skins or morph targets.
/// @param places   JSON pointer of each include, for messages
/// @param request  the scene file's own
/// @throws InputError
void load_includes(Scene& scene, const std::vector<std::string>& places, const LoadRequest& request);

}  // namespace aleph
