#pragma once
// Sensitivity of the eye to contrast that moves over the retina: Kelly 1979 with the constants of Daly 1998 (Yee 2000,
// section 5.4) or of Laird et al. 2006. One value at a time, in double. Every input gives a finite result: a velocity
// that is NaN or below the model's least counts as the least, above 1e30 as 1e30; a frequency that is NaN or negative
// as 0, above 1e30 as 1e30.

#include <array>

#include "perception/perception_settings.h"
#include "perception/sensitivity_model.h"

namespace aleph {

inline constexpr int band_count = 7;
inline constexpr double drift_velocity = 0.15;       ///< deg/s, v_Min (Kelly 1979)
inline constexpr double pursuit_limit = 80.0;        ///< deg/s, v_Max (Daly 1998)
inline constexpr double tracking_efficiency = 0.82;  ///< S where nothing, or everything, stands out (3.1; section 7.2)

/// (5.6-5.8): sensitivity, 1 / threshold contrast, to `rho` cycles per degree moving at `v` deg/s.
double csf(double rho, double v, const KellyModel& model = daly_1998);

/// The frequency at which csf(., v) peaks, cycles per degree: rho_max / (2 pi c1), printed as (5.10).
double csf_peak_frequency(double v, const KellyModel& model = daly_1998);

/// The peak's value, csf(csf_peak_frequency(v), v). Daly: 245.4 at .15 deg/s, at most 250.75; Laird: at most 117.0.
double csf_max(double v, const KellyModel& model = daly_1998);

/// (5.5), deg/s, at least the drift: image velocity `v_i` less what the eye follows with efficiency `s`.
/// `v_i` below 0 or NaN is 0, above 1e30 is 1e30; `s` is clamped to [0,1], NaN is tracking_efficiency.
double retinal_velocity(double v_i, double s);

/// What the eye follows of it, deg/s: s v_i, at most pursuit_limit. Arguments as above.
double tracked_velocity(double v_i, double s);

/// (5.9): how many times the least visible contrast goes unnoticed at `rho`, [1, 250.75]. Sensitivity below 1 counts
/// as 1, because no contrast exceeds 1. Not monotone in v.
double elevation(double rho, double v, const KellyModel& model = daly_1998);

/// Frequencies of the bands L(0..6), cycles per degree, finest first; they scale with pixels per degree over 31.
std::array<double, band_count> band_frequencies(Bands bands, double pixels_per_degree);

}  // namespace aleph
