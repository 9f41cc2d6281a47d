#pragma once
// Warnings and defaults of a complete scene, whatever file it came from.

#include "engine/scene/scene.h"

namespace aleph {

/// Warns of rotation keys that are more than 170 degrees apart, as interpolation takes the short way and the other may
/// be meant, and of rotations whose length is off by more than 1e-3 (they count at length 1). Nodes, and the
/// environment's picture.
void add_rotation_warnings(Scene& scene);

/// True where surfaces of the material give light at some time.
bool gives_light(const Material& material);

/// True if something gives light at some time: a light on a node, an environment, a used material that emits.
bool has_light(const Scene& scene);

/// Gives a scene without light a constant white environment and a warning.
void add_missing_light(Scene& scene);

}  // namespace aleph
