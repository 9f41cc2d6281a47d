#include "render/pixels/pixel_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace aleph {

namespace {

constexpr double radius = 1.5;  // pixels, of the Blackman-Harris window
constexpr int steps = 512;

/// Integral of the window (Harris 1978, four terms) from -radius to x, over the whole.
double cumulative(double x) {
    constexpr std::array<double, 4> a{0.35875, 0.48829, 0.14128, 0.01168};
    const double t = (x + radius) / (2.0 * radius), turn = 2.0 * std::numbers::pi;
    double sum = a[0] * t;
    sum -= a[1] * std::sin(turn * t) / turn;
    sum += a[2] * std::sin(2.0 * turn * t) / (2.0 * turn);
    sum -= a[3] * std::sin(3.0 * turn * t) / (3.0 * turn);
    return sum / a[0];
}

double invert(double u) {
    double low = -radius, high = radius;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (cumulative(middle) < u ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

std::array<double, steps + 1> make_inverse() {
    std::array<double, steps + 1> table;
    for (int i = 0; i <= steps; ++i) table[i] = invert(static_cast<double>(i) / steps);
    table.front() = -radius;
    table.back() = radius;
    return table;
}

}  // namespace

double place_in_filter(PixelFilter filter, double u) {
    if (filter == PixelFilter::box) return u - 0.5;
    static const std::array<double, steps + 1> inverse = make_inverse();
    const double place = std::clamp(u, 0.0, 1.0) * steps;
    const int i = std::min(static_cast<int>(place), steps - 1);
    return inverse[i] + (inverse[i + 1] - inverse[i]) * (place - i);
}

}  // namespace aleph
