#pragma once
// Pictures for tests of image-based motion. Each is a function of the point, so that it can be moved.

#include <cmath>
#include <cstdint>

#include "engine/base/color.h"
#include "engine/base/image.h"
#include "engine/base/sampling.h"
#include "tests/support/all_pixels.h"

namespace aleph {

/// A picture of value(x, y) in grey, sampled at whole pixels.
template <class Value>
Image<Rgb> make_pattern(int width, int height, const Value& value) {
    Image<Rgb> image(width, height);
    for (const auto [x, y] : all_pixels(width, height)) image(x, y) = Rgb(static_cast<float>(value(x, y)));
    return image;
}

/// A number in [0, 1) for every lattice point, without any relation between neighbours.
inline double white_noise(int x, int y, std::uint32_t seed = 1) {
    return RandomStream(RandomKey{seed, 0, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)}).at(0);
}

/// Smooth texture: white noise on a lattice of `cell` pixels, blended between, plus the same twice as fine.
inline double smooth_texture(double x, double y, double cell = 6.0) {
    const auto blend = [](double px, double py, std::uint32_t seed) {
        const double fx = std::floor(px), fy = std::floor(py);
        const auto ease = [](double t) { return t * t * (3.0 - 2.0 * t); };
        const double u = ease(px - fx), v = ease(py - fy);
        const auto at = [&](int dx, int dy) {
            return white_noise(static_cast<int>(fx) + dx, static_cast<int>(fy) + dy, seed);
        };
        return (1.0 - v) * ((1.0 - u) * at(0, 0) + u * at(1, 0)) + v * ((1.0 - u) * at(0, 1) + u * at(1, 1));
    };
    return 0.1 + 0.5 * blend(x / cell, y / cell, 7) + 0.3 * blend(2.0 * x / cell, 2.0 * y / cell, 8);
}

}  // namespace aleph
