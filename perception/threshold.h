#pragma once
// From the Aleph map to the luminance error that a viewer tolerates: Yee 2000, section 6.2.

#include "engine/base/color.h"
#include "engine/base/image.h"
#include "perception/vision/vision_list.h"
#include "perception/vision/vision_model.h"

namespace aleph {

/// @throws InputError if pixels per degree or the white of the display is not positive and finite, or persistence is
/// not in [0,1]
void check_viewing(const ViewingConditions& viewing);

/// Adaptation luminance, cd/m2: mean over the pixels within half a degree that lie in the image.
/// @throws InputError if the estimate is empty, or viewing is not positive and finite
Image<float> compute_adaptation_luminance(const Image<Rgb>& estimate, const ViewingConditions& viewing);

/// The luminance error that goes unseen if it lasts, cd/m2: aleph times the model's threshold at that luminance (6.9).
/// @throws InputError if the sizes differ
Image<float> compute_threshold(const Image<float>& aleph, const Image<float>& adaptation_luminance,
                               const VisionModel& vision = thesis_vision());

}  // namespace aleph
