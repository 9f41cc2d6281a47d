#include "perception/vision/kelly.h"

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

/// (5.7). log is log10: with ln the peak at rest would be 1882, not 245.
double gain(double v, const KellyModel& model) {
    const double l = std::abs(std::log10(model.c2 * v / csf_k_velocity));
    return csf_k_offset + csf_k_slope * l * l * l;
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

double elevation(double rho, double v, const KellyModel& model) {
    if (!(clamp_input(rho, 0.0) > csf_peak_frequency(v, model))) return 1.0;
    return std::max(1.0, csf_max(v, model) / std::max(csf(rho, v, model), 1.0));
}

}  // namespace aleph
