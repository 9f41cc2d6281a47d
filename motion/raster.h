#pragma once
// A rasterizer: which triangle each pixel shows, and where on it to 8 bits for each coordinate, as the ID map and the
// UV map of Yee 2000, 5.1.2, tell it; and motion from these maps, which the thesis describes beside ray casting.

#include "motion/model_motion.h"

namespace aleph {

/// The triangle at every pixel centre. u and v are whole 255ths, so that u + v may be above 1 by one of them; distance
/// is the depth along the viewing axis, m. Of several triangles at one depth the first is shown, by instance, then by
/// primitive. An edge that two triangles share belongs to one of them, so that there are neither cracks nor pixels
/// drawn twice. Triangles are cut off where the camera is, and not at its near plane, as rays are. Alpha is not read: a
/// cut-out hides what is behind it. Arithmetic is in double and the same on every processor.
Image<Hit> rasterize(const Scene& scene, const PosedView& posed);

/// As ModelMotion::compute, but from each pixel's centre to where the place that the item names lies in the other
/// frame: off by up to half a 255th of a triangle, at rest too. The path length is that of the
/// displacement, or the sum of ModelMotion::compute where something turns further than one chord stands for.
/// @param items  rasterize(scene, now)
MotionField compute_raster_motion(ModelMotion& model, const Scene& scene, const PosedView& now, const PosedView& other,
                                  const Image<Hit>& items, OtherFrame which = OtherFrame::next);

}  // namespace aleph
