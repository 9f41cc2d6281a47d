#pragma once
// The quick estimate of a frame: direct light, indirect light of lighting keyframes, and the blur of shutter and lens.

#include <functional>
#include <memory>
#include <optional>

#include "render/estimate/estimate.h"
#include "render/frame/frame_plan.h"
#include "render/frame/frame_scene.h"
#include "render/shade/sample_shading.h"
#include "render/time/keyframe_light.h"
#include "render/time/shot_light.h"

namespace aleph {

/// The quick estimate of a scene that is prepared, not sanitized.
/// @param nodes  of its indirect light; null: without it
Image<Rgb> estimate_scene(const Shot& shot, const FrameScene& scene, const SampleHits& centers,
                          const EstimateNodes* nodes, RayCounts& counts);

/// Indirect light of the quick estimates of frames. That of lighting keyframes is kept, and other frames begin with it.
class EstimateLight {
  public:
    /// Keeps references. @param shot_light  which lighting keyframes there are; nothing if frames read none
    EstimateLight(const Shot& shot, const std::optional<ShotLight>& shot_light, FrameScene& keyframe)
        : shot_(shot), shot_light_(shot_light), keyframe_(keyframe) {}

    /// Gathers the estimates of the lighting keyframes around a frame, unless they are kept. Moves `keyframe`.
    /// @param but  a keyframe that is prepared next, so that it need not be gathered here
    void gather_around(std::int64_t frame, std::int64_t but, RayCounts& counts);

    /// The nodes of a frame, after gather_around.
    EstimateNodes find_nodes(std::int64_t frame, const FrameScene& scene, const SampleHits& centers, RayCounts& counts);
    /// The same for a frame whose own gathers are not kept, even at a lighting keyframe.
    EstimateNodes gather_nodes(std::int64_t frame, const FrameScene& scene, const SampleHits& centers,
                               RayCounts& counts) const;

  private:
    std::unique_ptr<CarriedEstimate> carry(std::int64_t frame) const;

    const Shot& shot_;
    const std::optional<ShotLight>& shot_light_;
    FrameScene& keyframe_;
    mutable EstimateKeyframes kept_;
};

/// Lens and shutter of a frame, as far as its plan simulates them.
struct OpenLens {
    Lens lens;
    std::optional<ShutterInterval> shutter;
};
OpenLens find_open_lens(const Shot& shot, std::int64_t frame, const FramePlan& plan);

/// A frame whose shutter or lens may be open.
struct OpenFrame {
    const Shot& shot;
    std::int64_t number = 0;
    const FramePlan& plan;
    const FrameScene& scene;
    FrameScene& shutter;  ///< moved to times while the shutter is open
};

/// The scene while the shutter of a frame is open, valid until the next call. It leaves out what the frame does.
/// @param at  frames
SampleScene open_scene(const OpenFrame& frame, double at);

/// Blurs the sharp estimate by shutter and lens, if they are open.
/// @param motion  of the frame
/// @param sharp   the estimate; replaced
/// @return how much the luminance of each pixel changes while the shutter is open, up to that of white, 1; of what
///     passes between two of the times that are looked at, too. Empty if it is closed
Image<float> blur_frame_estimate(const OpenFrame& frame, const SampleHits& centers, const EstimateNodes* nodes,
                                 const MotionField& motion, Image<Rgb>& sharp, RayCounts& counts);

/// A frame's quick estimate at the shutter's centre, through a pinhole.
struct SharpEstimate {
    const ShadingScene& shading;
    const CameraView& view;
    const SampleHits& centers;
    const Image<Rgb>& picture;
    const EstimateNodes* nodes;  ///< for the indirect light; null if there is none
    EstimateKind kind;
    double exposure;
    bool lasts;  ///< while the shutter is open, no light comes, goes or fades
};

/// Times and places on the lens that a blurred estimate is the mean of. They are the same in all pixels, so that the
/// estimate has no noise.
inline constexpr int blur_looks = 8;

/// A blurred estimate, and how much the luminance of each pixel differs between its times, up to that of white.
struct BlurredEstimate {
    Image<Rgb> picture;
    Image<float> swing;
};

/// At each of its times, every pixel shows a surface. Its light is read from the sharp estimate where that shows the
/// same point, and is computed elsewhere. So what does not move and is in focus keeps its values, unless the light
/// comes, goes or fades.
/// @param look    the scene at a place of the shutter, in [0,1], valid until the next call
BlurredEstimate blur_estimate(const SharpEstimate& sharp, const std::function<SampleScene(double place)>& look,
                              RayCounts& counts);

}  // namespace aleph
