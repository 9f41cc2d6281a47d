#pragma once
// Keys at every frame, for programs that interpolate otherwise than aleph.

#include "engine/scene/scene.h"

namespace aleph {

/// Gives turns, and what moves along cubic keys, a key at every frame of the scene (frame_range), straight between
/// them. At frames, transforms stay what they are. Step and nearest keys, linear translations and scales, matrices and
/// transform operations are left.
/// @throws InputError for more than 4 million keys in all
void key_frames(Scene& scene);

}  // namespace aleph
