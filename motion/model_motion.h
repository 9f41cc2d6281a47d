#pragma once
// Model-based motion, thesis 5.1.2: reproject the same surface point Q(u,v) at both times and subtract the projections.

#include "engine/pose/camera_view.h"
#include "engine/pose/pose.h"
#include "engine/rays/first_hits.h"
#include "engine/rays/ray_scene.h"
#include "motion/motion_field.h"

namespace aleph {

/// One of the two moments between which things move.
struct MotionMoment {
    const ScenePose* frame = nullptr;
    const CameraView* view = nullptr;
};

struct ModelMotionSettings {
    /// The other moment is N-1 (the scene's last frame): displacement is P - P_other, so that constant speed gives what
    /// the forward difference gives (HARD_CASES RP-11).
    bool backward = false;
    /// A camera cut or no other frame: displacement 0, every surface pixel `no_counterpart`.
    bool cut = false;
    /// How many degrees of turn (of an object or the camera) a chord may stand for.
    double chord_degrees = 20.0;
};

/// Exact motion of every first hit. Pure; double throughout; a world and camera that do not move give exactly 0.
/// @param hits  first hits of `now`, of its view's size
MotionField compute_model_motion(const Scene& scene, const MotionMoment& now, const MotionMoment& other,
                                 const Image<Hit>& hits, const ModelMotionSettings& settings);

/// Marks valid pixels whose point something hides in the other frame as `hidden` (one ray each).
/// @param other_rays  updated to the other frame
/// @return rays cast
std::uint64_t mark_hidden(MotionField& field, const Scene& scene, const MotionMoment& other, const Image<Hit>& hits,
                          const RayScene& other_rays);

}  // namespace aleph
