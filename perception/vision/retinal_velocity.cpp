#include "perception/vision/retinal_velocity.h"

#include <algorithm>
#include <cmath>

namespace aleph {

namespace {

constexpr double max_velocity = 1e30;  // deg/s; its powers in the formulas stay finite

// std::fmax and std::fmin return the other argument for a NaN; std::clamp would return the NaN.
double clamp_velocity(double v) {
    return std::fmin(std::fmax(v, 0.0), max_velocity);
}

float clamp_velocity(float v) {
    const float positive = v > 0.0f ? v : 0.0f;
    return positive < static_cast<float>(max_velocity) ? positive : static_cast<float>(max_velocity);
}

double clamp_efficiency(double s) {
    return std::isnan(s) ? tracking_efficiency : std::clamp(s, 0.0, 1.0);
}

}  // namespace

double retinal_velocity(double v_i, double s) {
    v_i = clamp_velocity(v_i);
    s = clamp_efficiency(s);
    // v - min(S v + drift, limit), written without the cancellation of v - S v. As printed it is negative at rest.
    const double slip = std::max(v_i * (1.0 - s) - drift_velocity, v_i - pursuit_limit);
    return std::max(slip, drift_velocity);
}

double tracked_velocity(double v_i, double s) {
    return std::min(clamp_velocity(v_i) * clamp_efficiency(s), pursuit_limit);
}

void retinal_velocity_row(const float* velocity, const float* saliency, int count, float* out) {
    constexpr auto drift = static_cast<float>(drift_velocity);
    for (int x = 0; x < count; ++x) {
        const float v = clamp_velocity(velocity[x]);
        const float tracked = v * (1.0f - saliency[x]) - drift;
        const float limited = v - static_cast<float>(pursuit_limit);
        const float slip = tracked > limited ? tracked : limited;
        out[x] = slip > drift ? slip : drift;
    }
}

void tracked_velocity_row(const float* velocity, const float* saliency, int count, float* out) {
    for (int x = 0; x < count; ++x) {
        const float followed = clamp_velocity(velocity[x]) * saliency[x];
        out[x] = followed < static_cast<float>(pursuit_limit) ? followed : static_cast<float>(pursuit_limit);
    }
}

}  // namespace aleph
