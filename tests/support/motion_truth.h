#pragma once
// Reference for motion: each point through the hierarchy in long double, from the keys, without matrices, poses or
// camera views. Shares no code with engine or motion except the plain structs of the scene.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "engine/rays/ray_scene.h"
#include "engine/scene/scene.h"

namespace aleph {

using Real = long double;

using RealVector = glm::vec<3, Real, glm::defaultp>;

inline RealVector unit(const RealVector& a) {
    return a / std::sqrt(glm::dot(a, a));
}

/// The keys around a time and the fraction between them. Acyclic samplings only, as the tests author them.
struct RealSpan {
    std::size_t from = 0, to = 0;
    Real fraction = 0;
};
template <class T>
RealSpan real_span(const Track<T>& track, Real seconds) {
    if (track.values.size() == 1) return {};
    const auto& times = track.sampling.times;
    if (seconds <= times.front()) return {};
    if (seconds >= times.back()) return {times.size() - 1, times.size() - 1, 0};
    std::size_t i = 0;
    while (times[i + 1] < seconds) ++i;
    return {i, i + 1, (seconds - times[i]) / (Real(times[i + 1]) - Real(times[i]))};
}

inline Real real_value(const Track<double>& track, Real seconds) {
    const RealSpan s = real_span(track, seconds);
    return Real(track.values[s.from]) + s.fraction * (Real(track.values[s.to]) - Real(track.values[s.from]));
}
inline RealVector real_value(const Track<glm::dvec3>& track, Real seconds) {
    const RealSpan s = real_span(track, seconds);
    const RealVector a(track.values[s.from]);
    return a + s.fraction * (RealVector(track.values[s.to]) - a);
}

/// Turned by an angle about a unit axis (Rodrigues).
inline RealVector real_turned(const RealVector& v, const RealVector& axis, Real angle) {
    return std::cos(angle) * v + std::sin(angle) * glm::cross(axis, v) +
           ((1 - std::cos(angle)) * glm::dot(axis, v)) * axis;
}

/// Quaternion as x, y, z, w.
using RealQuaternion = glm::vec<4, Real, glm::defaultp>;
inline RealQuaternion real_quaternion(const glm::dquat& q) {
    const RealQuaternion real(q.x, q.y, q.z, q.w);
    return real / std::sqrt(glm::dot(real, real));
}
inline RealVector real_turned(const RealVector& v, const RealQuaternion& q) {
    const RealVector u(q);
    return v + Real(2) * glm::cross(u, glm::cross(u, v) + q[3] * v);
}
inline RealVector real_turned(const RealVector& v, const Track<glm::dquat>& track, Real seconds) {
    const RealSpan s = real_span(track, seconds);
    const RealQuaternion a = real_quaternion(track.values[s.from]), b = real_quaternion(track.values[s.to]);
    const Real cosine = glm::dot(a, b);
    const Real sign = cosine < 0 ? -1 : 1;
    const Real angle = std::acos(std::min<Real>(sign * cosine, 1));
    RealQuaternion q = a;
    if (angle > 1e-9L) {
        q = (std::sin((1 - s.fraction) * angle) * a + std::sin(s.fraction * angle) * sign * b) / std::sin(angle);
    }
    return real_turned(v, q);
}

inline RealVector real_to_parent(const Node& node, const RealVector& p, Real seconds) {
    if (node.transform.matrix) {
        const glm::dmat4& m = node.transform.matrix->values.front();
        return p.x * RealVector(m[0]) + p.y * RealVector(m[1]) + p.z * RealVector(m[2]) + RealVector(m[3]);
    }
    const RealVector scale = real_value(node.transform.scale, seconds);
    const RealVector scaled = scale * p;
    const RealVector turned = node.transform.axis_rotation
                                  ? real_turned(scaled, unit(node.transform.axis_rotation->axis),
                                                real_value(node.transform.axis_rotation->angle, seconds))
                                  : real_turned(scaled, node.transform.rotation, seconds);
    return turned + real_value(node.transform.translation, seconds);
}

inline RealVector real_to_world(const Scene& scene, int node, RealVector p, Real seconds) {
    for (; node != no_index; node = scene.nodes[node].parent) {
        p = real_to_parent(scene.nodes[node], p, seconds);
    }
    return p;
}

struct RealPixel {
    Real x = 0, y = 0;
    Real depth = 0;  ///< m, positive before the camera
};

/// Through the camera of a node, into an image of width x height.
inline RealPixel real_project(const Scene& scene, int camera_node, const RealVector& world, Real seconds, int width,
                              int height) {
    const Camera& camera = scene.cameras[scene.nodes[camera_node].camera];
    const RealVector eye = real_to_world(scene, camera_node, RealVector(0), seconds);
    const RealVector forward = unit(real_to_world(scene, camera_node, {0, 0, -1}, seconds) - eye);
    const RealVector up_hint = real_to_world(scene, camera_node, {0, 1, 0}, seconds) - eye;
    const RealVector up = unit(up_hint - glm::dot(up_hint, forward) * forward);
    const RealVector right = glm::cross(forward, up);
    const RealVector way = world - eye;
    const Real depth = glm::dot(way, forward);
    const Real scale = camera.orthographic ? height / (2 * real_value(camera.half_height, seconds))
                                           : height / (2 * std::tan(real_value(camera.fov, seconds) / 2)) / depth;
    return {Real(width) / 2 + glm::dot(way, right) * scale, Real(height) / 2 - glm::dot(way, up) * scale, depth};
}

inline RealVector real_surface_point(const Mesh& mesh, const Hit& hit) {
    const glm::uvec3& triangle = mesh.triangles[hit.primitive];
    const Real u = hit.u, v = hit.v;
    return (1 - u - v) * RealVector(mesh.positions[triangle.x]) + u * RealVector(mesh.positions[triangle.y]) +
           v * RealVector(mesh.positions[triangle.z]);
}

}  // namespace aleph
