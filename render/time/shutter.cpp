#include "render/time/shutter.h"

#include <algorithm>
#include <cmath>

namespace aleph {

namespace {

/// Frames. Keys take in times that are nearly theirs (find_samples), so the double before a cut belongs to its shot.
constexpr double before_cut = 1e-6;

}  // namespace

std::optional<ShutterInterval> find_shutter(const Scene& scene, const glm::dvec2& relative, std::int64_t frame) {
    if (relative == glm::dvec2(0.0)) return std::nullopt;
    const double now = static_cast<double>(frame);
    ShutterInterval shutter{now + relative.x, now + relative.y};
    for (const std::int64_t cut : scene.film.cuts) {
        const double at = static_cast<double>(cut);
        if (cut <= frame) {
            shutter.open = std::max(shutter.open, at);
            shutter.close = std::max(shutter.close, at);
        } else if (shutter.close > at || shutter.open >= at) {
            shutter.close = at;
            // All of it lies in the next shot: the last keyframe of this one.
            if (shutter.open >= at) shutter.open = shutter.close = at - before_cut;
        }
    }
    return shutter;
}

double find_shutter_center(const Scene& scene, const glm::dvec2& shutter, std::int64_t frame) {
    const double now = static_cast<double>(frame);
    double offset = 0.5 * (shutter.x + shutter.y);  // exactly 0 for a centred shutter
    const std::optional<ShutterInterval> left = find_shutter(scene, shutter, frame);
    if (left && !(left->open <= now + offset && now + offset < left->close)) {
        offset = 0.5 * (left->open + left->close) - now;
    }
    return scene.film.frame_rate.seconds_of(frame) + offset / scene.film.frame_rate.per_second();
}

double place_in_shutter(const ShutterInterval& shutter, int index, int pixel_class, double shift) {
    // sqrt 2 - 1: even by itself and, unlike the golden ratio, together with the lattice of places in a pixel.
    constexpr double step = 0.41421356237309505;
    constexpr double class_step = 0.357;  // found by trial: the widest gap of all classes is 1.9 times the mean one
    const double at = shift + step * index + class_step * pixel_class;
    return shutter.open + (shutter.close - shutter.open) * (at - std::floor(at));
}

}  // namespace aleph
