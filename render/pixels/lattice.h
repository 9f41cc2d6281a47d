#pragma once
// Evenly spread points of the unit square.

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

namespace aleph {

inline float fraction(float x) {
    return x - std::floor(x);
}

/// Point i of n of a rank-1 lattice (golden ratio), shifted by `shift` modulo 1: even in both coordinates for any n.
/// In [0,1)^2.
inline glm::vec2 lattice_point(int i, int n, const glm::vec2& shift) {
    constexpr float golden = 0.61803398875f;
    constexpr float below_one = 0x1.fffffep-1f;
    return {std::min(fraction((static_cast<float>(i) + 0.5f) / static_cast<float>(n) + shift.x), below_one),
            std::min(fraction(static_cast<float>(i) * golden + shift.y), below_one)};
}

}  // namespace aleph
