#pragma once
// From a point on an object's surface to a camera's axes, in double. The map is composed once per instance and time.

#include <algorithm>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/pose/camera_view.h"
#include "engine/pose/pose.h"
#include "engine/rays/ray_scene.h"
#include "engine/surface/limit_surface.h"

namespace aleph {

/// Object space to camera axes. The camera's position is subtracted before the rotation, so that precision is
/// kept far from the origin.
struct CameraFromObject {
    glm::dmat3 linear{1.0};
    glm::dvec3 offset{0.0};  ///< m

    glm::dvec3 operator()(const glm::dvec3& point) const { return linear * point + offset; }
    bool operator==(const CameraFromObject&) const = default;
};

inline CameraFromObject make_camera_from_object(const CameraView& view, const glm::dmat4& world_from_object) {
    return {glm::transpose(view.axes) * glm::dmat3(world_from_object),
            to_camera(view, glm::dvec3(world_from_object[3]))};
}

/// The camera's axes in the frame of the environment's picture.
inline glm::dmat3 background_axes(const CameraView& view, const ScenePose& pose) {
    return glm::transpose(pose.environment_rotation) * view.axes;
}

/// The background lies at infinity: only the rotations of the camera and of the picture move it. Its points are
/// directions in the camera's axes now.
/// @param now, other  background_axes
inline CameraFromObject make_background_map(const glm::dmat3& now, const glm::dmat3& other) {
    return {glm::transpose(other) * now, glm::dvec3(0.0)};
}

/// Barycentric coordinates of a hit, clamped to the triangle: rounding may have moved them outside. NaN becomes 0.
inline glm::dvec2 clamp_barycentrics(const Hit& hit) {
    const double u = std::min(std::max(0.0, static_cast<double>(hit.u)), 1.0);
    const double v = std::min(std::max(0.0, static_cast<double>(hit.v)), 1.0);
    return glm::dvec2(u, v) / std::max(1.0, u + v);
}

/// A point of a triangle. `triangle` holds indices into `points`, which may have any precision.
template <class Points>
[[gnu::always_inline]] inline glm::dvec3 point_between(const Points& points, const glm::uvec3& triangle,
                                                       const glm::dvec2& uv) {
    const glm::dvec3 p0(points[triangle.x]), p1(points[triangle.y]), p2(points[triangle.z]);
    return (1.0 - uv.x - uv.y) * p0 + uv.x * p1 + uv.y * p2;
}

/// The point of a mesh that a ray hit: object space, m. Computed from the barycentrics, because the distance is off by
/// metres at grazing angles.
[[gnu::always_inline]] inline glm::dvec3 surface_point(const Mesh& mesh, const Hit& hit) {
    return point_between(mesh.positions, mesh.triangles[hit.primitive], clamp_barycentrics(hit));
}

/// The same on a mesh that may deform, as `posed` (ScenePose::meshes): the point of its triangles, as rays hit them.
inline glm::dvec3 triangle_point(const Mesh& mesh, const PosedMesh& posed, const Hit& hit) {
    if (posed.positions.empty()) return surface_point(mesh, hit);
    return point_between(posed.positions, mesh.triangles[hit.primitive], clamp_barycentrics(hit));
}

/// Q(u,v,t) at the time of `posed`: on the limit surface for the mesh of a moving cage, else on the triangle.
inline glm::dvec3 surface_point(const Mesh& mesh, const PosedMesh& posed, const Hit& hit) {
    if (posed.control.empty()) return triangle_point(mesh, posed, hit);
    const glm::dvec2 uv = clamp_barycentrics(hit);
    return mesh.subdivision.limit.surface->evaluate(mesh.subdivision.part, posed.control, hit.primitive, uv.x, uv.y);
}

/// Nearest depth along the viewing axis that counts as in front of the camera, m.
inline double nearest_depth(const CameraView& view) {
    // A perspective division by less than this gives no meaningful result.
    constexpr double smallest = 1e-12;
    return std::max(view.near_plane, view.orthographic ? 0.0 : smallest);
}

}  // namespace aleph
