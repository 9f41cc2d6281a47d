#pragma once
// Reader of glTF 2.0 files (.gltf, .glb). Files are checked by engine/gltf/validate before tinygltf parses them.

#include <filesystem>

#include "engine/json/load_limits.h"
#include "engine/scene/scene.h"

namespace aleph {

/// Appends a glTF file's nodes, meshes (one per primitive; a rigid mesh used by several nodes is stored once, one with
/// morph targets or a skin once for each node), skins, materials, images, lights, cameras and warnings to a scene.
/// The animations that are named apply at once, or all of the file; where two of them move the same property the first
/// one does, and a warning names what is left out. Times are seconds. The scene does not change where an error is
/// thrown.
/// @param parent_node    node under which the file's roots hang, or no_index to append them as roots
/// @param include_index  becomes `include` of every element that is appended
/// @param animations     names; "animation 2" names one without a name; null: all
/// @throws InputError naming file, place ("node 3", "accessor 7", a JSON pointer) and the rule that is broken, or the
/// feature that is not supported
void append_gltf(const std::filesystem::path& file, Scene& scene, int parent_node, int include_index,
                 const LoadLimits& limits = {}, const std::vector<std::string>* animations = nullptr);

}  // namespace aleph
