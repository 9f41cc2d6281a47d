#pragma once
// From a point on an object's surface to a camera's axes: composed once per instance and moment, in double.

#include <algorithm>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "engine/camera_view.h"
#include "engine/ray_scene.h"
#include "engine/scene.h"

namespace aleph {

/// Object space to camera axes. The camera's position is subtracted before anything is rotated, so that nothing is
/// lost far from the origin.
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

/// Where on its mesh a ray met an object: object space, m. Always from the barycentrics, never from the distance, which
/// is off by metres at grazing angles (HARD_CASES RP-19); what rounding put off the triangle is put back (RP-18).
inline glm::dvec3 surface_point(const Mesh& mesh, const Hit& hit) {
    // Written so that a NaN becomes 0.
    double u = hit.u > 0.0f ? std::min(static_cast<double>(hit.u), 1.0) : 0.0;
    double v = hit.v > 0.0f ? std::min(static_cast<double>(hit.v), 1.0) : 0.0;
    if (const double sum = u + v; sum > 1.0) {
        u /= sum;
        v /= sum;
    }
    const glm::uvec3& triangle = mesh.triangles[static_cast<std::size_t>(hit.primitive)];
    const glm::dvec3 p0(mesh.positions[triangle.x]);
    const glm::dvec3 p1(mesh.positions[triangle.y]);
    const glm::dvec3 p2(mesh.positions[triangle.z]);
    return (1.0 - u - v) * p0 + u * p1 + v * p2;
}

/// Nearest depth along the viewing axis that still counts as before the camera, m.
inline double nearest_depth(const CameraView& view) {
    // A perspective division by less than this says nothing any more.
    constexpr double smallest = 1e-12;
    return std::max(view.near_plane, view.orthographic ? 0.0 : smallest);
}

}  // namespace aleph
