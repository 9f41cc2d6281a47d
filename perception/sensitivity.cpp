#include "perception/sensitivity.h"

#include <algorithm>
#include <cmath>

namespace aleph {

namespace {

constexpr double max_input = 1e30;  // its powers in the formulas stay finite

// std::fmax and std::fmin return the other argument for a NaN; std::clamp would return the NaN.
double clamp_input(double value, double lowest) {
    return std::fmin(std::fmax(value, lowest), max_input);
}

double angular_peak(double v, const KellyModel& model) {
    return csf_rho_numerator / (model.c2 * v + csf_rho_offset);  // (5.8)
}

double gain(double v,
            const KellyModel& model) {  // (5.7); log is log10: with ln the peak at rest would be 1882, not 245
    const double l = std::abs(std::log10(model.c2 * v / csf_k_velocity));
    return csf_k_offset + csf_k_slope * l * l * l;
}

double clamp_efficiency(double s) {
    return std::isnan(s) ? tracking_efficiency : std::clamp(s, 0.0, 1.0);
}

}  // namespace

double csf(double rho, double v, const KellyModel& model) {
    rho = clamp_input(rho, 0.0);
    v = clamp_input(v, model.min_velocity);
    const double angular = model.angular() * rho;
    return gain(v, model) * model.c0 * model.c2 * v * angular * angular *
           std::exp(-2.0 * angular / angular_peak(v, model));
}

double csf_peak_frequency(double v, const KellyModel& model) {
    return angular_peak(clamp_input(v, model.min_velocity), model) / model.angular();
}

double csf_max(double v, const KellyModel& model) {
    v = clamp_input(v, model.min_velocity);
    const double peak = angular_peak(v, model);
    return gain(v, model) * model.c0 * model.c2 * v * peak * peak * std::exp(-2.0);
}

double retinal_velocity(double v_i, double s) {
    v_i = clamp_input(v_i, 0.0);
    s = clamp_efficiency(s);
    // v - min(S v + drift, limit), written without the cancellation of v - S v. As printed it is negative at rest.
    const double slip = std::max(v_i * (1.0 - s) - drift_velocity, v_i - pursuit_limit);
    return std::max(slip, drift_velocity);
}

double tracked_velocity(double v_i, double s) {
    return std::min(clamp_input(v_i, 0.0) * clamp_efficiency(s), pursuit_limit);
}

double elevation(double rho, double v, const KellyModel& model) {
    if (!(clamp_input(rho, 0.0) > csf_peak_frequency(v, model))) return 1.0;
    return std::max(1.0, csf_max(v, model) / std::max(csf(rho, v, model), 1.0));
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
