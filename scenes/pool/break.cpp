#include "scenes/pool/pool_scene.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/base/sampling.h"
#include "scenes/common/keys.h"

namespace aleph {

namespace {

/// Ball numbers by row from the apex: the eight in the middle of the third row, a solid and a stripe in the back
/// corners.
constexpr std::array<int, 15> rack_order = {1, 9, 2, 10, 8, 3, 11, 4, 12, 5, 6, 13, 7, 14, 15};

/// Largest gap between the balls of the rack, m.
constexpr double widest_gap = 1.2e-4;

/// Rotates the number (on the ball's +x) to a direction near `towards`, and randomly about it.
glm::dquat make_orientation(const glm::dvec3& towards, RandomStream& random) {
    // In braces, arguments are evaluated in order.
    const glm::dvec3 wobble{random.next() - 0.5, random.next() - 0.5, random.next() - 0.5};
    const glm::dvec3 direction = glm::normalize(glm::normalize(towards) + 1.1 * wobble);
    const glm::dvec3 x(1.0, 0.0, 0.0);
    const glm::dvec3 axis = glm::normalize(glm::cross(x, direction));
    const glm::dquat turn = glm::angleAxis(std::acos(glm::dot(x, direction)), axis);
    return glm::normalize(turn * glm::angleAxis(2.0 * pi * random.next(), x));
}

}  // namespace

std::vector<PoolBall> make_rack(const PoolSettings& settings) {
    RandomStream random(RandomKey{.seed = 7});
    const glm::dvec3 towards_foot(1.0, 1.2, 0.2);
    std::vector<PoolBall> balls(16);
    PoolBall& cue = balls[cue_ball];
    cue.position = {-0.25 * settings.length, settings.radius, 0.035};
    // Slightly off the centre line and with some side spin, so that the break is not symmetric.
    cue.velocity = break_speed * glm::normalize(glm::dvec3(0.5 * settings.length, 0.0, -0.038));
    cue.angular_velocity = {0.0, 12.0, -0.15 * break_speed / settings.radius};
    cue.orientation = make_orientation(towards_foot, random);

    const double pitch = 2.0 * settings.radius + widest_gap;
    std::size_t next = 0;
    for (int row = 0; row < 5; ++row) {
        for (int k = 0; k <= row; ++k) {
            PoolBall& ball = balls[rack_order[next++]];
            // Each ball is moved by less than half the gap, so that no two overlap.
            const double x = 0.25 * settings.length + row * pitch * std::sqrt(0.75) + 0.45 * widest_gap * random.next();
            const double z = (k - 0.5 * row) * pitch + 0.45 * widest_gap * random.next();
            ball.position = {x, settings.radius, z};
            ball.orientation = make_orientation(towards_foot, random);
        }
    }
    return balls;
}

}  // namespace aleph
