#pragma once
// Request of a frame, and its output: picture, maps, counts and times.

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "engine/base/picture_area.h"
#include "engine/pose/camera_view.h"
#include "engine/rays/hit.h"
#include "motion/motion_field.h"
#include "perception/perception.h"
#include "perception/sanitize.h"
#include "render/pixels/frame_checkpoint.h"
#include "render/pixels/shaded_frame.h"
#include "render/plan/effects_plan.h"

namespace aleph {

/// Seconds by stage, in the order in which they run. `total` includes `write` where the caller adds it; `plan` is what
/// planning took of other stages.
struct StageSeconds {
    double pose = 0, update = 0, first_hits = 0, estimate = 0, motion = 0, perception = 0, fill = 0, shade = 0,
           write = 0, total = 0, plan = 0;
};
/// The stages by name, in that order, without the plan.
std::array<std::pair<const char*, double>, 10> list_stages(const StageSeconds& seconds);

/// Facts about the quick estimate, and what the model of vision made of it.
struct EstimateStatistics {
    SanitizeCounts sanitized;       ///< pixels
    double median_luminance = 0.0;  ///< cd/m2; thresholds of vision hold from 1e-3 to 1e4
    bool saliency_fallback = false;
};

struct FrameStatistics {
    std::int64_t frame = 0;
    /// The earlier frame whose picture this is, because nothing changes between the two. Times and counts are those of
    /// rendering it, or 0 if that output was kept.
    std::optional<std::int64_t> copy_of;
    std::optional<PictureArea> window;  ///< FrameRequest::window: where the images lie in the whole picture
    StageSeconds seconds;
    FrameCounts counts;  ///< of all stages
    TracedRays traced;
    EstimateStatistics estimate;
    std::size_t instances_touched = 0;
    std::optional<ErrorShares> error;  ///< where the visible threshold is known, and pixels have several samples
    EffectsPlan plan;
    double peak_memory_mib = 0.0;
    /// Lighting keyframes that were computed for this frame, not counted above: those it needs that no frame before it
    /// did.
    std::vector<KeyframeStatistics> keyframes;
};

/// Outputs to compute beyond the statistics.
struct FrameRequest {
    bool frame = true;         ///< the picture
    bool maps = false;         ///< every map of perception and motion, with the hidden pixels in motion.validity
    FrameProgress progress{};  ///< may be empty; what it throws ends the frame
    FrameCheckpoint* checkpoint = nullptr;  ///< keeps the state of the frame while it is made; null: it is not kept
    PartialPicture partial{};
    /// Only this part of the picture is shaded; it alone comes out, of every image. Within the picture; nothing: all.
    std::optional<PictureArea> window{};
};

/// The error that each pixel may have.
struct ErrorLimits {
    Image<float> alpha;            ///< ambient accuracy
    Image<float> threshold;        ///< cd/m2, of an error that lasts
    Image<float> threshold_noise;  ///< cd/m2, standard deviation of noise of single pixels (NoiseVisibility)
};

/// Properties of the surfaces seen at the pixel centres.
struct SurfaceMaps {
    Image<Rgb> albedo;        ///< base of what is reflected; 0 for background. Of a scene only
    Image<float> depth;       ///< planar, m; 1e30 for background
    Image<glm::vec3> normal;  ///< world, towards the viewer; 0 for background
    Image<Rgb> effects;       ///< make_effect_picture. Of a scene only
};

/// Maps of motion and perception are computed for the irradiance cache with a guide, and wherever `maps` are requested.
struct FrameOutput {
    ShadedFrame shaded;                ///< filled if `frame`
    CameraView view;                   ///< of the whole picture
    Image<Hit> hits;                   ///< through the pixel centres
    Image<Rgb> estimate;               ///< sanitized
    MotionField motion;                ///< pixels, x right, y down; the channel forward.v is positive upwards
    MotionField backward;              ///< to the frame before; with `maps`, of a scene, model-based
    bool motion_from_picture = false;  ///< as another program wrote it, not computed
    Image<float> velocity;             ///< deg/s
    PerceptionMaps perception;
    ErrorLimits limits;
    SurfaceMaps surface;  ///< filled if `maps`
    FrameStatistics statistics;
};

}  // namespace aleph
