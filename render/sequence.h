#pragma once
// Frames of an animation, end to end. Only this stage knows the order of the others (DESIGN "A frame"):
// pose(N), pose(N+1) -> first hits -> quick estimate -> motion field -> saliency, Aleph map -> alpha -> frame.

#include <array>
#include <memory>
#include <string>

#include "engine/pose/camera_view.h"
#include "engine/rays/first_hits.h"
#include "motion/motion_field.h"
#include "perception/perception.h"
#include "render/settings.h"
#include "render/shaded_frame.h"

namespace aleph {

/// Seconds by stage, in the order in which they run; total includes writing where the caller adds it.
struct StageSeconds {
    double pose = 0, update = 0, first_hits = 0, estimate = 0, motion = 0, perception = 0, fill = 0, shade = 0,
           write = 0, total = 0;
};
/// The stages' names with their values, as files show them.
std::array<std::pair<const char*, double>, 10> list_stages(const StageSeconds& seconds);

struct FrameStatistics {
    std::int64_t frame = 0;
    StageSeconds seconds;
    RayCounts rays;
    std::uint64_t traced_rays = 0;   ///< what the ray wrapper counted; equals rays.total()
    std::uint64_t invalid_rays = 0;  ///< refused by the wrapper
    std::uint64_t records = 0;       ///< irradiance values computed
    FillStatistics cache;
    std::uint64_t samples = 0;                ///< pixel samples
    std::uint64_t nan_count = 0;              ///< samples thrown away
    std::uint64_t replaced = 0, clamped = 0;  ///< what sanitize_estimate changed
    bool saliency_fallback = false;
    double median_luminance = 0.0;  ///< of the estimate, cd/m2; thresholds mean little outside 1e-3 to 1e4 (CS-14)
    std::size_t instances_touched = 0;
    double peak_memory_mib = 0.0;
};

/// What is wanted of a frame beyond its statistics.
struct FrameRequest {
    bool frame = true;       ///< the rendered picture
    bool maps = false;       ///< every map of perception and motion, and the visibility that motion.valid needs
    FrameProgress progress;  ///< may be empty
};

struct FrameOutput {
    ShadedFrame shaded;  ///< filled if `frame`
    CameraView view;
    Image<Hit> hits;      ///< through the pixel centres
    Image<Rgb> estimate;  ///< sanitized
    MotionField motion;
    Image<float> velocity;  ///< deg/s
    PerceptionMaps perception;
    Image<float> alpha;       ///< ambient accuracy
    Image<float> threshold;   ///< cd/m2
    Image<float> depth;       ///< planar, m; 1e30 for background. Filled if `maps`
    Image<glm::vec3> normal;  ///< world, towards the viewer; 0 for background. Filled if `maps`
    FrameStatistics statistics;
};

/// Renders frames of one scene. Keeps the ray structures between frames, so that a frame costs what changed; what it
/// returns depends on scene, settings and frame number alone.
class Sequence {
  public:
    /// @param scene  must outlive this
    /// @throws InputError: settings out of range, no such camera, or an effect that is not in this version
    Sequence(const Scene& scene, const RenderSettings& settings, const std::string& camera = "");
    ~Sequence();
    Sequence(Sequence&&) noexcept;

    FrameOutput render(std::int64_t frame, const FrameRequest& request = {});

    /// Factor on radiance: the scene's, or found from its first frame (DESIGN "Conventions").
    double exposure() const;
    FrameRange range() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace aleph
