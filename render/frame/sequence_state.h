#pragma once
// State that a Sequence keeps between frames.

#include <memory>
#include <optional>

#include "perception/noise_threshold.h"
#include "render/frame/prepared_frame.h"
#include "render/frame/static_spans.h"
#include "render/shade/frame.h"
#include "render/time/lighting_keyframes.h"
#include "render/time/shot_light.h"

namespace aleph {

/// A frame does not depend on what this keeps: it only saves work. All of it is updated to the same values as made
/// anew.
struct SequenceState {
    /// @param shots  list_camera_shots(given, name)
    SequenceState(Scene given, const RenderSettings& settings, const std::vector<CameraShot>& shots);

    /// Prepares a frame in `here`.
    PreparedFrame prepare(std::int64_t frame, bool perceive, bool maps, const FrameProgress& progress = {});
    TracedRays traced() const { return here.traced() + keyframe.traced() + motion.traced() + shutter.traced(); }

    /// How visible the noise of a frame is. It lasts where other frames have the same.
    const NoiseVisibility& noise(const FrameWork& work);

    Shot shot;
    StaticSpans static_spans;
    StaticFrame static_frame;
    FrameScene here;      ///< the scene at the frame that is rendered
    FrameScene keyframe;  ///< the scene at a lighting keyframe
    LightBreaks light_breaks;
    std::optional<ShotLight> shot_light;  ///< if frames read lighting keyframes
    FramePlanner planner;
    EstimateLight estimate_light;
    FrameMotion motion;
    FrameScene shutter;                                         ///< the scene while the shutter is open
    std::optional<NoiseVisibility> lasting_noise, fresh_noise;  ///< made when first needed
    std::optional<std::int64_t> rendered;                       ///< the last frame, for an edit
};

/// How the samples of a prepared frame are taken. Refers to its plan.
SampleOptions find_sample_options(SequenceState& s, std::int64_t frame, const FramePlan& plan);

/// The light of the lighting keyframes around a frame; null if it reads none.
/// @param filled  the keyframes that were computed for it are added
std::unique_ptr<CarriedLight> find_carried_light(SequenceState& s, std::int64_t frame, const FramePlan& plan,
                                                 std::vector<KeyframeStatistics>& filled,
                                                 const FrameRequest& request = {});

/// Fills the cache, shades the picture and adds their times and counts to the frame's statistics.
/// @param carried  light of lighting keyframes; may be null
void shade_prepared(SequenceState& s, std::int64_t frame, PreparedFrame& prepared, const CarriedLight* carried,
                    SampleOptions options, const FrameRequest& request = {});

/// A frame by itself, whether or not it is in a static span.
FrameOutput render_frame(SequenceState& s, std::int64_t frame, const FrameRequest& request);

}  // namespace aleph
