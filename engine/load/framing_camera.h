#pragma once
// A camera for a scene that has none.

#include "engine/scene/scene.h"

namespace aleph {

/// Adds a camera, on a node of its own, that sees everything visible at up to 16 frames of the scene's range: 45
/// degrees, on the +z side and a little above. Camera and node come first, as a scene's own elements do, so other
/// numbers grow by one. Says so in the scene's warnings.
void add_framing_camera(Scene& scene);

}  // namespace aleph
