#include "engine/scene_file/aim.h"

#include <glm/geometric.hpp>

#include "engine/scene/transforms.h"

namespace aleph {

namespace {

constexpr double least_sine = 1e-9;

/// @param right  unit, at right angles to the direction
glm::dquat rotation_of(const glm::dvec3& right, const glm::dvec3& direction) {
    const glm::dvec3 back = -direction;
    return safe_normalize(glm::quat_cast(glm::dmat3(right, safe_normalize(glm::cross(back, right)), back)));
}

/// The shortest turn from one unit vector to another; between opposite ones half a turn about `axis`.
glm::dquat shortest_turn(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& axis) {
    const glm::dvec3 halfway = from + to;
    if (glm::length(halfway) < least_sine) return {0.0, axis.x, axis.y, axis.z};
    const glm::dvec3 middle = safe_normalize(halfway), turn = glm::cross(from, middle);
    return safe_normalize(glm::dquat(glm::dot(from, middle), turn.x, turn.y, turn.z));
}

}  // namespace

std::optional<glm::dquat> find_rotation(const Aim& aim) {
    const glm::dvec3 product = glm::cross(aim.direction, aim.up);
    if (!(glm::length(product) > least_sine)) return std::nullopt;
    const glm::dvec3 right = safe_normalize(product);
    // A short product leans a little.
    return rotation_of(safe_normalize(right - aim.direction * glm::dot(right, aim.direction)), aim.direction);
}

glm::dquat rotation_near(const Aim& aim, const glm::dquat& near) {
    glm::dquat rotation = near;
    if (const auto found = find_rotation(aim)) {
        rotation = *found;
    } else if (aim.direction != glm::dvec3(0.0)) {
        const glm::dmat3 axes = glm::mat3_cast(near);
        rotation = safe_normalize(shortest_turn(-axes[2], aim.direction, axes[1]) * near);
    }
    return glm::dot(rotation, near) < 0.0 ? -rotation : rotation;
}

glm::dquat rotation_along_up(const Aim& aim) {
    const glm::dvec3 size = glm::abs(aim.up);
    const bool along_z = size.z > size.x && size.z > size.y;
    const glm::dvec3 forward = along_z ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, -1.0);
    const glm::dvec3 top = glm::dot(aim.direction, aim.up) < 0.0 ? forward : -forward;
    return find_rotation({aim.direction, top}).value_or(glm::dquat(1.0, 0.0, 0.0, 0.0));
}

}  // namespace aleph
