#include "scenes/pool/impact.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace aleph {

namespace {

const glm::dvec3 up(0.0, 1.0, 0.0);

// s; a hard contact between two balls lasts about 300 microseconds.
constexpr double contact_step = 1e-6;
constexpr int most_contact_steps = 50000;

/// Velocity of the surface point at `arm` from the centre.
glm::dvec3 surface_velocity(const PoolBall& ball, const glm::dvec3& arm) {
    return ball.velocity + glm::cross(ball.angular_velocity, arm);
}

/// Impulse (per mass) at `arm`. A solid sphere: I = 2/5 m r^2.
void apply_impulse(PoolBall& ball, const glm::dvec3& arm, const glm::dvec3& impulse, const PoolSettings& settings) {
    ball.velocity += glm::dvec3(impulse.x, 0.0, impulse.z);
    ball.angular_velocity += glm::cross(arm, impulse) * (2.5 / (settings.radius * settings.radius));
}

/// Friction impulse (per mass) against a slip: Coulomb's, or less if that would reverse the slip.
/// @param stopping  share of the slip that an impulse (per mass) must have to stop it: 2/7 one ball, 1/7 two
glm::dvec3 friction_impulse(const glm::dvec3& slip, double limit, double stopping) {
    const double speed = glm::length(slip);
    return speed > 0.0 ? slip * (-std::min(limit, stopping * speed) / speed) : glm::dvec3(0.0);
}

double bounce(double speed, double restitution, const PoolSettings& settings) {
    return speed < settings.soft_speed ? 0.0 : restitution;
}

/// Two balls of an impact that touch, or nearly.
struct Link {
    std::size_t a = 0, b = 0;
    glm::dvec3 normal{0.0};  ///< from a to b
    double depth = 0.0;      ///< m, pressed in; negative: a gap
    double push = 0.0;       ///< normal impulse so far, per mass
    double step = 0.0;       ///< its part of a contact step

    double parting(const std::vector<PoolBall>& balls) const {
        return glm::dot(balls[b].velocity - balls[a].velocity, normal);
    }
    void give(std::vector<PoolBall>& balls, double impulse) {
        push += impulse;
        balls[a].velocity -= impulse * normal;
        balls[b].velocity += impulse * normal;
    }
};

std::vector<Link> find_links(const std::vector<PoolBall>& balls, const std::vector<int>& members,
                             const PoolSettings& settings) {
    std::vector<Link> links;
    for (std::size_t i = 0; i < members.size(); ++i) {
        for (std::size_t j = i + 1; j < members.size(); ++j) {
            Link link{static_cast<std::size_t>(members[i]), static_cast<std::size_t>(members[j])};
            const glm::dvec3 apart = balls[link.b].position - balls[link.a].position;
            const double distance = glm::length(apart);
            if (distance > 2.0 * settings.radius + settings.touching_gap) continue;
            link.normal = apart / distance;
            // Rounding must not look like a gap between two balls that have just met.
            const double depth = 2.0 * settings.radius - distance;
            link.depth = std::abs(depth) < 1e-12 ? 0.0 : depth;
            links.push_back(link);
        }
    }
    return links;
}

double largest_approach(const std::vector<PoolBall>& balls, const std::vector<Link>& links) {
    double approach = 0.0;
    for (const Link& link : links) approach = std::max(approach, -link.parting(balls));
    return approach;
}

/// Several balls press on each other for a fraction of a millisecond, during which they do not move: Hertzian contact,
/// force = stiffness * depth^1.5 (1 + damping * closing speed), the damping such that a pair would part with the
/// restitution of the settings (Hunt and Crossley 1975). Ends when no two balls are compressed.
void collide_cluster(std::vector<PoolBall> balls, std::vector<Link>& links, double approach,
                     const PoolSettings& settings) {
    const double stiffness = settings.contact_stiffness / settings.mass;
    const double damping = 1.5 * (1.0 - bounce(approach, settings.ball_restitution, settings)) / approach;
    for (int i = 0; i < most_contact_steps; ++i) {
        bool pressed = i == 0;
        for (Link& link : links) {
            link.depth -= link.parting(balls) * contact_step;
            pressed = pressed || link.depth > 0.0;
        }
        if (!pressed) return;
        for (Link& link : links) {
            if (link.depth <= 0.0) continue;
            const double closing = -link.parting(balls);
            const double force = stiffness * link.depth * std::sqrt(link.depth) * (1.0 + damping * closing);
            link.step = std::max(0.0, force) * contact_step;
        }
        for (Link& link : links) link.give(balls, std::exchange(link.step, 0.0));
    }
}

void apply_contact_friction(std::vector<PoolBall>& balls, const Link& link, const PoolSettings& settings) {
    PoolBall& a = balls[link.a];
    PoolBall& b = balls[link.b];
    const glm::dvec3 arm = settings.radius * link.normal;
    const glm::dvec3 relative = surface_velocity(b, -arm) - surface_velocity(a, arm);
    const glm::dvec3 slip = relative - glm::dot(relative, link.normal) * link.normal;
    const glm::dvec3 impulse = friction_impulse(slip, settings.ball_friction * link.push, 1.0 / 7.0);
    apply_impulse(a, arm, -impulse, settings);
    apply_impulse(b, -arm, impulse, settings);
}

}  // namespace

