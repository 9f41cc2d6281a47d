#pragma once
// Subdivision surfaces: a cage refined once, so that Q(u,v,t) names the same point of the limit surface in every frame.
// Topology and weights are found once (OpenSubdiv); every moment then costs sums over the cage's points.

#include <memory>
#include <span>
#include <vector>

#include "engine/scene.h"

namespace aleph {

/// Immutable and safe to share between threads. Points are in object space, m.
class LimitSurface {
  public:
    /// @throws InputError where the cage's topology cannot be subdivided (place: the cage's name)
    LimitSurface(const Cage& cage, std::size_t cage_points, int level);
    ~LimitSurface();
    LimitSurface(const LimitSurface&) = delete;
    LimitSurface& operator=(const LimitSurface&) = delete;

    int level() const;

    /// What evaluation reads, from the cage's points at a moment.
    std::vector<glm::dvec3> make_control_points(std::span<const glm::dvec3> cage_points) const;

    /// Limit positions and unit limit normals of the vertices of one part's triangles.
    void evaluate_vertices(int part, std::span<const glm::dvec3> control, std::vector<glm::dvec3>& positions,
                           std::vector<glm::vec3>& normals) const;

    /// The limit point behind the point (1 - u - v) p0 + u p1 + v p2 of a part's triangle; u and v are clamped.
    glm::dvec3 evaluate(int part, std::span<const glm::dvec3> control, int primitive, double u, double v) const;

    /// The part's triangles, texture coordinates, positions and normals for the given points.
    Mesh make_mesh(int part, std::span<const glm::dvec3> control) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The cage's points at a moment, in double.
std::vector<glm::dvec3> cage_points_at(const Scene& scene, const Cage& cage, double seconds);

/// (Re)makes the triangles of every mesh that a cage has in the scene, at the cage's level.
/// @throws InputError
void tessellate_cage(Scene& scene, int cage);

}  // namespace aleph
