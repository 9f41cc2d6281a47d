#pragma once
// Model-based motion, thesis 5.1.2: reproject the same surface point Q(u,v) at both times and subtract the projections.

#include "engine/pose/posed_view.h"
#include "engine/rays/first_hits.h"
#include "engine/rays/ray_scene.h"
#include "motion/motion_field.h"
#include "motion/other_frame.h"

namespace aleph {

/// Exact motion of every first hit. Pure; double throughout; a world and camera that do not move give exactly 0.
/// @param other  not read where `which` is none
/// @param hits   first hits of `now`, of its view's size
MotionField compute_model_motion(const Scene& scene, const PosedView& now, const PosedView& other,
                                 const Image<Hit>& hits, OtherFrame which = OtherFrame::next);

/// Marks valid pixels whose point something hides in the other frame as `hidden` (one ray each).
/// @param other_rays  updated to the other frame
/// @return rays cast
std::uint64_t mark_hidden(MotionField& field, const Scene& scene, const PosedView& other, const Image<Hit>& hits,
                          const RayScene& other_rays);

}  // namespace aleph
