#pragma once
// Models of vision of Kelly's form (kelly.h), with the thresholds of TVI.

#include <vector>

#include "perception/vision/kelly.h"
#include "perception/vision/vision_model.h"

namespace aleph {

/// f_i of a row of retinal velocities (5.9), in float: within 2e-5 of elevation() in kelly.h.
class KellyRow final : public ElevationRow {
  public:
    /// @param rho  band frequencies, cycles per degree
    KellyRow(const std::array<double, band_count>& rho, int width, const KellyModel& model = daly_1998);

    /// Reads retinal velocities only, and keeps no pointer.
    void load(const StimulusRow& row) override;
    void elevations(int band, float* out) const override;
    bool is_one(int band) const override;

  private:
    KellyModel model_;
    std::array<float, band_count> slope_;  ///< rho / rho_peak = slope * (c2 v + 2)
    std::vector<float> spread_;            ///< c2 v + 2
    float max_spread_ = 0.0f;
    std::vector<float> peak_;  ///< CSF_max
};

/// A fit of Kelly's form as a model of vision.
class KellyVision final : public VisionModel {
  public:
    KellyVision(std::string name, std::string summary, const KellyModel& model)
        : name_(std::move(name)), summary_(std::move(summary)), model_(model) {}

    std::string name() const override { return name_; }
    std::string summary() const override { return summary_; }
    double elevation(const Stimulus& stimulus, const Presentation& shown) const override;
    double threshold(double luminance) const override;
    ElevationRowMaker make_rows(const std::array<double, band_count>& rho, const Presentation& shown) const override;
    void thresholds(const float* luminance, std::size_t count, float* out) const override;

  private:
    std::string name_, summary_;
    KellyModel model_;
};

}  // namespace aleph
