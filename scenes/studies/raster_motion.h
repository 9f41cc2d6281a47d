#pragma once
// Motion as rasterized ID and UV maps tell it (Yee 2000, 5.1.2): the triangle of each pixel is known exactly, the place
// on it to 8 bits for each coordinate.

#include "engine/pose/posed_view.h"
#include "engine/rays/hit.h"
#include "motion/motion_field.h"

namespace aleph {

/// The motion from each pixel's centre to where the point lies in the other frame that its quantized coordinates name.
/// @param exact  model-based motion of the same hits
MotionField compute_raster_motion(const Scene& scene, const PosedView& other, const Image<Hit>& hits,
                                  const MotionField& exact);

/// A coordinate on a triangle, [0,1], as a colour channel of 8 bits keeps it.
float quantize_coordinate(float coordinate);

}  // namespace aleph
