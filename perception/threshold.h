#pragma once
// From the Aleph map to the luminance error that a viewer tolerates, thesis 6.2.

#include "engine/base/color.h"
#include "engine/base/image.h"
#include "engine/base/viewing.h"

namespace aleph {

/// Threshold versus intensity (Ward-Larson et al. 1997; MODEL.md 6.2): cd/m2 to cd/m2. Any float gives a finite
/// positive answer: below 1e-6 and for NaN that of 1e-6, above 1e12 that of 1e12.
double tvi(double luminance);

/// Adaptation luminance, cd/m2: mean over the in-image pixels within half a degree.
Image<float> compute_adaptation_luminance(const Image<Rgb>& estimate, const ViewingConditions& viewing);

/// (6.9): aleph * TVI(adaptation luminance), cd/m2.
Image<float> compute_threshold(const Image<float>& aleph, const Image<float>& adaptation_luminance);

}  // namespace aleph
