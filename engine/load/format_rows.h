#pragma once
// One function per row of scene_formats(); only this folder uses them.

#include <string_view>

#include "engine/load/scene_format.h"

namespace aleph {

SceneFormat scene_file_format();  ///< aleph's own
SceneFormat gltf_format();
SceneFormat glb_format();  ///< as gltf_format, in one binary file; is written too
SceneFormat alembic_format();

/// A scene file's text, with the files that it names. @throws InputError
Scene load_scene_file_text(std::string_view text, const LoadRequest& request);

/// @throws InputError where the path leads to nothing, or to a folder or a device
void check_regular_file(const std::filesystem::path& path, const std::string& file, const std::string& place);

}  // namespace aleph
