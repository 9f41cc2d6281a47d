#include "perception/sensitivity.h"

#include <algorithm>
#include <cmath>

#include "perception/sensitivity_model.h"

namespace aleph {

namespace {

constexpr double max_input = 1e30;  // its powers in the formulas stay finite

// std::fmax and std::fmin return the other argument for a NaN; std::clamp would return the NaN.
double clamp_input(double value, double lowest) {
    return std::fmin(std::fmax(value, lowest), max_input);
}

double angular_peak(double v) {
    return csf_rho_numerator / (csf_c2 * v + csf_rho_offset);  // (5.8)
}

double gain(double v) {  // (5.7); log is log10: with ln the peak at rest would be 1882 instead of 245
    const double l = std::abs(std::log10(csf_c2 * v / csf_k_velocity));
    return csf_k_offset + csf_k_slope * l * l * l;
}

}  // namespace

double csf(double rho, double v) {
    rho = clamp_input(rho, 0.0);
    v = clamp_input(v, drift_velocity);
    const double angular = csf_angular * rho;
    return gain(v) * csf_c0 * csf_c2 * v * angular * angular * std::exp(-2.0 * angular / angular_peak(v));
}

double csf_peak_frequency(double v) {
    return angular_peak(clamp_input(v, drift_velocity)) / csf_angular;
}

double csf_max(double v) {
    v = clamp_input(v, drift_velocity);
    const double peak = angular_peak(v);
    return gain(v) * csf_c0 * csf_c2 * v * peak * peak * std::exp(-2.0);
}

double retinal_velocity(double v_i, double s) {
    v_i = clamp_input(v_i, 0.0);
    s = std::isnan(s) ? tracking_efficiency : std::clamp(s, 0.0, 1.0);
    // v - min(S v + drift, limit), written without the cancellation of v - S v. As printed it is negative at rest.
    const double slip = std::max(v_i * (1.0 - s) - drift_velocity, v_i - pursuit_limit);
    return std::max(slip, drift_velocity);
}

double elevation(double rho, double v) {
    if (!(clamp_input(rho, 0.0) > csf_peak_frequency(v))) return 1.0;
    return std::max(1.0, csf_max(v) / std::max(csf(rho, v), 1.0));
}

std::array<double, band_count> band_frequencies(Bands bands, double pixels_per_degree) {
    constexpr double printed_density = 31.0;  // pixels per degree of both sets
    std::array<double, band_count> rho = bands == Bands::printed
                                             ? std::array<double, band_count>{16, 8, 4, 2, 1, 0.5, 0.25}
                                             : std::array<double, band_count>{15.5, 3.27, 1.57, 0.79, 0.36, 0.18, 0.12};
    for (double& r : rho) r *= pixels_per_degree / printed_density;
    return rho;
}

}  // namespace aleph
