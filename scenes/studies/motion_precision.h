#pragma once
// Motion of a surface point between two frames, with numbers of a chosen type: what precision buys.

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/pose/camera_view.h"

namespace aleph {

/// An object and the camera at one frame.
struct ObjectPose {
    CameraView view;
    glm::dmat4 world_from_object{1.0};
};

/// The two moved together by `offset`, m, which changes nothing but the size of their coordinates.
inline ObjectPose move_world(ObjectPose pose, const glm::dvec3& offset) {
    pose.view.position += offset;
    pose.world_from_object[3] += glm::dvec4(offset, 0.0);
    return pose;
}

/// From object space to a picture, the object's transform and the camera's composed first, in double: coordinates are
/// relative to the camera before they are rounded to T.
template <class T>
struct RelativeProjection {
    glm::mat<3, 3, T> linear;
    glm::vec<3, T> offset;
    T scale, middle_x, middle_y;

    explicit RelativeProjection(const ObjectPose& pose)
        : linear(glm::mat<3, 3, T>(glm::transpose(pose.view.axes) * glm::dmat3(pose.world_from_object))),
          offset(glm::vec<3, T>(to_camera(pose.view, glm::dvec3(pose.world_from_object[3])))),
          scale(static_cast<T>(pose.view.pixels_per_unit)),
          middle_x(static_cast<T>(0.5 * pose.view.width + pose.view.axis_offset.x)),
          middle_y(static_cast<T>(0.5 * pose.view.height + pose.view.axis_offset.y)) {}

    glm::vec<2, T> operator()(const glm::vec<3, T>& point) const {
        const glm::vec<3, T> p = linear * point + offset;
        const T s = scale / -p.z;
        return {middle_x + p.x * s, middle_y - p.y * s};
    }
};

/// The same by way of world space: every step in T.
template <class T>
struct WorldProjection {
    glm::mat<3, 3, T> linear, axes;
    glm::vec<3, T> translation, position;
    T scale, middle_x, middle_y;

    explicit WorldProjection(const ObjectPose& pose)
        : linear(glm::mat<3, 3, T>(glm::dmat3(pose.world_from_object))),
          axes(glm::mat<3, 3, T>(pose.view.axes)),
          translation(glm::vec<3, T>(glm::dvec3(pose.world_from_object[3]))),
          position(glm::vec<3, T>(pose.view.position)),
          scale(static_cast<T>(pose.view.pixels_per_unit)),
          middle_x(static_cast<T>(0.5 * pose.view.width + pose.view.axis_offset.x)),
          middle_y(static_cast<T>(0.5 * pose.view.height + pose.view.axis_offset.y)) {}

    glm::vec<2, T> operator()(const glm::vec<3, T>& point) const {
        const glm::vec<3, T> world = linear * point + translation;
        const glm::vec<3, T> p = (world - position) * axes;
        const T s = scale / -p.z;
        return {middle_x + p.x * s, middle_y - p.y * s};
    }
};

/// Displacement of a point of the object, pixels, computed with two projections of the same type.
template <class Projection, class Vector>
auto displace(const Projection& now, const Projection& other, const Vector& point) {
    return other(point) - now(point);
}

}  // namespace aleph
