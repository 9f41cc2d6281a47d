// castleCSF as a model of vision.

#include "perception/vision/castle.h"
#include "perception/vision/castle_row.h"
#include "perception/vision/luminance_curve.h"
#include "perception/vision/vision_list.h"

namespace aleph {

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
