#pragma once
// The error that a picture is estimated to have, in units of the visible threshold, and what causes it.

#include <array>
#include <string>

#include "engine/base/image.h"
#include "render/pixels/outlines.h"
#include "render/pixels/pixel_samples.h"
#include "render/pixels/shaded_frame.h"

namespace aleph {

/// "edges", "blur", ...
const std::array<std::string, cause_count>& cause_names();

/// The input of estimate_errors.
struct ErrorInput {
    const Image<PixelSamples>& pixels;
    const Image<float>& threshold;  ///< cd/m2
    const Image<float>& noise;      ///< cd/m2 (NoiseVisibility)
    const Image<float>& accuracy;   ///< alpha
    const Image<Outline>& outlines;
    double white = 1.0;            ///< radiance that is shown as white
    double luminance_scale = 1.0;  ///< cd/m2 for a luminance of 1 of the samples: exposure times display white
    bool blurred = false;          ///< the shutter or the lens is open
    int reach = 1;                 ///< find_seen_reach
};

/// From the halves of the samples of a pixel and the eight around it (PixelSamples), and from the accuracy of cached
/// light: irradiance that is interpolated at accuracy alpha errs by about a tenth of alpha (standard deviation). In
/// just visible differences: those of samples over `noise`, those of cached light over `threshold`. Pixels
/// that are shown white have none.
ErrorMaps estimate_errors(const ErrorInput& input);

/// Shares of pixels around which the error's energy (mean_around) is beyond asked^2, if it is distributed as
/// error_deviations says.
/// @param asked  just visible differences, above 0
ErrorShares count_errors(const ErrorMaps& maps, double asked);

}  // namespace aleph
