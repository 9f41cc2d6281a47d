#pragma once
// Writer of binary glTF 2.0 files (.glb).

#include <filesystem>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// Writes a scene with all that its includes brought, completely or not at all. Equal scenes give equal bytes.
/// @param scene  valid, as engine/load/validate_scene.h has it: save_scene checks it
/// @return what the file does not say and the scene does, one sentence for each kind
/// @throws InputError where the scene is too large for such a file, OutputError if writing fails
std::vector<std::string> write_gltf(const Scene& scene, const std::filesystem::path& path);

}  // namespace aleph
