#pragma once
// Rotations that turn a node's -z along a direction and its y towards another.

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace aleph {

/// Both unit, or zero where there is none.
struct Aim {
    glm::dvec3 direction{0.0};
    glm::dvec3 up{0.0};
};

/// Nothing where the direction is zero, or parallel to up within 1e-9 rad.
std::optional<glm::dquat> find_rotation(const Aim& aim);

/// The rotation of the aim, with the sign nearest to `near`. Where there is no direction it is `near`; where the
/// direction is parallel to up it is `near`, turned the shortest way to the direction.
glm::dquat rotation_near(const Aim& aim, const glm::dquat& near);

/// For an aim that is always parallel to up: a camera that looks down has -z at the top of its picture, one that looks
/// up has +z there, as when it is tilted from looking along -z. Where up is z, y takes that part.
glm::dquat rotation_along_up(const Aim& aim);

}  // namespace aleph
