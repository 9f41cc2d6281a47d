#include "perception/vision/castle.h"

#include <algorithm>
#include <cmath>

namespace aleph {

namespace {

constexpr double max_input = 1e30;  // its powers in the formulas stay finite

// std::fmax and std::fmin return the other argument for a NaN; std::clamp would return the NaN.
double clamp_input(double value) {
    return std::fmin(std::fmax(value, 0.0), max_input);
}

double clamp_luminance(double value) {
    return std::fmin(std::fmax(value, castle_min_luminance), castle_max_luminance);
}

/// p0 (1 + p1 / L)^-p2
double saturating_law(double p0, double p1, double p2, double luminance) {
    return p0 * std::exp(-p2 * std::log1p(p1 / luminance));
}

/// A channel's constants that do not depend on luminance.
struct Channel {
    double bandwidth, truncation;  ///< of the parabola over log frequency; below its peak it stays above 1 - truncation
    double area_scale, corner;     ///< A0, square degrees, and f0, cycles per degree, of the summation over area
};
constexpr Channel sustained{0.000213047, 0.100207, 157.103, 0.702338};
constexpr Channel transient{2.6761, 0.000241177, 3.81611, 3.01389};
constexpr double transient_frequency = 0.000316696;  // cycles per degree

/// A channel's spatial sensitivity at unit gain. @param peak  of the parabola, cycles per degree
double evaluate_shape(const Channel& channel, double rho, double peak, double area) {
    if (!(rho > 0.0) || !(area > 0.0)) return 0.0;
    const double decades = std::log10(rho / peak);
    double parabola = std::pow(10.0, -decades * decades / std::exp2(channel.bandwidth));
    if (rho < peak) parabola = std::max(parabola, 1.0 - channel.truncation);
    const double ratio = rho / channel.corner;
    const double critical_area = channel.area_scale / (1.0 + ratio * ratio);
    return parabola * rho * std::sqrt(critical_area / (1.0 + critical_area / area));
}

/// The largest value of a function with one maximum over log frequency, by golden sections.
template <class Function>
double find_maximum(const Function& function) {
    const double shrink = (std::sqrt(5.0) - 1.0) / 2.0;
    double low = std::log(0.02), high = std::log(40.0);
    double a = high - shrink * (high - low), b = low + shrink * (high - low);
    double at_a = function(std::exp(a)), at_b = function(std::exp(b));
    for (int i = 0; i < 40; ++i) {
        if (at_a < at_b) {
            low = a, a = b, at_a = at_b;
            b = low + shrink * (high - low), at_b = function(std::exp(b));
        } else {
            high = b, b = a, at_b = at_a;
            a = high - shrink * (high - low), at_a = function(std::exp(a));
        }
    }
    return std::max(at_a, at_b);
}

/// A chromatic mechanism: a low-pass filter over frequency.
struct Mechanism {
    double temporal_power, temporal_scale;
    double gain[3];  ///< of saturating_law
    double peak;     ///< of the parabola, cycles per degree
    Channel shape;
};
constexpr Mechanism red_green{
    1.15591, 16.4325, {681.434, 38.0038, 0.480386}, 0.0178364, {2.42104, 0.0, 2816.44, 0.0711058}};
constexpr Mechanism yellow_violet{
    0.969123, 7.15012, {166.683, 62.8974, 0.41193}, 0.00425753, {2.68197, 0.0, 2.82789e7, 0.000635093}};

double evaluate_mechanism(const Mechanism& m, double rho, double omega, double luminance, double area) {
    const double response = std::exp(-std::pow(clamp_input(omega), m.temporal_power) / m.temporal_scale);
    return response * saturating_law(m.gain[0], m.gain[1], m.gain[2], clamp_luminance(luminance)) *
           evaluate_shape(m.shape, clamp_input(rho), m.peak, std::fmax(area, 0.0));
}

double transient_gain(double luminance) {
    return 2748.09 * std::pow(luminance, 0.193434);
}

}  // namespace

double castle_sustained(double rho, double luminance, double area) {
    luminance = clamp_luminance(luminance);
    const double gain = saturating_law(56.4947, 7.54726, 0.144532, luminance) *
                        (1.0 - saturating_law(1.0, 5.58341e-7, 9.66862e9, luminance));
    const double peak = saturating_law(1.78119, 91.5718, 0.256682, luminance);
    return gain * evaluate_shape(sustained, clamp_input(rho), peak, std::fmax(area, 0.0));
}

double castle_transient(double rho, double luminance, double area) {
    return transient_gain(clamp_luminance(luminance)) *
           evaluate_shape(transient, clamp_input(rho), transient_frequency, std::fmax(area, 0.0));
}

double castle_sustained_response(double omega) {
    return std::exp(-std::pow(clamp_input(omega), castle_sustained_power) / castle_sustained_scale);
}

double castle_transient_peak(double luminance) {
    return std::max(0.0, castle_transient_slope * std::log10(clamp_luminance(luminance)) + castle_transient_offset);
}

double castle_transient_response(double omega, double luminance) {
    const double away = std::pow(clamp_input(omega), castle_transient_power) -
                        std::pow(castle_transient_peak(luminance), castle_transient_power);
    return std::exp(-away * away / castle_transient_scale);
}

double castle_sensitivity(double rho, double omega, double luminance, double area) {
    return castle_sustained_response(omega) * castle_sustained(rho, luminance, area) +
           castle_transient_response(omega, luminance) * castle_transient(rho, luminance, area);
}

double castle_red_green(double rho, double omega, double luminance, double area) {
    return evaluate_mechanism(red_green, rho, omega, luminance, area);
}

double castle_yellow_violet(double rho, double omega, double luminance, double area) {
    return evaluate_mechanism(yellow_violet, rho, omega, luminance, area);
}

double castle_peak(double luminance) {
    return find_maximum([luminance](double rho) { return castle_sustained(rho, luminance); });
}

}  // namespace aleph
