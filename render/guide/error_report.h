#pragma once
// The error that a picture is estimated to have, in units of the visible threshold, and what causes it.

#include <array>
#include <string>

#include "render/guide/stopping_rule.h"
#include "render/pixels/shaded_frame.h"

namespace aleph {

/// "edges", "blur", ...
const std::array<std::string, cause_count>& cause_names();

/// From the halves of the samples of a pixel and the eight around it (PixelSamples), and from the accuracy of cached
/// light: irradiance that is interpolated at accuracy alpha errs by about a tenth of alpha (standard deviation). In
/// just visible differences: those of samples over `noise`, those of cached light over `threshold`. Pixels
/// that are shown white have none.
/// @param blurred  the shutter or the lens is open
ErrorMaps estimate_errors(const Image<PixelSamples>& pixels, const VisibleLimits& limits, double exposure,
                          bool blurred);

/// Shares of pixels around which the error's energy (mean_around) is beyond asked^2, if it is distributed as
/// error_deviations says.
/// @param asked  just visible differences, above 0
ErrorShares count_errors(const ErrorMaps& maps, double asked);

}  // namespace aleph
