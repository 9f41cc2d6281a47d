#include "tests/perception/grating.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/all_pixels.h"

namespace aleph {

namespace {

/// P(u) of expanded_level.
double level_transfer(int level, double u) {
    double product = 1.0;
    for (int j = 0; j < level; ++j) product *= kernel_transfer(std::ldexp(u, j));
    return product;
}

}  // namespace

double Grating::angular() const {
    return std::numbers::pi * half_cycles / span;
}

double Grating::frequency(double pixels_per_degree) const {
    return half_cycles * pixels_per_degree / (2.0 * span);
}

double Grating::value(int x) const {
    return mean * (1.0 + contrast * std::cos(angular() * x));
}

int nearest_half_cycles(double rho, double pixels_per_degree) {
    const double half_cycles = std::round(2.0 * Grating::span * rho / pixels_per_degree);
    return static_cast<int>(std::clamp(half_cycles, 1.0, static_cast<double>(Grating::span)));
}

Image<Rgb> make_grating(const Grating& grating) {
    Image<Rgb> picture(Grating::width, Grating::height);
    for (const auto [x, y] : all_pixels(picture)) picture(x, y) = Rgb(static_cast<float>(grating.value(x)));
    return picture;
}

double kernel_transfer(double w) {
    return 0.4 + 0.5 * std::cos(w) + 0.1 * std::cos(2.0 * w);
}

double expanded_level(int level, double w, int x) {
    const int aliases = 1 << level;
    double sum = 0.0;
    for (int a = 0; a < aliases; ++a) {
        const double u = w + 2.0 * std::numbers::pi * a / aliases;
        sum += level_transfer(level, u) * std::cos(u * x);
    }
    return level_transfer(level, w) * sum;
}

std::array<double, band_count> exact_bands(double w, int x) {
    std::array<double, band_count> bands{};
    double finer = expanded_level(0, w, x);
    for (int i = 0; i < band_count; ++i) {
        const double coarser = expanded_level(i + 1, w, x);
        bands[i] = std::abs(finer - coarser);
        finer = coarser;
    }
    return bands;
}

double exact_adaptation(const Grating& grating, int x, double pixels_per_degree) {
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
