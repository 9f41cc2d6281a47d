#pragma once
// Constants of the contrast sensitivity functions of Kelly's form (5.6-5.8). Each set is tuned to displays of 100
// cd/m2.

#include <numbers>

namespace aleph {

/// One fit of (5.6-5.8).
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

}  // namespace aleph
