#pragma once
// Sensitivity of the eye to contrast that moves over the retina: Kelly 1979 with the constants of Daly 1998 (Yee 2000,
// section 5.4) or of Laird et al. 2006. One value at a time, in double. Every input gives a finite result: a velocity
// that is NaN or below the model's least counts as the least, above 1e30 as 1e30; a frequency that is NaN or negative
// as 0, above 1e30 as 1e30.

#include <numbers>

namespace aleph {

/// One fit of (5.6-5.8), for displays of 100 cd/m2.
struct KellyModel {
    double c0 = 0.0;            ///< (5.6) sensitivity
    double c1 = 0.0;            ///< (5.6) frequency
    double c2 = 0.0;            ///< (5.6) velocity
    double min_velocity = 0.0;  ///< deg/s; slower counts as this

    constexpr double angular() const { return 2 * std::numbers::pi * c1; }  ///< rho_max of (5.8) is angular
    bool operator==(const KellyModel&) const = default;
};

/// Daly 1998, "Engineering observations from spatiovelocity and spatiotemporal visual models": the thesis's constants.
inline constexpr KellyModel daly_1998{.c0 = 1.14, .c1 = 0.67, .c2 = 1.7, .min_velocity = 0.15};
/// Laird, Rosen, Pelz, Montag and Daly 2006, "Spatio-velocity CSF as a function of retinal velocity using unstabilized
/// stimuli": fitted to eyes that move freely, from 0.3 deg/s. Their (5.6) has one more factor c1, which is part of c0
/// here.
inline constexpr KellyModel laird_2006{.c0 = 0.6329 * 0.8404, .c1 = 0.8404, .c2 = 0.7986, .min_velocity = 0.3};

inline constexpr double csf_k_offset = 6.1;        ///< (5.7)
inline constexpr double csf_k_slope = 7.3;         ///< (5.7)
inline constexpr double csf_k_velocity = 3.0;      ///< (5.7), deg/s
inline constexpr double csf_rho_numerator = 45.9;  ///< (5.8)
inline constexpr double csf_rho_offset = 2.0;      ///< (5.8), deg/s

/// (5.6-5.8): sensitivity, 1 / threshold contrast, to `rho` cycles per degree moving at `v` deg/s.
double csf(double rho, double v, const KellyModel& model = daly_1998);

/// The frequency at which csf(., v) peaks, cycles per degree: rho_max / (2 pi c1), printed as (5.10).
double csf_peak_frequency(double v, const KellyModel& model = daly_1998);

/// The peak's value, csf(csf_peak_frequency(v), v). Daly: 245.4 at .15 deg/s, at most 250.75; Laird: at most 117.0.
double csf_max(double v, const KellyModel& model = daly_1998);

/// (5.9): how many times the least visible contrast goes unnoticed at `rho`, [1, 250.75]. Sensitivity below 1 counts
/// as 1, because no contrast exceeds 1. Not monotone in v.
double elevation(double rho, double v, const KellyModel& model = daly_1998);

}  // namespace aleph
