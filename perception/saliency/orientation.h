#pragma once
// Oriented energy at one level of a Gaussian pyramid: Greenspan et al. 1994 (Yee 2000, section 5.3).

#include <array>

#include "engine/base/image.h"

namespace aleph {

inline constexpr int orientation_count = 4;
/// Directions of the wave vector, x right and y down: 0 responds to vertical lines, 90 to horizontal lines, 45 to lines
/// that rise to the right (/), 135 to lines that fall to the right (\).
inline constexpr std::array<double, orientation_count> orientation_degrees = {0, 45, 90, 135};

/// |lowpass(h e^{i k.x})| per orientation with h = level - lowpass(level), |k| = pi/2 per pixel of this level.
std::array<Image<float>, orientation_count> compute_orientations(const Image<float>& level);

}  // namespace aleph
