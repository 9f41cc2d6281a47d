// The eye's response to a band's signal over the frames: filters along the motion that it follows.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "perception/vision/castle.h"
#include "perception/vision/display_hold.h"
#include "perception/vision/retinal_velocity.h"
#include "perception/vision/velocity_scale.h"
#include "render/compare/visible_difference.h"

namespace aleph {

namespace {

constexpr int luminance_nodes = 29;  // 4 a decade
constexpr int velocity_nodes = 33;
const VelocityScale velocities(velocity_nodes, 400.0);

double sinc(double x) {
    const double angle = std::numbers::pi * x;
    return angle < 1e-9 ? 1.0 : std::sin(angle) / angle;
}

/// Sensitivity over time of one band and channel at one luminance and velocity.
struct TemporalResponse {
    int channel;
    double frequency, luminance, slip, transfer, persistence, rate;

    double at(double omega) const {
        const double radius = 1.5 / frequency, area = std::numbers::pi * radius * radius;
        omega = std::abs(omega);
        if (channel == 0) return castle_sensitivity(frequency, omega, luminance, area);
        if (channel == 1) return castle_red_green(frequency, omega, luminance, area);
        return castle_yellow_violet(frequency, omega, luminance, area);
    }
    /// The sensitivity to what changes at `omega` Hz along the motion, on the retina faster or slower.
    double shifted(double omega) const {
        const double shift = frequency * slip;
        return std::sqrt(0.5 * (std::pow(at(omega + shift), 2.0) + std::pow(at(omega - shift), 2.0)));
    }
    double held(double omega) const {
        const double mirror = rate - omega;
        return transfer * std::hypot(sinc(persistence * omega / rate) * shifted(omega),
                                     sinc(persistence * mirror / rate) * shifted(mirror));
    }
};

}  // namespace

int filter_reach(const FrameRate& frame_rate) {
    return static_cast<int>(std::clamp(std::round(0.15 * frame_rate.per_second()), 1.0, 7.0));
}

VisibleFilter::VisibleFilter(int channel, double frequency, const ViewingConditions& viewing,
                             const FrameRate& frame_rate, double tracking)
    : reach_(filter_reach(frame_rate)),
      nodes_(static_cast<std::size_t>(luminance_nodes * velocity_nodes * (reach_ + 2))) {
    const double rate = frame_rate.per_second(), persistence = std::clamp(viewing.persistence, 0.0, 1.0);
    const int count = 2 * reach_ + 1;
    std::vector<double> response(static_cast<std::size_t>(reach_) + 1);
    float* out = nodes_.data();
    for (int l = 0; l < luminance_nodes; ++l) {
        for (int v = 0; v < velocity_nodes; ++v) {
            const double followed = std::min(tracking * velocities.velocity(v), pursuit_limit);
            const TemporalResponse of{channel,
                                      frequency,
                                      LuminanceGrid::luminance(l, luminance_nodes - 1),
                                      velocities.velocity(v) - followed,
                                      hold_transfer(frequency, followed, persistence, frame_rate),
                                      persistence,
                                      rate};
            for (int j = 0; j <= reach_; ++j) response[j] = of.held(j * rate / count);
            for (int k = 0; k <= reach_; ++k) {
                double sum = response[0];
                for (int j = 1; j <= reach_; ++j)
                    sum += 2.0 * response[j] * std::cos(2.0 * std::numbers::pi * j * k / count);
                *out++ = static_cast<float>(sum / count);
            }
            *out++ = static_cast<float>(response[0]);
        }
    }
}

float VisibleFilter::evaluate(float luminance, float velocity, float* weights) const {
    const auto l = LuminanceGrid::place(fast_log2(LuminanceGrid::clamp(luminance)), luminance_nodes - 1);
    const auto v = velocities.place(velocity);
    const auto stride = static_cast<std::size_t>(reach_ + 2);
    const float* low = nodes_.data() + (static_cast<std::size_t>(l.node) * velocity_nodes + v.node) * stride;
    const float* high = low + velocity_nodes * stride;
    const auto value = [&](std::size_t k) {
        const float a = low[k] + v.fraction * (low[k + stride] - low[k]);
        const float b = high[k] + v.fraction * (high[k + stride] - high[k]);
        return a + l.fraction * (b - a);
    };
    for (int k = 0; k <= reach_; ++k) weights[k] = value(static_cast<std::size_t>(k));
    return value(stride - 1);
}

}  // namespace aleph
