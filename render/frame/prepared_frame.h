#pragma once
// A frame before its picture: pose, first hits and, where something obeys it, estimate, motion and the model of vision.

#include "perception/noise_threshold.h"
#include "render/frame/frame_estimate.h"
#include "render/frame/frame_motion.h"
#include "render/shade/progressive.h"

namespace aleph {

struct PreparedFrame {
    FramePlan plan;
    SampleHits centers;  ///< hits through the pixel centres
    FrameOutput out;     ///< all but the picture
};

/// State that preparing frames keeps from one to the next. All of it is updated to the same values as made anew.
struct Preparation {
    /// Keeps references. @param shot_light  see EstimateLight
    Preparation(const Shot& given, const std::optional<ShotLight>& shot_light, FrameScene& here, FrameScene& keyframe)
        : shot(given),
          planner(given),
          estimate_light(given, shot_light, keyframe),
          motion(given, here),
          shutter(given, here) {}

    const Shot& shot;
    FramePlanner planner;
    EstimateLight estimate_light;
    FrameMotion motion;
    FrameScene shutter;  ///< the scene while the shutter is open

    /// How visible the noise of a frame is. It lasts where other frames have the same.
    const NoiseVisibility& noise(const FrameWork& work) {
        const bool lasts = work.lasts || shot.keeps_noise(work.frame);
        std::optional<NoiseVisibility>& known = lasts ? lasting_noise_ : fresh_noise_;
        if (!known)
            known.emplace(shot.scene.film.viewing, shot.scene.film.frame_rate,
                          lasts ? NoiseOverTime::lasts : NoiseOverTime::fresh);
        return *known;
    }

  private:
    std::optional<NoiseVisibility> lasting_noise_, fresh_noise_;  ///< made when first needed
};

/// The stages of a frame before its picture, with their times and counts.
/// @param here  posed and prepared for the frame; without what its plan leaves out
PreparedFrame prepare_frame(Preparation& kept, FrameScene& here, FrameWork work);

/// Outlines beside which more is seen. Empty where nothing is known of what a viewer sees.
/// @param shading  of the frame
Image<Outline> find_visible_outlines(const Shot& shot, const ShadingScene& shading, const PreparedFrame& frame);

/// Refers to the outlines and to the frame.
VisibleLimits make_visible_limits(const Shot& shot, const FrameOutput& out, const Image<Outline>& outlines);

/// The tolerance of a lighting keyframe's records (KeyView); empty where no error is asked for.
/// @param shading  of the keyframe
Image<float> find_record_tolerance(const Shot& shot, const ShadingScene& shading, const PreparedFrame& keyframe);

}  // namespace aleph
