#pragma once
// The picture that surrounds a scene, as light.

#include "engine/scene/scene.h"

namespace aleph {

/// Turns the pixels of the environment's picture into linear floats where they are 8-bit sRGB. A picture that is a
/// texture too stays as it is: the environment gets a copy, under a name of its own and with the same path.
/// Called before includes are appended, as the scene's own images come first.
void make_environment_linear(Scene& scene);

}  // namespace aleph
