#pragma once
// From the Aleph map to the luminance error that a viewer tolerates: Yee 2000, section 6.2.

#include "engine/base/color.h"
#include "engine/base/frame_rate.h"
#include "engine/base/image.h"
#include "engine/base/viewing.h"
#include "perception/perception_settings.h"

namespace aleph {

/// Threshold versus intensity (Ward-Larson, Rushmeier and Piatko 1997): cd/m2 to cd/m2. Every input gives a finite
/// positive result: below 1e-6 and for NaN that of 1e-6, above 1e12 that of 1e12.
double tvi(double luminance);

/// Adaptation luminance, cd/m2: mean over the pixels within half a degree that lie in the image.
/// @throws InputError if the estimate is empty, or viewing is not positive and finite
Image<float> compute_adaptation_luminance(const Image<Rgb>& estimate, const ViewingConditions& viewing);

/// The luminance error that goes unseen if it lasts, cd/m2: aleph * TVI(adaptation luminance) (6.9), with castle
/// aleph * castle_threshold(adaptation luminance).
/// @throws InputError if the sizes differ
Image<float> compute_threshold(const Image<float>& aleph, const Image<float>& adaptation_luminance,
                               Vision vision = Vision::thesis);

/// The luminance error that goes unseen if it is new in every frame, cd/m2: castle_flicker_threshold(adaptation
/// luminance) for every model of vision, and never more than `threshold`.
/// @param threshold  compute_threshold
/// @throws InputError if the sizes differ
Image<float> compute_flicker_threshold(const Image<float>& threshold, const Image<float>& adaptation_luminance,
                                       const FrameRate& frame_rate);

}  // namespace aleph
