#pragma once
// From the Aleph map to the luminance error that a viewer tolerates: Yee 2000, section 6.2.

#include "engine/base/color.h"
#include "engine/base/image.h"
#include "engine/base/viewing.h"

namespace aleph {

/// Threshold versus intensity (Ward-Larson, Rushmeier and Piatko 1997): cd/m2 to cd/m2. Every input gives a finite
/// positive result: below 1e-6 and for NaN that of 1e-6, above 1e12 that of 1e12.
double tvi(double luminance);

/// Adaptation luminance, cd/m2: mean over the pixels within half a degree that lie in the image.
/// @throws InputError if the estimate is empty, or viewing is not positive and finite
Image<float> compute_adaptation_luminance(const Image<Rgb>& estimate, const ViewingConditions& viewing);

/// (6.9): aleph * TVI(adaptation luminance), cd/m2.
/// @throws InputError if the sizes differ
Image<float> compute_threshold(const Image<float>& aleph, const Image<float>& adaptation_luminance);

}  // namespace aleph
