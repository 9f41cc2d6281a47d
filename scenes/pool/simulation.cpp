#include "scenes/pool/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/base/errors.h"

namespace aleph {

namespace {

const glm::dvec3 cushion_normals[] = {{1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}};

// m/s; slower approaches are rounding, not motion: less than a tenth of a micrometre in a minute.
constexpr double still_speed = 1e-10;
// Far more than a rack needs; reached only if contacts do not end.
constexpr int most_events_per_step = 100000;
constexpr int no_ball = -1;

void move_freely(PoolBall& ball, double seconds) {
    ball.position += ball.velocity * seconds;
    const double rate = glm::length(ball.angular_velocity);
    if (rate == 0.0) return;
    const double half = 0.5 * rate * seconds;
    const glm::dvec3 v = ball.angular_velocity * (std::sin(half) / rate);
    ball.orientation = glm::normalize(glm::dquat(std::cos(half), v.x, v.y, v.z) * ball.orientation);
}

/// The earliest collision within a time; first = -1 if there is none.
struct Contact {
    double seconds = 0.0;
    int first = -1, second = no_ball;
    glm::dvec3 normal{0.0};  ///< of the cushion
};

void find_cushion_contact(const std::vector<PoolBall>& balls, int i, const PoolSettings& settings, Contact& best) {
    const PoolBall& ball = balls[i];
    const glm::dvec3 half(0.5 * settings.length, 0.0, 0.5 * settings.width);
    for (const glm::dvec3& normal : cushion_normals) {
        const double approach = -glm::dot(ball.velocity, normal);
        if (approach <= still_speed) continue;
        const double gap = glm::dot(half, glm::abs(normal)) - settings.radius + glm::dot(ball.position, normal);
        const double seconds = std::max(0.0, gap / approach);
        if (seconds < best.seconds) best = {seconds, i, no_ball, normal};
    }
}

void find_ball_contact(const std::vector<PoolBall>& balls, int i, int j, const PoolSettings& settings, Contact& best) {
    const PoolBall& a = balls[i];
    const PoolBall& b = balls[j];
    const glm::dvec3 apart = b.position - a.position;
    const glm::dvec3 relative = b.velocity - a.velocity;
    const double towards = -glm::dot(apart, relative);
    if (towards <= still_speed * glm::length(apart)) return;
    const double gap = glm::dot(apart, apart) - 4.0 * settings.radius * settings.radius;
    const double discriminant = towards * towards - glm::dot(relative, relative) * gap;
    if (discriminant < 0.0) return;
    const double seconds = std::max(0.0, gap / (towards + std::sqrt(discriminant)));
    if (seconds < best.seconds) best = {seconds, i, j, {}};
}

Contact find_contact(const std::vector<PoolBall>& balls, double within, const PoolSettings& settings) {
    Contact best;
    best.seconds = within;
    const int count = static_cast<int>(balls.size());
    for (int i = 0; i < count; ++i) {
        find_cushion_contact(balls, i, settings, best);
        for (int j = i + 1; j < count; ++j) find_ball_contact(balls, i, j, settings, best);
    }
    return best;
}

/// The ball hit and all that touch it, directly or through others, in order of index.
std::vector<int> find_touching(const std::vector<PoolBall>& balls, int start, const PoolSettings& settings) {
    std::vector<int> members = {start};
    const double reach = 2.0 * settings.radius + settings.touching_gap;
    for (std::size_t next = 0; next < members.size(); ++next) {
        const glm::dvec3& position = balls[members[next]].position;
        for (int i = 0; i < static_cast<int>(balls.size()); ++i) {
            if (glm::distance(position, balls[i].position) > reach) continue;
            if (std::find(members.begin(), members.end(), i) == members.end()) members.push_back(i);
        }
    }
    std::sort(members.begin(), members.end());
    return members;
}

void advance(std::vector<PoolBall>& balls, double step, const PoolSettings& settings) {
    for (PoolBall& ball : balls) apply_cloth_friction(ball, step, settings);
    double done = 0.0;
    for (int count = 0;; ++count) {
        ALEPH_CHECK(count < most_events_per_step, fmt::format("{} collisions", count));
        const Contact contact = find_contact(balls, step - done, settings);
        for (PoolBall& ball : balls) move_freely(ball, contact.seconds);
        if (contact.first < 0) return;
        done += contact.seconds;
        if (contact.second == no_ball) {
            collide_cushion(balls[contact.first], contact.normal, settings);
        } else {
            collide_balls(balls, find_touching(balls, contact.first, settings), settings);
        }
    }
}

}  // namespace

PoolRun simulate_pool(std::vector<PoolBall> balls, const PoolSettings& settings, double duration,
                      double samples_per_second) {
    PoolRun run;
    run.samples_per_second = samples_per_second;
    run.samples.push_back(balls);
    // Whole sub-steps between samples, so that a sample is a simulated state.
    const auto steps = static_cast<int>(std::ceil(1.0 / (samples_per_second * settings.step) - 1e-6));
    const double step = 1.0 / (samples_per_second * steps);
    const auto count = static_cast<int>(std::floor(duration * samples_per_second + 1e-6));
    for (int i = 0; i < count; ++i) {
        for (int k = 0; k < steps; ++k) advance(balls, step, settings);
        run.samples.push_back(balls);
    }
    return run;
}

}  // namespace aleph
