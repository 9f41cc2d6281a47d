#pragma once
// A moving grating, seen by the vision model, beside its known answer.

#include "engine/base/frame_rate.h"
#include "engine/base/viewing.h"
#include "perception/perception_settings.h"
#include "tests/perception/grating.h"

namespace aleph {

/// Grating that is shown, and the model that sees it.
struct GratingRun {
    Grating grating;
    double velocity = 0.0;          ///< of the image, deg/s, everywhere
    PerceptionSettings perception;  ///< guide `spatial` or `full`
    ViewingConditions viewing{};
    FrameRate frame_rate{};
};

/// Largest differences over the compared pixels. Those near a zero of every band are left out: there (5.3) is 0 / 0.
struct GratingErrors {
    double response = 0.0;       ///< of R_i (5.3), from the closed form
    double adaptation = 0.0;     ///< relative, of the luminance that castle adapts to
    double aleph_written = 0.0;  ///< relative, of the map, from closed form and vision_formulas.h
    double aleph_scalar = 0.0;   ///< relative, of the map, from the closed form and the library's double functions
    double aleph_lowest = 1e30, aleph_highest = 0.0;  ///< known answers
    int compared = 0, left_out = 0;                   ///< pixels

    /// The larger of every difference; sums of pixels.
    void merge(const GratingErrors& other);
};

/// Bands below this share of the grating's amplitude, summed, are a zero.
inline constexpr double least_band_sum = 0.1;

/// Runs compute_perception and compares every `step`-th pixel of the middle row.
GratingErrors run_grating(const GratingRun& run, int step);

}  // namespace aleph
