#pragma once
// The opponent colour space AC1C2 of Meyer 1988 ("Wavelength selection for synthetic image generation"), as Bolin and
// Meyer 1995 use it: A achromatic, C1 roughly red-green, C2 roughly yellow-blue. In units of Y, like linear RGB.

#include "engine/base/color.h"
#include "engine/base/image.h"

namespace aleph {

/// Grey of luminance Y has (A, C1, C2) = (1, -.029, .554) Y.
enum class OpponentChannel { a, c1, c2 };

/// A channel of an image. Components below 0 and NaN count as 0, above 1e15 as 1e15: squares stay finite.
/// @param neutral  subtract from C1 and C2 what grey of the same luminance gives, so that grey has C1 = C2 = 0
Image<float> compute_opponent(const Image<Rgb>& rgb, OpponentChannel channel, bool neutral);

}  // namespace aleph
