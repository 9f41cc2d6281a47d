#pragma once
// The opponent colour space AC1C2 of Meyer 1988 ("Wavelength selection for synthetic image generation"), as Bolin and
// Meyer 1995 use it: A achromatic, C1 roughly red-green, C2 roughly yellow-blue. In units of Y, like linear RGB.

#include <glm/vec3.hpp>

#include "engine/base/color.h"
#include "engine/base/image.h"

namespace aleph {

/// (A, C1, C2) of linear Rec.709 RGB, signed, any finite input. Grey of luminance Y gives (1, -.029, .554) Y.
glm::dvec3 to_opponent(const glm::dvec3& rgb);

/// The inverse of to_opponent.
glm::dvec3 from_opponent(const glm::dvec3& opponent);

/// What a pixel enters the model with: components below 0 and NaN are 0, above 1e15 are 1e15 (squares stay finite).
Rgb clamp_for_opponent(const Rgb& rgb);

/// One raster per channel of the clamped pixels; floats over weights built in double.
struct OpponentImages {
    Image<float> a, c1, c2;
};

/// @param neutral  subtract what grey of the same luminance gives, so that grey has C1 = C2 = 0
OpponentImages compute_opponent(const Image<Rgb>& rgb, bool neutral);

/// A alone.
Image<float> compute_achromatic(const Image<Rgb>& rgb);

}  // namespace aleph
