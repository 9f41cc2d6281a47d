#pragma once
// Pixels per frame to degrees per second.

#include "engine/base/image.h"
#include "engine/base/viewing.h"
#include "motion/motion_field.h"

namespace aleph {

/// (5.1): v_I = path length / pixels per degree * frames per second, deg/s. 0 where motion is not known (behind the
/// camera, no counterpart).
/// @throws InputError if pixels per degree or the frame rate is not positive and finite (HARD_CASES RP-21)
Image<float> compute_image_velocity(const MotionField& motion, const ViewingConditions& viewing);

}  // namespace aleph
