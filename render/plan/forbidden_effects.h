#pragma once
// Scenes and settings without the effects that a user forbids.

#include "render/settings/settings.h"

namespace aleph {

/// Takes out of the scene what textures, normal maps, alpha, emission, environment and deformation come from. Other
/// effects are left out of the work of each frame.
void remove_forbidden(const EffectSet& forbidden, Scene& scene);

/// Settings under which forbidden effects are not computed.
RenderSettings without_forbidden(RenderSettings settings);

}  // namespace aleph
