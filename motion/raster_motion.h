#pragma once
// Motion from rasterized maps, as Yee 2000, 5.1.2, describes it beside ray casting: from each pixel's centre to where
// the place that the item buffer names lies in the other frame.

#include "motion/model_motion.h"

namespace aleph {

/// As ModelMotion::compute, but for places known to 8 bits, and measured from the pixel's centre: off by up to half a
/// 255th of a triangle, in a frame without motion too. The path length is that of the displacement.
/// @param items  rasterize(scene, now)
MotionField compute_raster_motion(ModelMotion& model, const Scene& scene, const PosedView& now, const PosedView& other,
                                  const Image<Hit>& items, OtherFrame which = OtherFrame::next);

}  // namespace aleph
