#pragma once
// What differs between poses of a scene, and over an interval of time.

#include <optional>
#include <vector>

#include "engine/pose/plan.h"

namespace aleph {

/// Whether anything but cameras differs between two poses of a scene: transforms, visibility, points, materials,
/// lights, environment.
bool world_differs(const PosePlan& plan, const ScenePose& a, const ScenePose& b);

/// A scene over an interval of time.
struct SpanLook {
    bool world = false;                 ///< something but the camera changes
    std::vector<CameraValues> cameras;  ///< at equal steps, from the first time to the last; cut short if `world`

    /// Whether the camera changes.
    bool camera() const;
};

/// Looks at intervals of time, each nine times: a change that is over between two looks is not found.
class SpanLooker {
  public:
    /// Keeps references to scene and plan.
    SpanLooker(const Scene& scene, const PosePlan& plan) : scene_(scene), plan_(plan) {}

    /// @param camera  index into ScenePose::cameras
    /// @param from, to  s
    SpanLook look(int camera, double from, double to);

  private:
    const ScenePose& pose_at(double seconds);

    const Scene& scene_;
    const PosePlan& plan_;
    std::optional<ScenePose> posed_;
};

}  // namespace aleph
