#pragma once
// Warnings of meshes that load and do not look as their file means it.

#include "engine/scene/scene.h"

namespace aleph {

/// Adds at most one warning of each kind, with the name of the first mesh and how many more there are:
/// - rigid meshes whose triangles all have no area (corners that coincide or lie on a line);
/// - meshes with a texture for which they have no texture coordinates, one warning for each material;
/// - meshes with a normal map or anisotropy and no texture coordinates to give directions, one for each material;
/// - texture coordinates beyond 1e6, where single precision holds no place within a texture.
/// Meshes that no node uses do not count.
void add_mesh_warnings(Scene& scene);

}  // namespace aleph
