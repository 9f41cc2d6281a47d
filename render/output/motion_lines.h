#pragma once
// Motion drawn on a picture.

#include "engine/base/color.h"
#include "engine/base/image.h"
#include "motion/motion_field.h"

namespace aleph {

/// Frames that each line takes at its pixel's present speed.
inline constexpr int motion_line_frames = 4;

/// Draws lines from every 12th pixel in both directions to where its surface point is after so many frames; a square of
/// 2 pixels is at their beginning. Pixels without motion have none.
/// @param picture  linear RGB, of the motion's size
void draw_motion(Image<Rgb>& picture, const MotionField& motion);

}  // namespace aleph
