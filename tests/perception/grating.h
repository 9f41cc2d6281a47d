#pragma once
// Pictures of sinusoidal gratings, and what the bands of the vision model (Yee 2000, 5.2) respond to them, in closed
// form.

#include <array>

#include "engine/base/color.h"
#include "engine/base/image.h"
#include "perception/vision/band_frequencies.h"

namespace aleph {

/// A grating of vertical stripes, mean (1 + contrast cos(w x)), x from the left pixel. Whole half cycles lie between
/// the first and the last of its 2^10 + 1 pixels: the border, which reflects, continues it at every pyramid level, so
/// that it is endless for the filters.
struct Grating {
    static constexpr int span = 1024;  ///< pixels from the first to the last
    static constexpr int width = span + 1;
    static constexpr int height = 33;  ///< the middle row sees a whole disc of half a degree at 31 pixels per degree
    static constexpr int middle = height / 2;

    int half_cycles = 1;    ///< 1 to span
    double mean = 0.5;      ///< white = 1
    double contrast = 0.5;  ///< (highest - lowest) / (highest + lowest)

    /// w, radians per pixel.
    double angular() const;
    /// Cycles per degree.
    double frequency(double pixels_per_degree) const;
    double value(int x) const;
};

/// The half cycles of the grating nearest to a frequency, cycles per degree.
int nearest_half_cycles(double rho, double pixels_per_degree);

Image<Rgb> make_grating(const Grating& grating);

/// Transfer function of the kernel {.05 .25 .4 .25 .05} (Burt and Adelson 1983) at w radians per pixel.
double kernel_transfer(double w);

/// Gaussian level `level`, expanded to full size, of cos(w x) at pixel x. Exact: with H the kernel's transfer function,
///     A(i) = sum over a = 0 .. 2^i - 1 of P(w) P(w + 2 pi a / 2^i) cos((w + 2 pi a / 2^i) x),
///     P(u) = H(u) H(2 u) ... H(2^(i-1) u):
/// taking every second sample keeps the phase on the samples that stay, and inserting zeros adds the alias at u + pi.
double expanded_level(int level, double w, int x);

/// |A(i) - A(i+1)| at pixel x for cos(w x); the mean of a picture adds nothing, because H(0) = 1 and H(pi) = 0.
std::array<double, band_count> exact_bands(double w, int x);

/// Mean luminance of the pixels within half a degree of pixel x in the middle row, white = 1: a sum over the disc.
double exact_adaptation(const Grating& grating, int x, double pixels_per_degree);

}  // namespace aleph
