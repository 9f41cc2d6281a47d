#include "perception/vision/band_frequencies.h"

namespace aleph {

std::array<double, band_count> band_frequencies(Bands bands, double pixels_per_degree) {
    constexpr double printed_density = 31.0;  // pixels per degree of both sets
    std::array<double, band_count> rho = bands == Bands::printed
                                             ? std::array<double, band_count>{16, 8, 4, 2, 1, 0.5, 0.25}
                                             : std::array<double, band_count>{15.5, 3.27, 1.57, 0.79, 0.36, 0.18, 0.12};
    for (double& r : rho) r *= pixels_per_degree / printed_density;
    return rho;
}

}  // namespace aleph
