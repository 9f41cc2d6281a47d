#pragma once
// Means over what the eye sees together.

#include "engine/base/image.h"

namespace aleph {

/// Errors of pixels within so many on either side add up, as energy, to what is seen at one: half a cycle where noise
/// is seen best at 31 pixels per degree.
inline constexpr int seen_reach = 4;

/// Mean of the values in seen_reach of each pixel.
/// @param values    negative: unknown, not counted
/// @param with_own  whether the pixel's own value counts; it does where no other is known
/// @return negative where no value is known
Image<float> mean_around(const Image<float>& values, bool with_own);

}  // namespace aleph
