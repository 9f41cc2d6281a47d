#pragma once
// A deforming mesh for rays: its tree is refitted to the moved points, and built again when refitting has made it bad.

#include <glm/vec3.hpp>
#include <vector>

#include "engine/rays/alpha_cutout.h"
#include "engine/rays/embree_device.h"

namespace aleph {

/// What does not change when the points of a deforming mesh move.
struct DeformingMesh {
    DeformingMesh(const Mesh& mesh, int index, unsigned geometry_number, bool can_change, const AlphaCutout* holes);

    int mesh;           ///< into Scene::meshes
    unsigned geometry;  ///< Embree's number: its place among its node's meshes
    bool changes;       ///< false: posed once
    std::size_t vertex_count;
    std::vector<glm::uvec3> triangles;
    const AlphaCutout* cutout;  ///< null: no holes
};

/// A triangle geometry with the settings that every mesh of a RayScene has.
/// @param cutout  null: no holes; must outlive the geometry
struct TriangleGeometry {
    EmbreeGeometry geometry;
    std::span<glm::vec3> points;  ///< Embree's own, to be filled before the geometry is committed
};
TriangleGeometry make_triangle_geometry(const EmbreeDevice& device, std::size_t vertex_count,
                                        const std::vector<glm::uvec3>& triangles, const AlphaCutout* cutout);

/// Embree's scene of one deforming mesh.
class RefitMesh {
  public:
    /// @param device, mesh  must outlive this
    RefitMesh(const EmbreeDevice& device, const DeformingMesh& mesh);
    RefitMesh(const RefitMesh&) = delete;
    RefitMesh& operator=(const RefitMesh&) = delete;

    enum class Change { none, moved, unusable };
    /// Unusable: there are no positions, or some that Embree would drop silently (not finite, too large).
    Change update(const std::vector<glm::dvec3>& positions);
    bool is_filled() const { return triangles_.geometry != nullptr; }
    RTCScene scene() const { return scene_.get(); }

  private:
    void build();
    double measure_spread() const;

    const EmbreeDevice& device_;
    const DeformingMesh& mesh_;
    EmbreeScene scene_;
    TriangleGeometry triangles_;
    std::vector<glm::vec3> points_;
    bool current_ = false;                   ///< Embree has these points
    std::vector<std::uint32_t> neighbours_;  ///< triangles, near ones near each other when the tree was built
    double spread_ = 0.0;                    ///< then
};

}  // namespace aleph
