#pragma once
// The frame at which an instance of a cage comes closest to the camera.

#include <optional>
#include <span>
#include <vector>

#include "engine/pose/pose.h"

namespace aleph {

/// By instance: the frame of the scene's range at which it is shown, in view, and largest in the picture, by the ball
/// around its cage's points. Nothing where it is never in view, or where every frame is like the first. Looks at every
/// frame; in very long shots of very many instances at every second, third, ... one, to take seconds at most.
/// @param camera_node  carries a camera
/// @param instances    of meshes of cages
std::vector<std::optional<std::int64_t>> find_closest_passes(const Scene& scene, int camera_node,
                                                             std::span<const Instance> instances, int width,
                                                             int height);

}  // namespace aleph
