#pragma once
// Balls that fall, bounce and come to rest. Between impacts a ball flies freely, so its path is a parabola: exactly
// what a cubic track through the impacts' positions and velocities is.

#include <glm/vec3.hpp>
#include <vector>

#include "scenes/common/keys.h"

namespace aleph {

inline constexpr double gravity = 9.81;  ///< m/s2

struct BallDrop {
    double release = 0.0;         ///< s; at rest, or held, before it
    glm::dvec3 position{0.0};     ///< m, of the centre as it is let go
    glm::dvec3 velocity{0.0};     ///< m/s, as it is let go
    double radius = 0.1;          ///< m
    double ground = 0.0;          ///< m, height of what it falls on
    double restitution = 0.8;     ///< share of the upright speed that an impact gives back
    double grip = 1.0;            ///< share of the level speed that an impact leaves
    double rolling = 0.08;        ///< m/s2, deceleration of a ball that rolls
    double settled_speed = 0.12;  ///< m/s; slower impacts end the bouncing
};

/// Release, impacts, and where it lies still; between two the acceleration is constant.
/// @param until  s; the last key, if it is not at rest before
std::vector<MotionKey<glm::dvec3>> simulate_drop(const BallDrop& drop, double until);

/// Angle about the axis in which the ball would roll along its path, radians: it spins on unchanged in the air, and
/// takes up the speed of rolling at every impact.
std::vector<MotionKey<double>> simulate_spin(const BallDrop& drop, const std::vector<MotionKey<glm::dvec3>>& path);

}  // namespace aleph
