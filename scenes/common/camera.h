#pragma once
// The scenes' cameras. Each is called "camera", as is the node it hangs on; it looks along that node's -z.

#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// Hangs a camera on the last node.
/// @param fov_degrees  vertical
void hang_camera(Scene& scene, double fov_degrees);

/// Where a camera stands on a frame, and what it looks at.
struct CameraStop {
    double frame;  ///< 30 a second
    glm::dvec3 eye, target;
};

/// A camera that walks from stop to stop, eased in between: "camera_rig" carries it and turns about y, the node below
/// it about x.
void add_walking_camera(Scene& scene, const std::vector<CameraStop>& stops, double fov_degrees);

}  // namespace aleph
