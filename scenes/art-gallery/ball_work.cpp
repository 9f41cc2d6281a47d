// Balls that fall under a ring, or roll off their plinths, bounce and come to rest. Between impacts the path is a
// parabola, which a cubic track through the positions and velocities at the impacts represents exactly.

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/art-gallery/gallery.h"
#include "scenes/common/build.h"
#include "scenes/common/keys.h"

namespace aleph {

namespace {

// Nine balls hang from a ring and fall one after the other.
const glm::dvec3 ring_place(-3.55, 0.0, 1.75);
constexpr double ring_radius = 0.95, ring_height = 2.62, ring_base = 0.08;
constexpr int ring_balls = 9;

glm::dvec3 ring_point(int i) {
    const double angle = 2.0 * pi * i / ring_balls;
    return ring_place + ring_radius * glm::dvec3(std::sin(angle), 0.0, std::cos(angle));
}

/// Keys at release, impacts and rest; between two keys the acceleration is constant.
/// @param until  s; the last key, if the ball is not at rest before
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

/// Angle about the axis of rolling along the path, radians: the spin is constant in the air, and becomes that of
/// rolling at every impact.
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

}  // namespace

std::vector<BallDrop> make_ball_drops() {
    const double releases[] = {-2.9, -0.7, 1.6, 4.4, 8.0, 12.2, 15.4, 17.1, 18.8};
    std::vector<BallDrop> drops;
    for (int i = 0; i < ring_balls; ++i) {
        BallDrop drop;
        drop.release = releases[i];
        drop.radius = 0.1 + 0.015 * (i % 3);
        // Balls that fall one after the other are not neighbours.
        drop.position =
            to_millionth(ring_point(i * 4 % ring_balls)) + glm::dvec3(0.0, ring_height - 0.12 - drop.radius, 0.0);
        drop.ground = ring_base;
        drop.restitution = 0.91 - 0.02 * (i % 3);
        drops.push_back(drop);
    }
    // Two roll off their plinths: one down the hall, later one out of the cabinet.
    BallDrop beach;
    beach.release = 2.4;
    beach.position = {5.6, 1.1, 0.2};
    beach.velocity = {-1.3, 0.0, 0.0};
    beach.radius = 0.2;
    beach.restitution = 0.82;
    beach.grip = 0.985;
    beach.rolling = 0.16;
    drops.push_back(beach);
    BallDrop late = beach;
    late.release = 19.8;
    late.position = {-9.4, 1.05, -0.72};
    late.velocity = {1.0, 0.0, 0.0};
    late.radius = 0.15;
    drops.push_back(late);
    return drops;
}

void add_ball_work(Scene& scene, const GalleryMaterials& materials) {
    const Group work = Group{scene}.add_group("ball_work");
    const Profile base_outline = {{0.0, 0.0},    {1.3, 0.0},         {1.3, 0.0},         {1.3, 0.05},
                                  {1.29, 0.072}, {1.265, ring_base}, {1.265, ring_base}, {0.0, ring_base}};
    work.add_shape("ball_base", lathe(base_outline, 96), materials.plinth, ring_place);
    work.add_shape("ball_ring", torus(ring_radius, 0.035, 96), materials.steel,
                   ring_place + glm::dvec3(0.0, ring_height, 0.0));
    for (int i = 0; i < 3; ++i) {
        const double angle = 2.0 * pi * (i + 0.5) / 3.0;
        const glm::dvec3 at =
            to_millionth(ring_place + ring_radius * glm::dvec3(std::sin(angle), 0.0, std::cos(angle)));
        work.add_rod(fmt::format("ball_post_{}", i), at + glm::dvec3(0.0, ring_base, 0.0),
                     at + glm::dvec3(0.0, ring_height, 0.0), 0.016, materials.steel, 16);
    }
    for (int i = 0; i < ring_balls; ++i) {
        const glm::dvec3 at = to_millionth(ring_point(i)) + glm::dvec3(0.0, ring_height, 0.0);
        work.add_rod(fmt::format("ball_holder_{}", i), at - glm::dvec3(0.0, 0.11, 0.0), at, 0.02, materials.steel, 16);
    }

    const Group balls = Group{scene}.add_group("balls");
    const std::vector<BallDrop> drops = make_ball_drops();
    for (std::size_t i = 0; i < drops.size(); ++i) {
        const std::string name = fmt::format("ball_{}", i);
        const bool rolls = glm::length(drops[i].velocity) > 0.0;
        const int texture = rolls ? (i % 2 == 1 ? 0 : 2) : static_cast<int>(i) % 5 + 1;
        const int material = add_textured(scene, name, fmt::format("ball_{}", texture), 0.3);
        const int index = balls.add_shape(name, sphere(drops[i].radius), material);
        const auto path = simulate_drop(drops[i], gallery_seconds);
        scene.nodes[index].transform.translation = cubic_track(path);
        if (rolls) {
            const double height = drops[i].position.y - drops[i].radius;
            work.add_shape(name + "_plinth", box({0.34, height, 0.34}), materials.plinth,
                           {drops[i].position.x, 0.5 * height, drops[i].position.z});
            const glm::dvec3 v = drops[i].velocity;
            turn_about(scene, index, glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), v)),
                       cubic_track(simulate_spin(drops[i], path)));
        } else {
            // Spin about the vertical axis is not changed by impacts; it ends with the bouncing.
            const double spin = (i % 2 == 0 ? 1.0 : -1.0) * (2.2 + 0.4 * static_cast<double>(i));
            const double from = path.front().seconds, time = path.back().seconds - from;
            turn_about(
                scene, index, {0.0, 1.0, 0.0},
                cubic_track<double>({{from, 0.0, 0.0, spin}, {from + time, 0.1 * spin, 0.55 * spin * time, 0.0}}));
        }
    }
}

}  // namespace aleph
