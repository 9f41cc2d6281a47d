#include "tests/support/vision_formulas.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "perception/vision/castle.h"
#include "perception/vision/display_hold.h"
#include "tests/support/numbers.h"

namespace aleph {

namespace {

double kelly_gain(double v, double c2) {
    return 6.1 + 7.3 * std::pow(std::abs(std::log10(c2 * v / 3.0)), 3.0);
}

/// (5.9)
double kelly_elevation(double rho, double v, double peak, double (*sensitivity)(double, double)) {
    if (rho <= peak) return 1.0;
    return std::max(1.0, sensitivity(peak, v) / std::max(1.0, sensitivity(rho, v)));
}

double square(double x) {
    return x * x;
}

/// The sustained channel's constants.
constexpr double sustained_width = 0.000213047, sustained_cut = 0.100207;
constexpr double sustained_area = 157.103, sustained_corner = 0.702338;

double sustained_peak_frequency(double l) {
    return 1.78119 * std::pow(1.0 + 91.5718 / l, -0.256682);
}

double critical_area(double rho, double area, double corner) {
    return area / (1.0 + square(rho / corner));
}

double sustained(double rho, double l) {
    const double gain =
        56.4947 * std::pow(1.0 + 7.54726 / l, -0.144532) * (1.0 - std::exp(-9.66862e9 * std::log1p(5.58341e-7 / l)));
    const double peak = sustained_peak_frequency(l);
    double shape = std::exp(-std::numbers::ln10 * square(std::log10(rho / peak)) / std::pow(2.0, sustained_width));
    if (rho < peak) shape = std::max(shape, 1.0 - sustained_cut);
    const double area = critical_area(rho, sustained_area, sustained_corner);
    return gain * shape * rho * std::sqrt(area / (1.0 + area));
}

double transient(double rho, double l) {
    const double gain = 2748.09 * std::pow(l, 0.193434);
    double shape = std::exp(-std::numbers::ln10 * square(std::log10(rho / 0.000316696)) / std::pow(2.0, 2.6761));
    if (rho < 0.000316696) shape = std::max(shape, 1.0 - 0.000241177);
    const double area = critical_area(rho, 3.81611, 3.01389);
    return gain * shape * rho * std::sqrt(area / (1.0 + area));
}

/// Share of its contrast that a pattern keeps behind a blur of `width` degrees.
double blur_transfer(double rho, double width) {
    if (width == 0.0) return 1.0;
    const double w = pi / (2.0 * width);
    return w * w / (w * w + 4.0 * rho * rho);
}

double hold(double rho, const EyeMotion& motion) {
    return blur_transfer(rho, motion.tracked / 30.0) * blur_transfer(rho, 0.001648 * motion.tracked + 0.079818) /
           blur_transfer(rho, 0.079818);
}

}  // namespace

double written_retinal_velocity(double v, double s) {
    return std::max(std::abs(v - std::min(s * v + 0.15, 80.0)), 0.15);
}

double written_tracked_velocity(double v, double s) {
    return std::min(s * v, 80.0);
}

double written_thesis_sensitivity(double rho, double v) {
    constexpr double c0 = 1.14, c1 = 0.67, c2 = 1.7;
    v = std::max(v, 0.15);
    return kelly_gain(v, c2) * c0 * c2 * v * square(2.0 * pi * rho * c1) *
           std::exp(-4.0 * pi * c1 * rho * (c2 * v + 2.0) / 45.9);
}

double written_laird_sensitivity(double rho, double v) {
    constexpr double c0 = 0.6329, c1 = 0.8404, c2 = 0.7986;
    v = std::max(v, 0.3);
    return kelly_gain(v, c2) * c0 * c1 * c2 * v * square(2.0 * pi * rho * c1) *
           std::exp(-4.0 * pi * c1 * rho * (c2 * v + 2.0) / 45.9);
}

double written_thesis_peak(double v) {
    return 45.9 / (1.7 * std::max(v, 0.15) + 2.0) / (2.0 * pi * 0.67);
}

double written_laird_peak(double v) {
    return 45.9 / (0.7986 * std::max(v, 0.3) + 2.0) / (2.0 * pi * 0.8404);
}

double written_castle_sensitivity(double rho, double omega, double luminance) {
    const double peak = std::max(0.0, 2.41482 * std::log10(luminance) + 4.7036);
    const double away = std::pow(omega, 0.1898) - std::pow(peak, 0.1898);
    return std::exp(-std::pow(omega, 1.3314) / 10.5795) * sustained(rho, luminance) +
           std::exp(-away * away / 0.0844836) * transient(rho, luminance);
}

double written_castle_peak(double luminance) {
    // Above the parabola's peak, d log S / d log rho falls from above 0 without end.
    const double start = sustained_peak_frequency(luminance);
    const auto slope = [&](double rho) {
        const double q = square(rho / sustained_corner);
        const double area = critical_area(rho, sustained_area, sustained_corner);
        return 1.0 - 2.0 * std::log10(rho / start) / std::pow(2.0, sustained_width) - q / (1.0 + q) / (1.0 + area);
    };
    double low = std::log(start), high = std::log(100.0 * start);
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (slope(std::exp(middle)) > 0.0 ? low : high) = middle;
    }
    return sustained(std::exp(low), luminance);
}

double written_elevation(const VisionModel* vision, double rho, const EyeMotion& motion) {
    const double v = motion.retinal;
    if (vision == &thesis_vision()) return kelly_elevation(rho, v, written_thesis_peak(v), written_thesis_sensitivity);
    if (vision == &laird_vision()) return kelly_elevation(rho, v, written_laird_peak(v), written_laird_sensitivity);
    const double seen = written_castle_sensitivity(rho, rho * motion.retinal, motion.luminance) * hold(rho, motion);
    return std::max(1.0, written_castle_peak(motion.luminance) / std::max(1.0, seen));
}

double written_tvi(double luminance) {
    const double l = std::log10(std::clamp(luminance, 1e-6, 1e12));
    double t = -2.86;
    if (l >= -3.94) t = std::pow(0.405 * l + 1.6, 2.18) - 2.86;
    if (l >= -1.44) t = l - 0.395;
    if (l >= -0.0184) t = std::pow(0.249 * l + 0.65, 2.7) - 0.72;
    if (l >= 1.9) t = l - 1.255;
    return std::pow(10.0, t);
}

double castle_elevation(double rho, double retinal, double tracked, double luminance, double persistence,
                        const FrameRate& frame_rate) {
    const double moving = std::fmin(std::fmax(rho, 0.0), 1e30) * std::fmin(std::fmax(retinal, 0.0), 1e30);
    const double sensitivity =
        castle_sensitivity(rho, moving, luminance) * hold_transfer(rho, tracked, persistence, frame_rate);
    return std::max(1.0, castle_peak(luminance) / std::max(sensitivity, 1.0));
}

double row_elevation(const VisionModel& vision, const Stimulus& stimulus, const Presentation& shown) {
    std::array<double, band_count> rho;
    rho.fill(stimulus.frequency);
    const auto retinal = static_cast<float>(stimulus.retinal), tracked = static_cast<float>(stimulus.tracked),
               luminance = static_cast<float>(stimulus.luminance);
    const auto row = vision.make_rows(rho, shown)(1);
    row->load({&retinal, &tracked, vision.uses_luminance() ? &luminance : nullptr});
    float f = 0.0f;
    row->elevations(0, &f);
    return f;
}

}  // namespace aleph
