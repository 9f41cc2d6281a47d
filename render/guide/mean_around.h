#pragma once
// Means over what the eye sees together.

#include "engine/base/image.h"

namespace aleph {

/// Errors of pixels within so many on either side add up, as energy, to what is seen at one: about half a cycle where
/// noise is seen best. 4 at 31 pixels per degree, at least 1.
int find_seen_reach(double pixels_per_degree);

/// Mean of the values around each pixel.
/// @param values    negative: unknown, not counted
/// @param reach     pixels on either side, along rows and columns
/// @param with_own  whether the pixel's own value counts; it does where no other is known
/// @return negative where no value is known
Image<float> mean_around(const Image<float>& values, int reach, bool with_own);

}  // namespace aleph
