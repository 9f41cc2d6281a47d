#pragma once
// Jumps of a shot's light: frames between which it cannot be interpolated.

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "engine/pose/plan.h"

namespace aleph {

/// Looks at every frame of a span. Only transforms, visibility, lights and materials are posed, not the points of
/// deforming meshes.
class LightBreaks {
  public:
    /// Keeps references to scene and plan.
    /// @param shutter  of the camera, at whose centre frames are looked at (find_shutter_center)
    LightBreaks(const Scene& scene, const PosePlan& plan, const glm::dvec2& shutter = glm::dvec2(0.0))
        : scene_(scene), plan_(plan), shutter_(shutter) {}

    /// Frames after `first`, up to `last`, that differ from the frame before them by a jump: a mesh or a lamp comes or
    /// goes; or the light of a lamp, of an emissive material or of the environment changes by more than a quarter of
    /// the largest value that it has in the span.
    const std::vector<std::int64_t>& find(std::int64_t first, std::int64_t last);

    /// Returns whether such a change lies within an interval of time, which may be slow there: it is looked at nine
    /// times.
    /// @param open, close  frames
    bool changes(double open, double close);

  private:
    struct Sources;
    Sources look(double seconds);

    const Scene& scene_;
    const PosePlan& plan_;
    const glm::dvec2 shutter_;
    std::optional<ScenePose> posed_;
    std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::int64_t>> found_;
};

}  // namespace aleph
