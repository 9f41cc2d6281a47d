#include "perception/vision/vision_model.h"

namespace aleph {

namespace {

/// Elevations by PlainVision::elevation.
class PlainRow : public ElevationRow {
  public:
    PlainRow(const PlainVision& model, const std::array<double, band_count>& rho, const Presentation& shown, int width)
        : model_(model), rho_(rho), shown_(shown), width_(width) {}

    void load(const StimulusRow& row) override { row_ = row; }

    void elevations(int band, float* out) const override {
        Stimulus stimulus{.frequency = rho_[band]};
        for (int x = 0; x < width_; ++x) {
            stimulus.retinal = row_.retinal[x];
            stimulus.tracked = row_.tracked[x];
            if (row_.luminance != nullptr) stimulus.luminance = row_.luminance[x];
            out[x] = static_cast<float>(model_.elevation(stimulus, shown_));
        }
    }

  private:
    const PlainVision& model_;
    std::array<double, band_count> rho_;
    Presentation shown_;
    int width_;
    StimulusRow row_;
};

}  // namespace

ElevationRowMaker PlainVision::make_rows(const std::array<double, band_count>& rho, const Presentation& shown) const {
    return [this, rho, shown](int width) { return std::make_unique<PlainRow>(*this, rho, shown, width); };
}

void PlainVision::thresholds(const float* luminance, std::size_t count, float* out) const {
    for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<float>(threshold(luminance[i]));
}

}  // namespace aleph
