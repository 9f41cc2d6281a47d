#pragma once
// A camera for a scene that has none.

#include "engine/scene/scene.h"

namespace aleph {

/// Adds a camera on a node of its own, and a warning. The camera sees everything that is visible at up to 16 frames of
/// the scene's range, from the +z side and a little above, with a field of view of 45 degrees. Camera and node become
/// the first of their lists, as elements of the scene come before those of includes: other indices grow by one.
void add_framing_camera(Scene& scene);

}  // namespace aleph
