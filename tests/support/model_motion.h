#pragma once
// Model-based motion of a single pair of frames.

#include "engine/pose/plan.h"
#include "motion/model_motion.h"

namespace aleph {

inline MotionField compute_model_motion(const Scene& scene, const PosedView& now, const PosedView& other,
                                        const Image<Hit>& hits, OtherFrame which = OtherFrame::next) {
    const PosePlan plan = make_pose_plan(scene);
    return ModelMotion(scene, plan).compute(now, other, hits, which);
}

}  // namespace aleph
