#pragma once
// The files that a scene file includes.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/json/load_limits.h"
#include "engine/scene/scene.h"

namespace aleph {

/// Appends the content of Scene::includes. A file that is included again in the same way shares its meshes, unless they
/// have skins or morph targets.
/// @param places  JSON pointer of each include, for messages
/// @throws InputError
void load_includes(Scene& scene, const std::filesystem::path& folder, const std::vector<std::string>& places,
                   const LoadLimits& limits);

}  // namespace aleph
