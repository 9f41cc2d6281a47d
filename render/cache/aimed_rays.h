#pragma once
// Rays of a gather towards bright surfaces (bright_surfaces.h). They follow those over the hemisphere and are lit with
// them.

#include "engine/base/sampling.h"
#include "render/cache/gather.h"
#include "render/light/bright_surfaces.h"
#include "render/pixels/pixel_surfaces.h"

namespace aleph {

/// Rays over the hemisphere for each one towards bright surfaces.
inline constexpr int around_per_aimed = 2;

/// Bright surfaces for light that is wanted at these surfaces.
BrightSurfaces find_bright_surfaces(const LightingContext& lighting, const std::vector<PixelSurface>& seen,
                                    RayCounts& counts);

/// Adds GatherScratch::aims rays, but those that find no bright surface above the point.
void aim_rays(const BrightSampler& sampler, const SurfacePlace& point, RandomStream& random, GatherScratch& scratch);

/// Sets the weights of all rays by what they met. Aimed rays that met something else then count as if they had met
/// nothing.
void weigh_rays(const BrightSampler& sampler, GatherScratch& scratch);

/// Adds the light of the aimed rays to that of the others, with its gradients and its noise.
void add_aimed(const glm::vec3& normal, const GatherScratch& scratch, IrradianceSample& out);

}  // namespace aleph
