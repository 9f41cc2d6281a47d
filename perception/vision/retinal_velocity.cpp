#include "perception/vision/retinal_velocity.h"

namespace aleph {

namespace {

constexpr float max_velocity = 1e30f;  // deg/s; its powers in the formulas stay finite

float clamp_velocity(float v) {
    const float positive = v > 0.0f ? v : 0.0f;  // 0 for NaN
    return positive < max_velocity ? positive : max_velocity;
}

}  // namespace

void retinal_velocity_row(const float* velocity, const float* saliency, int count, float* out) {
    constexpr auto drift = static_cast<float>(drift_velocity);
    for (int x = 0; x < count; ++x) {
        const float v = clamp_velocity(velocity[x]);
        // v - min(S v + drift, limit), without the cancellation of v - S v. As printed it is negative at rest.
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
