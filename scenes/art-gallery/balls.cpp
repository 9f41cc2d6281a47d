#include "scenes/art-gallery/balls.h"

#include <glm/geometric.hpp>

namespace aleph {

std::vector<MotionKey<glm::dvec3>> simulate_drop(const BallDrop& drop, double until) {
    const glm::dvec3 down(0.0, -gravity, 0.0);
    const double rest = drop.ground + drop.radius;
    std::vector<MotionKey<glm::dvec3>> keys;
    keys.push_back({drop.release, glm::dvec3(0.0), drop.position, drop.velocity});
    while (true) {
        const MotionKey<glm::dvec3>& last = keys.back();
        const double v = last.after.y;
        const double flight = (v + std::sqrt(v * v + 2.0 * gravity * (last.value.y - rest))) / gravity;
        if (last.seconds + flight >= until) {
            const double t = until - last.seconds;
            const glm::dvec3 velocity = last.after + down * t;
            keys.push_back({until, velocity, last.value + last.after * t + 0.5 * t * t * down, velocity});
            return keys;
        }
        MotionKey<glm::dvec3> impact;
        impact.seconds = last.seconds + flight;
        impact.before = last.after + down * flight;
        impact.value = last.value + last.after * flight + 0.5 * flight * flight * down;
        impact.value.y = rest;
        impact.after = impact.before * glm::dvec3(drop.grip, -drop.restitution, drop.grip);
        const bool settled = impact.after.y < drop.settled_speed;
        if (settled) impact.after.y = 0.0;
        keys.push_back(impact);
        if (settled) break;
    }
    const MotionKey<glm::dvec3> last = keys.back();
    const double speed = glm::length(last.after), time = speed / drop.rolling;
    if (speed == 0.0) return keys;
    const double t = std::min(time, until - last.seconds);
    const glm::dvec3 slowing = -drop.rolling * last.after / speed;
    const glm::dvec3 velocity = t < time ? last.after + slowing * t : glm::dvec3(0.0);
    keys.push_back({last.seconds + t, velocity, last.value + last.after * t + 0.5 * t * t * slowing, velocity});
    return keys;
}

std::vector<MotionKey<double>> simulate_spin(const BallDrop& drop, const std::vector<MotionKey<glm::dvec3>>& path) {
    const auto rolling = [&](const glm::dvec3& velocity) { return std::hypot(velocity.x, velocity.z) / drop.radius; };
    std::vector<MotionKey<double>> keys;
    double angle = 0.0;
    for (std::size_t i = 0; i < path.size(); ++i) {
        MotionKey<double> key{path[i].seconds, 0.0, 0.0, rolling(path[i].after)};
        if (i > 0) {
            const bool flies = path[i].before.y != 0.0;
            key.before = flies ? keys.back().after : rolling(path[i].before);
            angle += 0.5 * (keys.back().after + key.before) * (path[i].seconds - path[i - 1].seconds);
        }
        key.value = angle;
        keys.push_back(key);
    }
    return keys;
}

}  // namespace aleph
