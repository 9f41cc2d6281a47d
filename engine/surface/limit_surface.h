#pragma once
// Subdivision surfaces: a cage refined once, so that Q(u,v,t) names the same point of the limit surface in every frame.
// Topology and weights are found once (OpenSubdiv). A pose then needs only weighted sums of the cage's points.

#include <memory>
#include <span>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// Immutable and safe to share between threads. Points are in object space, m.
class LimitSurface {
  public:
    /// @param level  every edge of the cage gets 2^level segments; it affects the triangles only
    /// @throws InputError (place: the cage's name) where the topology cannot be subdivided, or triangles are too many
    LimitSurface(const Cage& cage, std::size_t cage_points, int level);
    ~LimitSurface();

    /// The level asked for; 1 in place of 0 where some face is no quad (triangle for Loop).
    int level() const;
    int part_count() const;
    /// Corners of the part's triangles, into its vertices.
    const std::vector<glm::uvec3>& triangles(int part) const;

    /// Control points, which evaluate() reads, from the cage's points at a time.
    std::vector<glm::dvec3> make_control_points(std::span<const glm::dvec3> cage_points) const;

    /// Limit positions and unit limit normals of the vertices of one part's triangles. Faces that share an edge share
    /// its vertices' positions bit for bit, across parts too.
    void evaluate_vertices(int part, std::span<const glm::dvec3> control, std::vector<glm::dvec3>& positions,
                           std::vector<glm::vec3>& normals) const;

    /// The limit point behind the point (1 - u - v) p0 + u p1 + v p2 of a part's triangle; u and v are clamped, NaN is
    /// a failed check. The same point at every level, the tessellation's own at the corners (to 1e-15 of the size).
    glm::dvec3 evaluate(int part, std::span<const glm::dvec3> control, int primitive, double u, double v) const;

    /// The part's triangles, texture coordinates, positions and normals for the given points.
    Mesh make_mesh(int part, std::span<const glm::dvec3> control) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// (Re)makes the triangles, normals and first texture coordinates of every mesh that a cage has, at the cage's level
/// and its points' first sample, and sets MeshSubdivision::limit. Adds list_warnings (cage_checks.h) to the scene's,
/// once.
/// @throws InputError
void tessellate_cage(Scene& scene, int cage);

}  // namespace aleph
