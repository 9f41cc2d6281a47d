#pragma once
// The effects plan of one frame of a sequence, and the settings and facts that it comes from.

#include "engine/pose/posed_view.h"
#include "motion/motion_field.h"
#include "render/frame/frame_output.h"
#include "render/frame/shot.h"
#include "render/pixels/pixel_surfaces.h"
#include "render/plan/effects_plan.h"
#include "render/time/lighting_keyframes.h"
#include "render/time/shutter.h"

namespace aleph {

struct FramePlan {
    PlanInput input;
    EffectsPlan effects;
    RenderSettings settings;  ///< the sequence's, without the indirect light that is skipped
    Lens lens;                ///< at its widest while the shutter is open
    double seconds = 0.0;     ///< that planning took

    bool skips(Effect effect) const { return effects.skips(effect); }
};

/// Work on a frame before its picture.
struct FrameWork {
    std::int64_t frame = 0;
    bool perceive = false;     ///< estimate, motion, and the model of vision
    bool maps = false;         ///< every map
    bool motion_only = false;  ///< of what `perceive` says
    OtherFrame other = OtherFrame::none;
    bool edited = false;       ///< motion leads from a frame before an edit
    bool lasts = false;        ///< other frames have its noise too: copies of it, or those that read its light
    FrameProgress progress{};  ///< may be empty

    void report(const char* stage) const {
        if (progress) progress(0.0, stage);
    }
};

/// Makes the effects plans of a shot's frames.
class FramePlanner {
  public:
    /// Keeps references.
    FramePlanner(const Shot& shot, LightBreaks& light_breaks) : shot_(shot), light_breaks_(light_breaks) {}

    /// Plans to skip what cannot change the picture, as far as that is known before the first ray.
    FramePlan begin(const FrameWork& work, const PosedView& posed);

    /// Adds what a viewer cannot see, once the frame has been estimated.
    /// @param hits  through the pixel centres
    void finish(const Image<Hit>& hits, const FrameOutput& out, FramePlan& frame) const;

  private:
    /// Plans the effects, and sets the bounces that are left.
    void plan(FramePlan& frame, const std::optional<VisibleFrame>& visible) const;
    ShutterFacts find_shutter_facts(const FrameWork& work, const FrameFacts& facts, double nearest);
    void find_lens_facts(const FrameWork& work, const PosedView& posed, double nearest, FramePlan& frame);
    std::vector<CameraValues> look(int camera, double from, double to);

    const Shot& shot_;
    LightBreaks& light_breaks_;
    std::optional<ScenePose> posed_;  ///< when cameras were looked at last: only what can move is posed again
    std::optional<ShotFacts> facts_;  ///< once a frame was planned
};

}  // namespace aleph
