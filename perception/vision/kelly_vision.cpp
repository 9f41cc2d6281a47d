#include "perception/vision/kelly_vision.h"

#include <cmath>

#include "perception/vision/fast_math.h"
#include "perception/vision/tvi.h"
#include "perception/vision/vision_list.h"

namespace aleph {

namespace {

constexpr float log2_e = static_cast<float>(std::numbers::log2e);

}  // namespace

KellyRow::KellyRow(const std::array<double, band_count>& rho, int width, const KellyModel& model)
    : model_(model), spread_(width), peak_(width) {
    for (int i = 0; i < band_count; ++i) {
        slope_[i] = static_cast<float>(rho[i] * model.angular() / csf_rho_numerator);
    }
}

void KellyRow::load(const StimulusRow& row) {
    // CSF_max = k c0 c2 v rho_max^2 e^-2
    const auto peak_factor =
        static_cast<float>(model_.c0 * model_.c2 * csf_rho_numerator * csf_rho_numerator * std::exp(-2.0));
    const auto log_offset = static_cast<float>(std::log10(model_.c2 / csf_k_velocity));
    const auto c2 = static_cast<float>(model_.c2), slowest = static_cast<float>(model_.min_velocity);
    const std::size_t width = spread_.size();
    const float* const velocity = row.retinal;
    float* const spread = spread_.data();
    float* const peak = peak_.data();
#pragma omp simd
    for (std::size_t x = 0; x < width; ++x) {
        const float moving = velocity[x] > slowest ? velocity[x] : slowest;  // also where it is NaN
        const float v = moving < max_model_velocity ? moving : max_model_velocity;
        const float s = c2 * v + static_cast<float>(csf_rho_offset);
        const float l = std::abs(log10_2 * fast_log2(v) + log_offset);
        const float k = static_cast<float>(csf_k_offset) + static_cast<float>(csf_k_slope) * (l * l * l);
        spread[x] = s;
        peak[x] = peak_factor * k * v / (s * s);
    }
}

void KellyRow::elevations(int band, float* out) const {
    // k, c0 and c2 v cancel: CSF_max / CSF = e^(2x-2) / x^2 with x = rho / rho_peak. Where CSF < 1, f is CSF_max; so it
    // is long before the largest ratio, beyond which the square would overflow.
    constexpr float largest_ratio = 32.0f;
    const float slope = slope_[band];
    const std::size_t width = spread_.size();
    const float* const spread = spread_.data();
    const float* const peak = peak_.data();
    for (std::size_t x = 0; x < width; ++x) {
        const float exact = slope * spread[x], ratio = exact > largest_ratio ? largest_ratio : exact;
        const float f = fast_exp2(2.0f * log2_e * (ratio - 1.0f)) / (ratio * ratio);
        const float clamped = f < peak[x] ? f : peak[x];
        const float at_least_one = clamped > 1.0f ? clamped : 1.0f;
        out[x] = ratio > 1.0f ? at_least_one : 1.0f;
    }
}

namespace {

/// A fit of Kelly's form as a model of vision.
class KellyVision final : public VisionModel {
  public:
    KellyVision(std::string name, std::string summary, const KellyModel& model)
        : name_(std::move(name)), summary_(std::move(summary)), model_(model) {}

    std::string name() const override { return name_; }
    std::string summary() const override { return summary_; }

    ElevationRowMaker make_rows(const std::array<double, band_count>& rho,
                                const Presentation& /*shown*/) const override {
        return [rho, model = model_](int width) { return std::make_unique<KellyRow>(rho, width, model); };
    }

    void thresholds(const float* luminance, std::size_t count, float* out) const override {
        tvi_row(luminance, count, out);
    }

  private:
    std::string name_, summary_;
    KellyModel model_;
};

}  // namespace

const VisionModel& thesis_vision() {
    static const KellyVision model("thesis", "Kelly 1979 with the thesis's constants", daly_1998);
    return model;
}

const VisionModel& laird_vision() {
    static const KellyVision model("laird", "Kelly 1979 with the constants of Laird 2006", laird_2006);
    return model;
}

}  // namespace aleph
