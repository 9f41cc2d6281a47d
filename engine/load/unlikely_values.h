#pragma once
// Warnings about values that are allowed and probably meant otherwise.

#include "engine/scene/scene.h"

namespace aleph {

/// Warns of fields of view and rotations of the scene file that look like radians.
void add_radian_warnings(Scene& scene);

/// Warns of cuts outside the frame range, and of cameras that jump by step keys where there is no cut.
void add_cut_warnings(Scene& scene);

}  // namespace aleph
