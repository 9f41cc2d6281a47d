#pragma once
// Constants of the contrast sensitivity function (5.6-5.8), Daly 1998, tuned to displays of 100 cd/m2.

#include <numbers>

namespace aleph {

inline constexpr double csf_c0 = 1.14;
inline constexpr double csf_c1 = 0.67;
inline constexpr double csf_c2 = 1.7;
inline constexpr double csf_k_offset = 6.1;                           ///< (5.7)
inline constexpr double csf_k_slope = 7.3;                            ///< (5.7)
inline constexpr double csf_k_velocity = 3.0;                         ///< (5.7), deg/s
inline constexpr double csf_rho_numerator = 45.9;                     ///< (5.8)
inline constexpr double csf_rho_offset = 2.0;                         ///< (5.8), deg/s
inline constexpr double csf_angular = 2 * std::numbers::pi * csf_c1;  ///< rho_max of (5.8) is angular

}  // namespace aleph
