#pragma once
// The motion that the pixels of one object share: where it is at both frames, and at steps between them where it turns
// fast.

#include <vector>

#include "engine/pose/posed_view.h"
#include "motion/other_frame.h"
#include "motion/reprojection.h"
#include "motion/seen_instances.h"

namespace aleph {

/// An instance, or the background.
struct ObjectMotion {
    CameraFromObject now, other;
    bool counterpart = false;  ///< shown in the other frame too
    bool still = false;        ///< both projections are the same bits
    bool deforms = false;
    const Mesh* mesh = nullptr;
    const PosedMesh* shape_now = nullptr;
    const PosedMesh* shape_other = nullptr;
    /// Its place and shape at a time between the frames.
    struct Step {
        CameraFromObject place;
        PosedMesh shape;
    };
    /// From now towards other, where it turns too far for one chord. Else empty.
    std::vector<Step> steps;
};

struct PreparedMotion {
    CameraView now, other;
    std::vector<CameraView> steps;      ///< times between the frames, from now towards other
    std::vector<ObjectMotion> objects;  ///< as SeenInstances numbers them
    ObjectMotion background;
    double sign = 1.0;  ///< displacement_sign
    double diagonal = 0.0;
};

/// Objects and background at both frames, without steps. Refers to the scene and to both poses.
PreparedMotion prepare_motion(const Scene& scene, const PosedView& now, const PosedView& other, OtherFrame which,
                              const SeenInstances& seen);

}  // namespace aleph
