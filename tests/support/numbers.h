#pragma once
// Numbers that many tests need.

#include <limits>
#include <numbers>

namespace aleph {

inline constexpr double pi = std::numbers::pi;
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double denormal = std::numeric_limits<float>::denorm_min();  ///< of float
inline constexpr float float_infinity = std::numeric_limits<float>::infinity();
inline constexpr float float_nan = std::numeric_limits<float>::quiet_NaN();

}  // namespace aleph
