#pragma once
// The cameras of the scenes. Camera and node are both called "camera"; the camera looks along the -z of its node.

#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// Adds a camera to the last node.
/// @param fov_degrees  vertical
void hang_camera(Scene& scene, double fov_degrees);

/// Position and target of the camera on a frame.
struct CameraStop {
    double frame;  ///< 30 frames per second
    glm::dvec3 eye, target;
};

/// A camera that moves from stop to stop, eased in between. The node "camera_rig" moves and rotates about y, the node
/// below it rotates about x.
void add_walking_camera(Scene& scene, const std::vector<CameraStop>& stops, double fov_degrees);

}  // namespace aleph
