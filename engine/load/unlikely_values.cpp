// Warnings about values that are allowed and probably meant otherwise.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "engine/base/errors.h"
#include "engine/load/warnings.h"
#include "engine/pose/pose.h"
#include "engine/scene/operations.h"
#include "engine/scene/visit.h"

namespace aleph {

namespace {

constexpr double degrees_per_radian = 180.0 / std::numbers::pi;

/// A narrower field of view is a telescope's: 1.8 degrees is a focal length of 764 mm at a film height of 24 mm.
constexpr double least_usual_fov_degrees = 1.8;

template <class Use>
void for_each_key(const Track<double>& track, const Use& use) {
    for (std::size_t key = 0; key < track.key_count(); ++key) use(key_value(track, key));
}

/// True where angles given as degrees are multiples of 15 degrees in radians, such as 1.5708, and at most two turns.
/// @param angles  radians
bool look_like_radians(const std::vector<double>& angles) {
    constexpr double step = std::numbers::pi / 12.0;
    bool all = true, any = false;
    for (const double radians : angles) {
        const double given = radians * degrees_per_radian;
        if (std::abs(given) < 1e-9) continue;
        any = true;
        const double steps = std::round(given / step);
        all = all && steps != 0.0 && std::abs(steps) <= 48.0 && std::abs(given - steps * step) < 2e-4;
    }
    return any && all;
}

/// All keys of a node's axis rotation and of the rotations among its operations, radians.
std::vector<double> find_angles(const Node& node) {
    using Kind = OperationStack::Kind;
    std::vector<double> angles;
    if (node.transform.axis_rotation)
        for_each_key(node.transform.axis_rotation->angle, [&](double angle) { angles.push_back(angle); });
    if (!node.transform.operations) return angles;
    std::size_t channel = 0;
    for (std::size_t sample = 0; sample < sample_count(*node.transform.operations); ++sample) {
        for (const Kind kind : node.transform.operations->operations) {
            channel += channel_count(kind);
            const bool turns =
                kind == Kind::rotate || kind == Kind::rotate_x || kind == Kind::rotate_y || kind == Kind::rotate_z;
            if (turns) angles.push_back(node.transform.operations->channels[channel - 1]);
        }
    }
    return angles;
}

/// One line for all elements that share a mistake.
void add_warning(Scene& scene, const std::vector<std::string>& names, const char* element, const std::string& reason) {
    if (names.empty()) return;
    scene.source.warnings.push_back(fmt::format("{} \"{}\"{}: {}", element, printable(names.front()),
                                                names.size() > 1 ? fmt::format(" and {} more", names.size() - 1) : "",
                                                reason));
}

/// Times of the keys at which a track jumps to another value.
template <class T>
void add_jumps(const Track<T>& track, std::vector<double>& seconds) {
    if (track.interpolation != Interpolation::step) return;
    for (std::size_t key = 1; key < track.key_count(); ++key) {
        if (key_value(track, key) != key_value(track, key - 1)) seconds.push_back(sample_time(track.sampling, key));
    }
}

/// Frames from which the node, or one above it, is elsewhere.
std::set<std::int64_t> find_jumps(const Scene& scene, const Node* node, const FrameRange& range) {
    std::vector<double> seconds;
    for (;; node = &scene.nodes[node->parent]) {
        add_jumps(node->transform.translation, seconds);
        add_jumps(node->transform.rotation, seconds);
        add_jumps(node->transform.scale, seconds);
        if (node->transform.matrix) add_jumps(*node->transform.matrix, seconds);
        if (node->transform.axis_rotation) add_jumps(node->transform.axis_rotation->angle, seconds);
        if (node->parent == no_index) break;
    }
    std::set<std::int64_t> frames;
    for (const double time : seconds) {
        const double frame = std::ceil(time * scene.film.frame_rate.per_second() - 1e-6);
        if (frame > static_cast<double>(range.first) && frame <= static_cast<double>(range.last))
            frames.insert(static_cast<std::int64_t>(frame));
    }
    return frames;
}

}  // namespace

void add_radian_warnings(Scene& scene) {
    std::vector<std::string> rotations, cameras, cones;
    double fov = 0.0;
    for (const Node& node : scene.nodes) {
        if (node.include != no_index) continue;  // other formats have no degrees
        if (look_like_radians(find_angles(node))) rotations.push_back(node.name);
        if (node.light != no_index) {
            std::vector<double> angles;
            for_each_key(scene.lights[node.light].outer_cone, [&](double angle) { angles.push_back(angle); });
            if (look_like_radians(angles)) cones.push_back(node.name);
        }
        if (node.camera == no_index || scene.cameras[node.camera].orthographic) continue;
        double widest = 0.0;
        for_each_key(scene.cameras[node.camera].fov, [&](double v) { widest = std::max(widest, v); });
        widest *= degrees_per_radian;
        if (widest >= least_usual_fov_degrees) continue;
        if (cameras.empty()) fov = widest;
        cameras.push_back(node.name);
    }
    add_warning(scene, cameras, "camera of node",
                fmt::format("a \"fov\" of {:.4g} degrees looks like radians; {:.4g} radians are {:.4g} degrees", fov,
                            fov, fov * degrees_per_radian));
    add_warning(scene, rotations, "node",
                "the degrees of its rotation look like radians; 1.5708 radians are 90 degrees");
    add_warning(scene, cones, "light of node", "its \"outer_cone\" looks like radians; 0.7854 radians are 45 degrees");
}

void add_key_warnings(Scene& scene) {
    const FrameRange range = frame_range(scene);
    const double first = scene.film.frame_rate.seconds_of(range.first),
                 last = scene.film.frame_rate.seconds_of(range.last);
    std::vector<std::string> names;
    for (const Node& node : scene.nodes) {
        bool outside = false;
        visit_tracks(node, [&](const auto& property) {
            const std::vector<double>& times = property.sampling.times;
            if (property.sampling.kind == TimeSampling::Kind::acyclic && is_animated(property))
                outside = outside || times.front() > last || times.back() < first;
        });
        if (outside && node.include == no_index) names.push_back(node.name);
    }
    add_warning(scene, names, "node",
                fmt::format("keys lie outside the frames {} to {}, so they move nothing", range.first, range.last));
}

void add_cut_warnings(Scene& scene) {
    const FrameRange range = frame_range(scene);
    const auto is_outside = [&](std::int64_t cut) { return cut < range.first || cut > range.last; };
    const auto outside = std::ranges::find_if(scene.film.cuts, is_outside);
    if (outside != scene.film.cuts.end()) {
        scene.source.warnings.push_back(
            fmt::format("the cut at frame {} lies outside the frames {} to {}, so it does nothing", *outside,
                        range.first, range.last));
    }
    for (const Node& node : scene.nodes) {
        if (node.camera == no_index) continue;
        std::set<std::int64_t> jumps = find_jumps(scene, &node, range);
        for (const std::int64_t cut : scene.film.cuts) jumps.erase(cut);
        if (jumps.empty()) continue;
        scene.source.warnings.push_back(fmt::format(
            "camera of node \"{}\": step keys move it at frame {}{}, which is not in \"cuts\": every pixel "
            "seems to move there; add \"cuts\": [{}]",
            printable(node.name), *jumps.begin(),
            jumps.size() > 1 ? fmt::format(" and at {} more", jumps.size() - 1) : "",
            fmt::join(
                std::vector(jumps.begin(), std::next(jumps.begin(), std::min<std::ptrdiff_t>(std::ssize(jumps), 8))),
                ", ")));
        break;
    }
}

}  // namespace aleph
