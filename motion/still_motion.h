#pragma once
// Motion of a picture in which nothing moves.

#include "engine/base/image.h"
#include "engine/pose/camera_view.h"
#include "engine/rays/hit.h"
#include "motion/motion_field.h"

namespace aleph {

/// The field that compute_model_motion gives where neither world nor camera move: displacement 0, and what lies before
/// the near plane has no valid motion.
/// @param hits  first hits through the pixel centres of the view
MotionField make_still_motion(const CameraView& view, const Image<Hit>& hits);

}  // namespace aleph
