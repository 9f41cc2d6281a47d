#pragma once
// A deforming mesh for rays: its tree is refitted to the moved points, and built again when refitting has made it bad.

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "engine/rays/alpha_cutout.h"
#include "engine/rays/triangle_tree.h"

namespace aleph {

/// The parts of a deforming mesh that stay when its points move.
struct DeformingMesh {
    int mesh;      ///< into Scene::meshes
    int place;     ///< among its node's meshes
    bool changes;  ///< false: posed once
    std::size_t vertex_count;
    std::vector<glm::uvec3> triangles;
    const AlphaCutout* cutout;  ///< null: no holes
};

/// The tree of one deforming mesh.
class RefitMesh {
  public:
    /// @param device, mesh  must outlive this
    RefitMesh(const EmbreeDevice& device, const DeformingMesh& mesh);
    RefitMesh(const RefitMesh&) = delete;
    RefitMesh& operator=(const RefitMesh&) = delete;

    enum class Change { none, moved, unusable };
    /// Unusable: there are no positions, or some that are not finite, or too large.
    Change update(const std::vector<glm::dvec3>& positions);
    bool is_filled() const { return tree_ != nullptr; }
    /// Null until it is filled.
    const TriangleTree* tree() const { return tree_.get(); }

  private:
    void build();
    double measure_spread() const;

    const EmbreeDevice& device_;
    const DeformingMesh& mesh_;
    std::unique_ptr<TriangleTree> tree_;
    std::vector<glm::vec3> points_;
    bool current_ = false;                   ///< the tree has these points
    std::vector<std::uint32_t> neighbours_;  ///< triangles, near ones near each other when the tree was built
    double spread_ = 0.0;                    ///< then
};

}  // namespace aleph
