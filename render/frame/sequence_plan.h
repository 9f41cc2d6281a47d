#pragma once
// The effects plan of one frame of a sequence, and the settings and facts that it comes from.

#include "motion/other_frame.h"
#include "render/frame/frame_output.h"
#include "render/pixels/sample_place.h"
#include "render/plan/effects_plan.h"
#include "render/time/shutter.h"

namespace aleph {

struct FramePlan {
    FrameFacts facts;
    ShutterFacts shutter;
    LensFacts lens;
    bool perceives = false, maps = false, has_other = false, moves = true, moments = false;
    EffectsPlan effects;
    RenderSettings settings;  ///< the sequence's, without the indirect light that is skipped
    double seconds = 0.0;     ///< that planning took

    bool skips(Effect effect) const { return effects.skips(effect); }
};

/// How far the picture moves while a camera takes these values in turn, about the middle one; nothing if that is not
/// known, because it moves past objects.
/// @param nearest  m, distance of what is in view; 0: not known
std::optional<BlurMoments> find_camera_blur(const std::vector<CameraValues>& cameras, int width, int height,
                                            double nearest, double& largest);

/// Largest diameter of the circle of confusion, pixels.
/// @param nearest  m along the view direction, of what is in view
double find_largest_circle(const CameraView& view, double radius, double focus, double nearest);

}  // namespace aleph
