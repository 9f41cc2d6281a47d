#pragma once
// Numbers that many files need.

#include <limits>
#include <numbers>

namespace aleph {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float infinite = std::numeric_limits<float>::infinity();

}  // namespace aleph
