#pragma once
// A camera over an interval of time.

#include <optional>
#include <vector>

#include "engine/pose/plan.h"

namespace aleph {

/// Keeps a pose of the scene, so that only what can move is posed again.
class CameraSpan {
  public:
    /// Keeps references to scene and plan.
    CameraSpan(const Scene& scene, const PosePlan& plan) : scene_(scene), plan_(plan) {}

    /// The camera's values at nine equal steps, both ends included.
    /// @param camera  index into ScenePose::cameras
    /// @param from, to  s
    std::vector<CameraValues> look(int camera, double from, double to);

  private:
    const Scene& scene_;
    const PosePlan& plan_;
    std::optional<ScenePose> posed_;
};

}  // namespace aleph
