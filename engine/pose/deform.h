#pragma once
// Poses deforming meshes, in double: point caches, morph targets followed by a skin, cages.

#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "engine/pose/pose.h"

namespace aleph {

/// A mesh whose points pose() replaces, and what is known about it; found once.
struct Deformer {
    int mesh = no_index;
    int node = no_index;   ///< skinned: the only node that carries the mesh
    bool changes = false;  ///< false: posed, but the same at every time
    /// Where normals are computed from the moved triangles: per vertex, the number of its group. Vertices of one point
    /// whose normals agree at rest share one, so that an edge stays as smooth or sharp as in the file.
    std::vector<std::uint32_t> normal_groups;
};

/// True where joints carry the vertices.
inline bool is_skinned(const Mesh& mesh) {
    return mesh.deformation.skin != no_index && mesh.deformation.joints_per_vertex > 0;
}

/// The meshes that have instances and whose points or normals differ from those of the mesh: samples that differ,
/// morph targets that are or may be on, a skin, a cage that moves. In the order of the scene's meshes.
/// @param moving_nodes  per node, true where its transform can change, and with it a skin
std::vector<Deformer> find_deformers(const Scene& scene, std::span<const std::uint8_t> moving_nodes);

/// Fills the mesh of each deformer that is shown, and clears the others, for a pose whose time and nodes are set.
/// @param shown  per deformer: some instance shows its mesh
/// @param all    false: leaves meshes that do not change and are filled already
void deform(const Scene& scene, std::span<const Deformer> deformers, std::span<const std::uint8_t> shown, bool all,
            ScenePose& posed);

}  // namespace aleph
