#include "render/time/shutter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/pose/parts.h"

namespace aleph {

namespace {

/// Frames. A step of a track takes no time, a jump of a baked one up to half of this (baked_track.h).
constexpr double before_cut = 1.0 / 2048.0;
constexpr double least_jump = 4.0;  // of what the camera moves in the frame before and in the one after

/// Changes of a camera from one time to another: place, direction, and lens.
std::array<double, 3> measure_move(const CameraValues& a, const CameraValues& b) {
    double turn = 0.0;
    for (int i = 0; i < 3; ++i) turn += glm::distance(a.axes[i], b.axes[i]);
    return {glm::distance(a.position, b.position), turn,
            std::abs(a.fov - b.fov) + std::abs(a.half_height - b.half_height)};
}

/// Returns whether a move is a jump that takes time: what is left of it just before its end is little of it.
bool is_crossed(const Scene& scene, int camera, std::int64_t cut) {
    const int node = find_camera_node(scene, camera);
    const auto look = [&](double frame) {
        const double seconds = frame / scene.film.frame_rate.per_second();
        return pose_camera(scene, node, place_nodes(scene, seconds).world[node], seconds);
    };
    const double at = static_cast<double>(cut);
    const CameraValues last = look(at - 1.0), first = look(at);
    const auto all = measure_move(last, first), rest = measure_move(look(at - before_cut), first),
               before = measure_move(look(at - 2.0), last), after = measure_move(first, look(at + 1.0));
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i] > least_jump * std::max(before[i], after[i]) && rest[i] < 0.5 * all[i]) return true;
    }
    return false;
}

}  // namespace

std::vector<std::int64_t> find_crossed_cuts(const Scene& scene, const std::function<int(std::int64_t)>& camera) {
    std::vector<std::int64_t> crossed;
    const auto is_open = [](const Camera& c) { return c.shutter != glm::dvec2(0.0); };
    if (std::ranges::none_of(scene.cameras, is_open)) return crossed;
    for (const std::int64_t cut : scene.film.cuts) {
        if (camera(cut - 1) == camera(cut) && is_crossed(scene, camera(cut), cut)) crossed.push_back(cut);
    }
    return crossed;
}

std::optional<ShutterInterval> find_shutter(const Scene& scene, const glm::dvec2& relative, std::int64_t frame,
                                            const std::vector<std::int64_t>& crossed) {
    if (relative == glm::dvec2(0.0)) return std::nullopt;
    const double now = static_cast<double>(frame);
    ShutterInterval shutter{now + relative.x, now + relative.y};
    for (const std::int64_t cut : scene.film.cuts) {
        const double at = static_cast<double>(cut);
        if (cut <= frame) {
            shutter.open = std::max(shutter.open, at);
            shutter.close = std::max(shutter.close, at);
            continue;
        }
        const double end = std::ranges::find(crossed, cut) != crossed.end() ? at - 1.0 : at - before_cut;
        shutter.close = std::min(shutter.close, end);
        // All of it lies in the next shot: the last keyframe of this one.
        shutter.open = std::min(shutter.open, shutter.close);
    }
    return shutter;
}

double find_shutter_center(const Scene& scene, const glm::dvec2& shutter, std::int64_t frame,
                           const std::vector<std::int64_t>& crossed) {
    const double now = static_cast<double>(frame);
    double offset = 0.5 * (shutter.x + shutter.y);  // exactly 0 for a centred shutter
    const std::optional<ShutterInterval> left = find_shutter(scene, shutter, frame, crossed);
    if (left && !(left->open <= now + offset && now + offset < left->close)) {
        offset = 0.5 * (left->open + left->close) - now;
    }
    return scene.film.frame_rate.seconds_of(frame) + offset / scene.film.frame_rate.per_second();
}

}  // namespace aleph
