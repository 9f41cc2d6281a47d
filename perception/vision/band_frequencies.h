#pragma once
// The bands of spatial frequency that a picture is split into (Yee 2000, section 5.2).

#include <array>

namespace aleph {

inline constexpr int band_count = 7;

enum class Bands {
    printed,   ///< 16 8 4 2 1 .5 .25 cpd at 31 pixels per degree, as the thesis prints
    measured,  ///< 15.5 3.27 1.57 .79 .36 .18 .12: where these filters really peak
};

/// Frequencies of the bands L(0..6), cycles per degree, finest first; they scale with pixels per degree over 31.
std::array<double, band_count> band_frequencies(Bands bands, double pixels_per_degree);

}  // namespace aleph
