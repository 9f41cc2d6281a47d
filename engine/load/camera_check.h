#pragma once
// Cameras that look in no direction.

#include "engine/scene/scene.h"

namespace aleph {

/// Refuses a camera whose node and parents scale two or all axes to 0, at the first, the middle and the last frame: it
/// has no axes left. A scale that passes through 0 in between is fine.
/// @throws InputError naming the file that brought the camera, and its node
void check_camera_axes(const Scene& scene);

}  // namespace aleph
