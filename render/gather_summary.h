#pragma once
// What the radiance and the distances over a hemisphere tell besides the irradiance: gradients, noise, free space.

#include "render/gather.h"

namespace aleph {

/// Sets everything in `out` but the irradiance, which must be set.
/// @param basis  of the hemisphere
void summarize_hemisphere(const HemisphereStrata& strata, const Basis& basis, GatherScratch& scratch,
                          IrradianceSample& out);

/// The rays that found at least 4 times the mean radiance of all cells; of more than 48, those that weigh most in the
/// second moment.
void list_bright_hits(const HemisphereStrata& strata, const GatherScratch& scratch, std::vector<BrightHit>& out);

}  // namespace aleph
