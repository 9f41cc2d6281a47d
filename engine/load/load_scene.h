#pragma once
// Loads and saves scenes. The ending of the file's name picks the format; every format's reader fills the same Scene.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/json/load_limits.h"
#include "engine/load/scene_format.h"
#include "engine/scene/scene.h"

namespace aleph {

/// Reads a scene file (.json), a .gltf or .glb, or an .abc, with its includes and images. An .abc that is loaded by
/// itself sets frame rate and range; where it is included, those of the scene file are used.
/// A glTF or Alembic file without a camera gets one that sees its bounds over the whole range, a scene without light
/// gets a constant white environment. SceneSource::warnings tells of both, and of what is read and cannot be seen.
/// @param formats  what else than aleph's own formats is read: a copy of scene_formats() with more rows
/// @throws InputError with file, place and reason
Scene load_scene(const std::filesystem::path& path, const LoadLimits& limits = {},
                 const SceneFormats& formats = scene_formats());

/// Reads the text of a scene file.
/// @param folder  of the files that it names
/// @throws InputError with place and reason
Scene load_scene_text(std::string_view text, const std::filesystem::path& folder, const LoadLimits& limits = {});

/// Writes a scene file (.json) or binary glTF (.glb), completely or not at all.
/// load_scene returns a scene equal to that of a .json, apart from `file` and `warnings`: a camera or a light that was
/// added is written like the rest. Includes stay includes. In another folder than that of SceneSource::file the paths
/// of includes and images change accordingly. A .glb holds what includes brought, and motion as engine/gltf/write says.
/// @return what the file does not say and the scene does, one sentence for each kind: of a .glb only
/// @throws InputError where the file format has no words for what the scene holds, OutputError if writing fails
std::vector<std::string> save_scene(const Scene& scene, const std::filesystem::path& path,
                                    const SceneFormats& formats = scene_formats());

}  // namespace aleph
