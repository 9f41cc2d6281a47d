#pragma once
// The bands of spatial frequency that a picture is split into (Yee 2000, section 5.2).

#include <array>

#include "perception/perception_settings.h"

namespace aleph {

inline constexpr int band_count = 7;

/// Frequencies of the bands L(0..6), cycles per degree, finest first; they scale with pixels per degree over 31.
std::array<double, band_count> band_frequencies(Bands bands, double pixels_per_degree);

}  // namespace aleph
