#pragma once
// Models of vision of Kelly's form: sensitivity of the eye to contrast that moves over the retina, Kelly 1979 with the
// constants of Daly 1998 (Yee 2000, section 5.4) or of Laird et al. 2006, and the thresholds of TVI.
//
// Sensitivity, 1 / threshold contrast, to rho cycles per degree at v deg/s is
// k c0 c2 v (2 pi rho c1)^2 exp(-4 pi c1 rho / rho_max), with k = 6.1 + 7.3 |log10(c2 v / 3)|^3 and
// rho_max = 45.9 / (c2 v + 2). It peaks at rho_max / (2 pi c1), printed as (5.10); CSF_max is its value there: for Daly
// 245.4 at .15 deg/s and at most 250.75, for Laird at most 117.0.

#include <numbers>
#include <vector>

#include "perception/vision/vision_model.h"

namespace aleph {

/// One fit of (5.6-5.8), for displays of 100 cd/m2.
struct KellyModel {
    double c0 = 0.0;            ///< (5.6) sensitivity
    double c1 = 0.0;            ///< (5.6) frequency
    double c2 = 0.0;            ///< (5.6) velocity
    double min_velocity = 0.0;  ///< deg/s; slower counts as this

    constexpr double angular() const { return 2 * std::numbers::pi * c1; }  ///< rho_max of (5.8) is angular
};

/// Daly 1998, "Engineering observations from spatiovelocity and spatiotemporal visual models": the thesis's constants.
inline constexpr KellyModel daly_1998{.c0 = 1.14, .c1 = 0.67, .c2 = 1.7, .min_velocity = 0.15};
/// Laird, Rosen, Pelz, Montag and Daly 2006, "Spatio-velocity CSF as a function of retinal velocity using unstabilized
/// stimuli": fitted to eyes that move freely, from 0.3 deg/s. c0 holds one more factor c1 of their (5.6).
inline constexpr KellyModel laird_2006{.c0 = 0.6329 * 0.8404, .c1 = 0.8404, .c2 = 0.7986, .min_velocity = 0.3};

inline constexpr double csf_k_offset = 6.1;        ///< (5.7)
inline constexpr double csf_k_slope = 7.3;         ///< (5.7)
inline constexpr double csf_k_velocity = 3.0;      ///< (5.7), deg/s
inline constexpr double csf_rho_numerator = 45.9;  ///< (5.8)
inline constexpr double csf_rho_offset = 2.0;      ///< (5.8), deg/s

/// f_i of a row of retinal velocities (5.9), in float, within 2e-5: CSF_max over the sensitivity, above the peak,
/// else 1. Sensitivity below 1 counts as 1, because no contrast exceeds 1. Not monotone in v.
class KellyRow final : public ElevationRow {
  public:
    /// @param rho  band frequencies, cycles per degree
    KellyRow(const std::array<double, band_count>& rho, int width, const KellyModel& model = daly_1998);

    /// Reads retinal velocities only, and keeps no pointer.
    void load(const StimulusRow& row) override;
    void elevations(int band, float* out) const override;

  private:
    KellyModel model_;
    std::array<float, band_count> slope_;  ///< rho / rho_peak = slope * (c2 v + 2)
    std::vector<float> spread_;            ///< c2 v + 2
    std::vector<float> peak_;              ///< CSF_max
};

}  // namespace aleph
