#pragma once
// Rays from the lights into the scene: what their light meets first.

#include <vector>

#include "render/light/light_choice.h"

namespace aleph {

/// Where a light ray met a surface.
struct LitPlace {
    int instance = no_index;  ///< no_index: it met nothing
    int primitive = 0;
    bool behind = false;          ///< on the side that the triangle's normal points away from
    glm::vec2 barycentric{0.0f};  ///< as in Hit
    double reflected = 0.0;       ///< lm, of the light that the ray stands for
};

/// Casts light rays from all lights: half of them in proportion to power; of the other half as many from each, for what
/// stands beside a small one. Those of directional light and of the environment come through the openings or,
/// where none are known, cross the target. Smooth sheets of glass let them pass.
/// @return  for each ray; nothing if it is dark
/// @param target  where light from afar is looked for
/// @param counts  increased, rays as RayCounts::gather
std::vector<LitPlace> cast_light_rays(const LightingContext& context, const BoundingSphere& target, std::size_t count,
                                      RayCounts& counts);

}  // namespace aleph
