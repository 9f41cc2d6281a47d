#include "perception/castle_row.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "perception/castle.h"
#include "perception/castle_constants.h"
#include "perception/display_hold.h"
#include "perception/fast_math.h"
#include "perception/luminance_curve.h"

namespace aleph {

namespace {

constexpr float log10_2 = 0.30102999566398120f;
constexpr float max_model_velocity = 1e6f;  // deg/s
constexpr double max_frequency = 1e6;       // cycles per degree; nothing is seen there
constexpr double max_display_blur = 1e7;    // of the lanes: squares of it, times pursuit_limit, stay finite

/// base^power, base >= 0
float fast_power(float base, float power) {
    constexpr float smallest = 1e-30f;
    return fast_exp2(power * fast_log2(base > smallest ? base : smallest));
}

/// f of all bands of one pixel.
/// @param peak  castle_peak
void elevate_pixel(const CastleTable& table, float log_velocity, float tracked, float transient_peak,
                   const LuminanceGrid::Place& place, float peak, float* out) {
    constexpr auto decay_power = static_cast<float>(castle_sustained_power);
    constexpr auto power = static_cast<float>(castle_transient_power);
    constexpr auto transient_decay = static_cast<float>(std::numbers::log2e / castle_transient_scale);
    constexpr auto slope = static_cast<float>(eye_blur_slope), offset = static_cast<float>(eye_blur_offset);
    const float decay_velocity = fast_exp2(decay_power * log_velocity);
    const float velocity_power = fast_exp2(power * log_velocity);
    const float peak_power = fast_power(transient_peak, power);
    const float eye_width = slope * tracked + offset;
    const CastleTable::Node& low = table.nodes[static_cast<std::size_t>(place.node)];
    const CastleTable::Node& high = table.nodes[static_cast<std::size_t>(place.node) + 1];
    for (int i = 0; i < CastleTable::lanes; ++i) {
        const float sustained = low.sustained[i] + place.fraction * (high.sustained[i] - low.sustained[i]);
        const float transient = low.transient[i] + place.fraction * (high.transient[i] - low.transient[i]);
        const float away = table.transient_factor[i] * velocity_power - peak_power;
        const float sensitivity = sustained * fast_exp2(-table.sustained_decay[i] * decay_velocity) +
                                  transient * fast_exp2(-transient_decay * away * away);
        const float display = table.display_blur[i] * tracked, eye = table.eye_blur[i] * eye_width;
        const float loss = (1.0f + display * display) * (1.0f + eye * eye) * table.rest_share[i];
        const float f = peak * loss / (sensitivity > loss ? sensitivity : loss);
        out[i] = f > 1.0f ? f : 1.0f;
    }
}

}  // namespace

double castle_elevation(double rho, double retinal, double tracked, double luminance, double persistence,
                        const FrameRate& frame_rate) {
    const double moving = std::fmin(std::fmax(rho, 0.0), 1e30) * std::fmin(std::fmax(retinal, 0.0), 1e30);
    const double sensitivity =
        castle_sensitivity(rho, moving, luminance) * hold_transfer(rho, tracked, persistence, frame_rate);
    return std::max(1.0, castle_peak(luminance) / std::max(sensitivity, 1.0));
}

CastleTable::CastleTable(const std::array<double, band_count>& rho, const ViewingConditions& viewing,
                         const FrameRate& frame_rate)
    : nodes(LuminanceGrid::nodes) {
    rest_share.fill(1.0f);
    for (int i = 0; i < band_count; ++i) {
        const double r = std::min(rho[i], max_frequency);
        const double angular = 4.0 / std::numbers::pi * r;
        const double at_rest = angular * viewing.persistence * eye_blur_offset;
        sustained_decay[i] =
            static_cast<float>(std::numbers::log2e * std::pow(r, castle_sustained_power) / castle_sustained_scale);
        transient_factor[i] = static_cast<float>(std::pow(r, castle_transient_power));
        display_blur[i] =
            static_cast<float>(std::min(angular * viewing.persistence / frame_rate.per_second(), max_display_blur));
        eye_blur[i] = static_cast<float>(angular * viewing.persistence);
        rest_share[i] = static_cast<float>(1.0 / (1.0 + at_rest * at_rest));
        for (int node = 0; node < LuminanceGrid::nodes; ++node) {
            const double luminance = LuminanceGrid::luminance(node);
            nodes[node].sustained[i] = static_cast<float>(castle_sustained(r, luminance));
            nodes[node].transient[i] = static_cast<float>(castle_transient(r, luminance));
        }
    }
}

CastleRow::CastleRow(const CastleTable& table, int width) : table_(table), log_velocity_(width), log_luminance_(width) {
    for (std::vector<float>& row : elevations_) row.resize(width);
}

void CastleRow::load(const float* retinal, const float* tracked, const float* luminance) {
    const std::size_t width = log_velocity_.size();
    for (std::size_t x = 0; x < width; ++x) {
        log_velocity_[x] = fast_log2(retinal[x] < max_model_velocity ? retinal[x] : max_model_velocity);
        log_luminance_[x] = fast_log2(LuminanceGrid::clamp(luminance[x]));
    }
    const LuminanceCurve& peak = castle_peak_curve();
    for (std::size_t x = 0; x < width; ++x) {
        const LuminanceGrid::Place place = LuminanceGrid::place(log_luminance_[x]);
        const float transient_peak = static_cast<float>(castle_transient_slope) * (log10_2 * log_luminance_[x]) +
                                     static_cast<float>(castle_transient_offset);
        float f[CastleTable::lanes];
        elevate_pixel(table_, log_velocity_[x], tracked[x], transient_peak, place, peak.at(place), f);
        for (int i = 0; i < band_count; ++i) elevations_[i][x] = f[i];
    }
}

}  // namespace aleph
