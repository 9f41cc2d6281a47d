#include "perception/vision/castle_vision.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "perception/vision/castle.h"
#include "perception/vision/display_hold.h"
#include "perception/vision/fast_math.h"
#include "perception/vision/luminance_curve.h"
#include "perception/vision/vision_list.h"

namespace aleph {

namespace {

constexpr double max_frequency = 1e6;     // cycles per degree; nothing is seen there
constexpr double max_display_blur = 1e7;  // of the lanes: squares of it, times pursuit_limit, stay finite

/// One pixel; CastleRow has the same by rows.
struct CastlePixel {
    float log_luminance, tracked, sustained_velocity, transient_velocity, transient_peak;
};

/// f of all bands of one pixel.
void elevate_pixel(const CastleTable& table, const CastlePixel& pixel, float* out) {
    constexpr auto transient_decay = static_cast<float>(std::numbers::log2e / castle_transient_scale);
    constexpr auto slope = static_cast<float>(eye_blur_slope), offset = static_cast<float>(eye_blur_offset);
    const LuminanceGrid::Place place = LuminanceGrid::place(pixel.log_luminance);
    const CastleTable::Node& low = table.nodes[static_cast<std::size_t>(place.node)];
    const CastleTable::Node& high = table.nodes[static_cast<std::size_t>(place.node) + 1];
    const float peak = low.peak + place.fraction * (high.peak - low.peak);
    const float eye_width = slope * pixel.tracked + offset;
    for (int i = 0; i < CastleTable::lanes; ++i) {
        const float sustained = low.sustained[i] + place.fraction * (high.sustained[i] - low.sustained[i]);
        const float transient = low.transient[i] + place.fraction * (high.transient[i] - low.transient[i]);
        const float away = table.transient_factor[i] * pixel.transient_velocity - pixel.transient_peak;
        const float sensitivity = sustained * fast_exp2(-table.sustained_decay[i] * pixel.sustained_velocity) +
                                  transient * fast_exp2(-transient_decay * away * away);
        const float display = table.display_blur[i] * pixel.tracked, eye = table.eye_blur[i] * eye_width;
        const float loss = (1.0f + display * display) * (1.0f + eye * eye) * table.rest_share[i];
        const float f = peak * loss / (sensitivity > loss ? sensitivity : loss);
        out[i] = f > 1.0f ? f : 1.0f;
    }
}

}  // namespace

CastleTable::CastleTable(const std::array<double, band_count>& rho, const ViewingConditions& viewing,
                         const FrameRate& frame_rate)
    : nodes(LuminanceGrid::nodes) {
    rest_share.fill(1.0f);
    for (int node = 0; node < LuminanceGrid::nodes; ++node) {
        nodes[node].peak = castle_peak_curve().node(node);
    }
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

CastleRow::CastleRow(std::shared_ptr<const CastleTable> table, int width)
    : table_(std::move(table)),
      log_luminance_(width),
      sustained_velocity_(width),
      transient_velocity_(width),
      transient_peak_(width) {
    for (std::vector<float>& f : elevations_) f.resize(width);
}

void CastleRow::load(const StimulusRow& row) {
    constexpr auto sustained_power = static_cast<float>(castle_sustained_power);
    constexpr auto transient_power = static_cast<float>(castle_transient_power);
    constexpr auto slope = static_cast<float>(castle_transient_slope);
    constexpr auto offset = static_cast<float>(castle_transient_offset);
    constexpr float least_peak = 1e-30f;  // Hz; its power is next to 0
    const std::size_t width = log_luminance_.size();
    const float* const retinal = row.retinal;
    const float* const luminance = row.luminance;
    float* const log_luminances = log_luminance_.data();
    float* const sustained_velocities = sustained_velocity_.data();
    float* const transient_velocities = transient_velocity_.data();
    float* const transient_peaks = transient_peak_.data();
#pragma omp simd
    for (std::size_t x = 0; x < width; ++x) {
        const float log_velocity = fast_log2(retinal[x] < max_model_velocity ? retinal[x] : max_model_velocity);
        const float log_luminance = fast_log2(LuminanceGrid::clamp(luminance[x]));
        const float fitted_peak = slope * (log10_2 * log_luminance) + offset;
        const float peak = fitted_peak > least_peak ? fitted_peak : least_peak;
        log_luminances[x] = log_luminance;
        sustained_velocities[x] = fast_exp2(sustained_power * log_velocity);
        transient_velocities[x] = fast_exp2(transient_power * log_velocity);
        transient_peaks[x] = fast_exp2(transient_power * fast_log2(peak));
    }
    for (std::size_t x = 0; x < width; ++x) {
        float f[CastleTable::lanes];
        elevate_pixel(
            *table_,
            {log_luminances[x], row.tracked[x], sustained_velocities[x], transient_velocities[x], transient_peaks[x]},
            f);
        for (int i = 0; i < band_count; ++i) elevations_[i][x] = f[i];
    }
}

void CastleRow::elevations(int band, float* out) const {
    std::ranges::copy(elevations_[band], out);
}

namespace {

class CastleVision final : public VisionModel {
  public:
    std::string name() const override { return "castle"; }
    std::string summary() const override { return "castleCSF 2024 with the blur of displays that hold frames"; }
    bool uses_luminance() const override { return true; }
    bool uses_persistence() const override { return true; }

    ElevationRowMaker make_rows(const std::array<double, band_count>& rho, const Presentation& shown) const override {
        const auto table = std::make_shared<const CastleTable>(rho, shown.viewing, shown.frame_rate);
        return [table](int width) { return std::make_unique<CastleRow>(table, width); };
    }

    /// Luminance over castle_peak; in proportion to luminance from 1e4 cd/m2 up, to 1e12.
    void thresholds(const float* luminance, std::size_t count, float* out) const override {
        const LuminanceCurve& peak = castle_peak_curve();
        for (std::size_t i = 0; i < count; ++i) out[i] = clamp_threshold_luminance(luminance[i]) / peak(luminance[i]);
    }
};

}  // namespace

const VisionModel& castle_vision() {
    static const CastleVision model;
    return model;
}

}  // namespace aleph
