#pragma once
// Pictures of sinusoidal gratings, and what the bands of the vision model (Yee 2000, 5.2) respond to them, in closed
// form.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/base/color.h"
#include "perception/vision/band_frequencies.h"
#include "tests/support/all_pixels.h"

namespace aleph {

/// A grating of vertical stripes, mean (1 + contrast cos(w x)), x from the left pixel. Whole half cycles lie between
/// the first and the last of its 2^10 + 1 pixels: the border, which reflects, continues it at every pyramid level, so
/// that it is endless for the filters.
struct Grating {
    static constexpr int span = 1024;  ///< pixels from the first to the last
    static constexpr int width = span + 1;
    static constexpr int height = 33;  ///< the middle row sees a whole disc of half a degree at 31 pixels per degree
    static constexpr int middle = height / 2;

    int half_cycles = 1;    ///< 1 to span
    double mean = 0.5;      ///< white = 1
    double contrast = 0.5;  ///< (highest - lowest) / (highest + lowest)

    /// w, radians per pixel.
    double angular() const { return std::numbers::pi * half_cycles / span; }
    double value(int x) const { return mean * (1.0 + contrast * std::cos(angular() * x)); }
};

/// The half cycles of the grating nearest to a frequency, cycles per degree.
inline int nearest_half_cycles(double rho, double pixels_per_degree) {
    const double half_cycles = std::round(2.0 * Grating::span * rho / pixels_per_degree);
    return static_cast<int>(std::clamp(half_cycles, 1.0, static_cast<double>(Grating::span)));
}

inline Image<Rgb> make_grating(const Grating& grating) {
    Image<Rgb> picture(Grating::width, Grating::height);
    for (const auto [x, y] : all_pixels(picture)) picture(x, y) = Rgb(static_cast<float>(grating.value(x)));
    return picture;
}

/// P(u) of expanded_level.
inline double level_transfer(int level, double u) {
    double product = 1.0;
    for (int j = 0; j < level; ++j) {
        // The transfer function of the kernel {.05 .25 .4 .25 .05} (Burt and Adelson 1983).
        const double w = std::ldexp(u, j);
        product *= 0.4 + 0.5 * std::cos(w) + 0.1 * std::cos(2.0 * w);
    }
    return product;
}

/// Gaussian level `level`, expanded to full size, of cos(w x) at pixel x. Exact: with H the kernel's transfer function,
///     A(i) = sum over a = 0 .. 2^i - 1 of P(w) P(w + 2 pi a / 2^i) cos((w + 2 pi a / 2^i) x),
///     P(u) = H(u) H(2 u) ... H(2^(i-1) u):
/// taking every second sample keeps the phase on the samples that stay, and inserting zeros adds the alias at u + pi.
inline double expanded_level(int level, double w, int x) {
    const int aliases = 1 << level;
    double sum = 0.0;
    for (int a = 0; a < aliases; ++a) {
        const double u = w + 2.0 * std::numbers::pi * a / aliases;
        sum += level_transfer(level, u) * std::cos(u * x);
    }
    return level_transfer(level, w) * sum;
}

/// |A(i) - A(i+1)| at pixel x for cos(w x); the mean of a picture adds nothing, because H(0) = 1 and H(pi) = 0.
inline std::array<double, band_count> exact_bands(double w, int x) {
    std::array<double, band_count> bands{};
    double finer = expanded_level(0, w, x);
    for (int i = 0; i < band_count; ++i) {
        const double coarser = expanded_level(i + 1, w, x);
        bands[i] = std::abs(finer - coarser);
        finer = coarser;
    }
    return bands;
}

/// Mean luminance of the pixels within half a degree of pixel x in the middle row, white = 1: a sum over the disc.
inline double exact_adaptation(const Grating& grating, int x, double pixels_per_degree) {
    const double radius = pixels_per_degree / 2.0;
    const int reach = static_cast<int>(radius);
    double sum = 0.0, pixels = 0.0;
    for (int at = std::max(0, x - reach); at <= std::min(Grating::span, x + reach); ++at) {
        const double across = at - x;
        const int rows = std::min(static_cast<int>(std::sqrt(radius * radius - across * across)), Grating::middle);
        sum += (2.0 * rows + 1.0) * grating.value(at);
        pixels += 2.0 * rows + 1.0;
    }
    return sum / pixels;
}

}  // namespace aleph
