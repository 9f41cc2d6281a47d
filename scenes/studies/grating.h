#pragma once
// Sinusoidal gratings that drift with one velocity, and what the models of vision must say of them. The answers are
// computed apart from `perception/`: bands by a pyramid of one axis in double, sensitivity from the printed formulas.
// Only castleCSF itself is shared (castle.h), which its tests compare with the authors' program.

#include <array>
#include <vector>

#include "engine/base/color.h"
#include "engine/base/image.h"
#include "engine/base/viewing.h"
#include "perception/perception.h"

namespace aleph {

struct Grating {
    double rho = 1.0;         ///< cycles per degree, along x
    double velocity = 0.0;    ///< deg/s, of the image
    double luminance = 50.0;  ///< mean, cd/m2
    double contrast = 0.5;    ///< Michelson
};

using BandValues = std::array<double, 7>;  ///< finest first

/// Grey, the same in each row.
Image<Rgb> make_grating(const Grating& grating, int width, int height, const ViewingConditions& viewing);

/// R_i (5.3) of each pixel of a row of values, all rows being equal; and the sum of the bands, L(0) to L(6) (5.2).
struct RowBands {
    std::vector<BandValues> responses;
    std::vector<double> sums;
};
RowBands find_row_bands(const std::vector<double>& row);

/// R_i of a grating far from borders, if no level of the pyramid aliases: differences of the product of the kernel's
/// transfer functions, h(w) = .4 + .5 cos w + .1 cos 2w at w, 2 w, 4 w ... radians per pixel of the level, squared:
/// levels are reduced and expanded.
BandValues transfer_responses(double rho, const ViewingConditions& viewing);

/// f_i (5.9) of a band.
/// @param luminance  that the eye is adapted to; only castle reads it
double known_elevation(Vision vision, Guide guide, double rho, const Grating& grating, double luminance,
                       const ViewingConditions& viewing, const FrameRate& frame_rate);

/// The difference of compute_perception from the known answers.
struct GratingCheck {
    double aleph = 0.0;        ///< largest, relative, over the pixels that are compared
    double median = 0.0;       ///< of the map
    std::size_t compared = 0;  ///< pixels
};

/// Compares the pixels of a grating's middle row whose bands are clear of zero.
GratingCheck check_grating(const Grating& grating, const PerceptionSettings& settings, const ViewingConditions& viewing,
                           const FrameRate& frame_rate);

}  // namespace aleph
