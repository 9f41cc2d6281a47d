#pragma once
// The bands of spatial frequency that a picture is split into (Yee 2000, section 5.2).

#include <array>

namespace aleph {

inline constexpr int band_count = 7;

enum class Bands {
    printed,   ///< as the thesis prints them
    measured,  ///< where these filters really peak
};

/// Frequencies of the bands L(0..6), cycles per degree, finest first; they scale with pixels per degree over 31.
inline std::array<double, band_count> band_frequencies(Bands bands, double pixels_per_degree) {
    constexpr double printed_density = 31.0;  // pixels per degree of both sets
    std::array<double, band_count> rho{16, 8, 4, 2, 1, 0.5, 0.25};
    if (bands == Bands::measured) rho = {15.5, 3.27, 1.57, 0.79, 0.36, 0.18, 0.12};
    for (double& r : rho) r *= pixels_per_degree / printed_density;
    return rho;
}

}  // namespace aleph
