#pragma once
// Saves a scene as .glb through tinygltf, for tests: what it means must survive our reader.

#include <filesystem>

#include "engine/scene/scene.h"

namespace aleph {

/// Writes nodes, rigid meshes, materials, images (their files' bytes), perspective and orthographic cameras and
/// punctual lights; keys become floats, whatever stands still stays a double. Frame rate, exposure, viewing conditions
/// and settings have no place in glTF.
/// @throws std::runtime_error for what it does not write
void write_glb(const Scene& scene, const std::filesystem::path& path);

}  // namespace aleph
