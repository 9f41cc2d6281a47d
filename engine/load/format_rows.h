#pragma once
// One function per row of scene_formats(), and what rows share; only this folder uses them.

#include <string_view>

#include "engine/load/scene_format.h"

namespace aleph {

SceneFormat scene_file_format();  ///< aleph's own
SceneFormat gltf_format();
SceneFormat glb_format();  ///< as gltf_format, in one binary file; is written too
SceneFormat alembic_format();

/// A scene file's text, with the files that it names. @throws InputError
Scene load_scene_file_text(std::string_view text, const LoadRequest& request);

/// Appends the content of SceneSource::includes. A file that is included again in the same way shares its meshes,
/// unless they have skins or morph targets.
/// @param places   JSON pointer of each include, for messages
/// @param request  the scene file's own
/// @throws InputError
void load_includes(Scene& scene, const std::vector<std::string>& places, const LoadRequest& request);

/// @throws InputError where the path leads to nothing, or to a folder or a device
void check_regular_file(const std::filesystem::path& path, const std::string& file, const std::string& place);

}  // namespace aleph
