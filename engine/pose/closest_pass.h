#pragma once
// The frame at which an instance of a cage comes closest to the camera.

#include <glm/mat4x4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/pose/camera_view.h"
#include "engine/pose/pose.h"

namespace aleph {

/// An instance and the camera at a frame.
struct ClosestPass {
    double seconds = 0.0;
    glm::dmat4 world{1.0};
    CameraView view;
};

/// By instance: the frame of the scene's range at which it is shown, in view, and largest in the picture, by the ball
/// around its cage's points. Nothing where it is never in view, or where every frame is like the first. Looks at every
/// frame; in very long shots of very many instances at every second, third, ... one, to take seconds at most.
/// @param camera_node  carries a camera
/// @param instances    of meshes of cages
std::vector<std::optional<ClosestPass>> find_closest_passes(const Scene& scene, int camera_node,
                                                            std::span<const Instance> instances, int width, int height);

}  // namespace aleph