glm::dvec3 cloth_slip(const PoolBall& ball, const PoolSettings& settings) {
    return surface_velocity(ball, -settings.radius * up);
}

void collide_balls(std::vector<PoolBall>& balls, const std::vector<int>& members, const PoolSettings& settings) {
    std::vector<Link> links = find_links(balls, members, settings);
    const double approach = largest_approach(balls, links);
    if (approach <= 0.0) return;
    if (links.size() == 1) {
        links.front().push = 0.5 * (1.0 + bounce(approach, settings.ball_restitution, settings)) * approach;
    } else {
        collide_cluster(balls, links, approach, settings);
    }
    for (const Link& link : links) {
        balls[link.a].velocity -= link.push * link.normal;
        balls[link.b].velocity += link.push * link.normal;
    }
    for (const Link& link : links) apply_contact_friction(balls, link, settings);
}

void collide_cushion(PoolBall& ball, const glm::dvec3& normal, const PoolSettings& settings) {
    const double approach = -glm::dot(ball.velocity, normal);
    if (approach <= 0.0) return;
    const glm::dvec3 arm = -settings.radius * normal;
    const glm::dvec3 surface = surface_velocity(ball, arm);
    const glm::dvec3 slip = surface - glm::dot(surface, normal) * normal;
    const double push = (1.0 + bounce(approach, settings.cushion_restitution, settings)) * approach;
    apply_impulse(ball, arm, push * normal + friction_impulse(slip, settings.cushion_friction * push, 2.0 / 7.0),
                  settings);
}

void apply_cloth_friction(PoolBall& ball, double seconds, const PoolSettings& settings) {
    const glm::dvec3 slip = cloth_slip(ball, settings);
    const double limit = settings.sliding_friction * settings.gravity * seconds;
    apply_impulse(ball, -settings.radius * up, friction_impulse(slip, limit, 2.0 / 7.0), settings);

    // It rolls from here on: both velocities fall by the same factor, so it keeps rolling until it stops.
    const double speed = glm::length(ball.velocity);
    if (2.0 / 7.0 * glm::length(slip) <= limit && speed > 0.0) {
        const double loss = settings.rolling_friction * settings.gravity * seconds;
        const double keep = std::max(0.0, 1.0 - loss / speed);
        ball.velocity *= keep;
        ball.angular_velocity.x *= keep;
        ball.angular_velocity.z *= keep;
    }
    const double spin = ball.angular_velocity.y;
    ball.angular_velocity.y = std::copysign(std::max(0.0, std::abs(spin) - settings.spin_deceleration * seconds), spin);
}

}  // namespace aleph
