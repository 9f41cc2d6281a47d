#pragma once
// Image velocity, thesis 5.1.3: from pixels per frame to degrees of visual angle per second.

#include "engine/base/frame_rate.h"
#include "engine/base/image.h"
#include "engine/base/viewing.h"
#include "motion/motion_field.h"

namespace aleph {

/// Yee 2000, eq. 5.1: v_I = path length / pixels per degree * frames per second, deg/s. 0 where the motion is not
/// known (behind the camera, no counterpart).
/// @throws InputError if pixels per degree or the frame rate is not positive and finite
Image<float> compute_image_velocity(const MotionField& motion, const ViewingConditions& viewing,
                                    const FrameRate& frame_rate);

}  // namespace aleph
