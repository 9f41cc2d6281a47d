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

/// Place i of an order of 0 to n - 1 in which lattice_point is even from the first points on, so that halves of the
/// lattice are even as well: the rank of i among them by its binary digits in reverse (van der Corput). For powers of
/// two this is i with its digits reversed.
inline int even_order(int i, int n) {
    int rank = 0;
    for (int bit = 1; bit <= i; bit *= 2) {
        // Those that have the same lower digits, and here a 0 where i has a 1.
        if ((i & bit) != 0) rank += (n - 1 - (i & (bit - 1))) / (2 * bit) + 1;
    }
    return rank;
}

}  // namespace aleph
