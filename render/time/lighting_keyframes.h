#pragma once
// Lighting keyframes of a shot: the frames at which indirect light is computed. A frame between two of them reads both.

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "engine/pose/plan.h"
#include "engine/scene/scene.h"
#include "render/settings/settings.h"

namespace aleph {

/// Returns whether frames with a closed shutter read their indirect light from lighting keyframes.
inline bool reads_keyframes(const RenderSettings& settings) {
    return settings.light.integrator == Integrator::cache && settings.cache.light_step > 0 &&
           settings.light.bounces > 0 && settings.light.path_depth > 1 && settings.cache.accuracy > 0.0;
}

/// Lighting keyframes are the first frame of the range and every `step`-th before and after it, the last frame of the
/// range, and both sides of every cut and of every jump of the light.
struct LightingKeyframes {
    FrameRange range;
    std::vector<std::int64_t> cuts;  ///< frames that begin a new shot
    std::int64_t step = 10;          ///< frames, at least 1
    /// Frames after `first`, up to `last`, before which the light jumps (LightBreaks). May be empty.
    std::function<std::vector<std::int64_t>(std::int64_t first, std::int64_t last)> breaks;
};

/// The lighting keyframes around a frame: before <= frame <= after. A lighting keyframe has itself on both sides.
struct KeyframePair {
    std::int64_t before = 0, after = 0;
    double weight = 0.0;  ///< of `after`; 1 - weight is that of `before`

    bool operator==(const KeyframePair&) const = default;
};

KeyframePair find_keyframes(const LightingKeyframes& keyframes, std::int64_t frame);

/// Frames whose views meet a lighting keyframe: its own, and the lighting keyframes before and after it, unless a cut
/// or an end of the range lies between.
std::vector<std::int64_t> find_keyframe_views(const LightingKeyframes& keyframes, std::int64_t keyframe);

/// Where only the camera moves: the keyframe whose light others begin with. There is one in the middle of about every
/// ten steps between cuts.
std::int64_t find_base_keyframe(const LightingKeyframes& keyframes, std::int64_t keyframe);

/// Jumps of a shot's light: frames between which it cannot be interpolated. Only transforms, visibility, lights and
/// materials are posed, not the points of deforming meshes.
class LightBreaks {
  public:
    /// Keeps references to scene and plan.
    /// @param seconds  at which a frame is looked at (find_shutter_center)
    LightBreaks(const Scene& scene, const PosePlan& plan, std::function<double(std::int64_t frame)> seconds)
        : scene_(scene), plan_(plan), seconds_(std::move(seconds)) {}

    /// Frames after `first`, up to `last`, that differ from the frame before them by a jump: a mesh or a lamp comes or
    /// goes; or the light of a lamp (its range and cone, too), of an emissive material or of the environment changes by
    /// more than a quarter of the largest value that it has in the span.
    const std::vector<std::int64_t>& find(std::int64_t first, std::int64_t last);

    /// Returns whether such a change lies within an interval of time, which may be slow there: it is looked at nine
    /// times, and at keys.
    /// @param open, close  frames
    bool changes(double open, double close);

  private:
    struct Sources;
    Sources look(double seconds);

    const Scene& scene_;
    const PosePlan& plan_;
    const std::function<double(std::int64_t frame)> seconds_;
    std::optional<ScenePose> posed_;
    std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::int64_t>> found_;
};

}  // namespace aleph
