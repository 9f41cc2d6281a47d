#pragma once
// Deforming meshes at a moment, in double: point caches, morph targets and then a skin, cages.

#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "engine/pose/pose.h"

namespace aleph {

/// What is found once about a mesh whose points pose() replaces.
struct Deformer {
    int mesh = no_index;
    int node = no_index;   ///< skinned: the only node that carries the mesh
    bool changes = false;  ///< false: posed, but the same at every time
    /// Where normals are found from the moved triangles: vertices of one number share theirs. Those of one point whose
    /// normals agree at rest do, so that an edge stays as smooth or sharp as the file has it.
    std::vector<std::uint32_t> normal_groups;
};

/// The meshes that have instances and whose points or normals are not simply those of the mesh: samples that differ,
/// morph targets that are or may be on, a skin, a cage that moves. In the order of the scene's meshes.
/// @param moving_nodes  per node, true where its transform can change: what a skin changes by
std::vector<Deformer> find_deformers(const Scene& scene, std::span<const std::uint8_t> moving_nodes);

/// Fills what `posed` holds of each deformer whose mesh is shown, and clears it of the others.
/// @param shown  per deformer: whether some instance shows its mesh
/// @param world  per node, object to world
/// @param all    false: what does not change and is filled already stays
void deform(const Scene& scene, std::span<const Deformer> deformers, std::span<const std::uint8_t> shown,
            std::span<const glm::dmat4> world, double seconds, bool all, std::vector<PosedMesh>& posed);

}  // namespace aleph
