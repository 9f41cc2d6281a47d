#pragma once
// Rays of a gather towards bright surfaces (bright_surfaces.h). They follow those over the hemisphere and are lit with
// them; then their light is added up apart.

#include "engine/base/sampling.h"
#include "render/cache/gather.h"
#include "render/light/bright_surfaces.h"

namespace aleph {

/// Rays over the hemisphere for each one towards bright surfaces.
inline constexpr int around_per_aimed = 2;

/// Adds the rays, and how each was aimed (GatherScratch::aimed).
void aim_rays(const BrightSampler& sampler, const SurfacePlace& point, int count, RandomStream& random,
              GatherScratch& scratch);

/// Sets the weights of all rays by what they met (GatherScratch::weights). Aimed rays that met something else then
/// count as if they had met nothing.
void weigh_rays(const BrightSampler& sampler, GatherScratch& scratch);

/// The irradiance and its summary, as add_up_rays of those over the hemisphere, with the light of the aimed rays.
/// @param aimed  rays that were to be aimed
IrradianceSample add_up_with_aimed(const HemisphereStrata& strata, const glm::vec3& normal,
                                   const BrightSurfaces& surfaces, int aimed, GatherScratch& scratch);

}  // namespace aleph
