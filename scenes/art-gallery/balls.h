#pragma once
// Balls that fall, bounce and come to rest. Between impacts the path is a parabola, which a cubic track through the
// positions and velocities at the impacts represents exactly.

#include <glm/vec3.hpp>
#include <vector>

#include "scenes/common/keys.h"

namespace aleph {

inline constexpr double gravity = 9.81;  ///< m/s2

struct BallDrop {
    double release = 0.0;         ///< s; the ball is at rest before
    glm::dvec3 position{0.0};     ///< m, of the centre at release
    glm::dvec3 velocity{0.0};     ///< m/s, at release
    double radius = 0.1;          ///< m
    double ground = 0.0;          ///< m, height of the ground
    double restitution = 0.8;     ///< vertical speed after an impact over that before
    double grip = 1.0;            ///< horizontal speed after an impact over that before
    double rolling = 0.08;        ///< m/s2, deceleration of a rolling ball
    double settled_speed = 0.12;  ///< m/s; slower impacts end the bouncing
};

/// Keys at release, impacts and rest; between two keys the acceleration is constant.
/// @param until  s; the last key, if the ball is not at rest before
std::vector<MotionKey<glm::dvec3>> simulate_drop(const BallDrop& drop, double until);

/// Angle about the axis of rolling along the path, radians: the spin is constant in the air, and becomes that of
/// rolling at every impact.
std::vector<MotionKey<double>> simulate_spin(const BallDrop& drop, const std::vector<MotionKey<glm::dvec3>>& path);

}  // namespace aleph
