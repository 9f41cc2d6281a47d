#pragma once
// What a scene should be told about or given once it is complete, whatever file it came from.

#include "engine/scene/scene.h"

namespace aleph {

/// Warns of rotation keys that are more than 170 degrees apart (interpolation takes the short way, perhaps not the one
/// that was meant: HARD_CASES RP-08) and of rotations whose length is off by more than 1e-3 (they count at length 1).
void add_rotation_warnings(Scene& scene);

/// Warns of materials of drawn meshes that let light through, or have holes (alpha modes), which the renderer shows as
/// opaque.
void add_surface_warnings(Scene& scene);

/// True if something can give light at some time: a light on a node, an environment, a used material that emits.
bool has_light(const Scene& scene);

/// Gives a scene without light a constant white environment, and says so in a warning.
void add_missing_light(Scene& scene);

}  // namespace aleph
