#pragma once
// Summary of the radiance and the distances over a hemisphere: gradients, noise and free space, beside the irradiance.

#include "render/cache/gather.h"

namespace aleph {

/// Sets everything in `out` but the irradiance, which must be set.
/// @param basis  of the hemisphere
void summarize_hemisphere(const HemisphereStrata& strata, const Basis& basis, GatherScratch& scratch,
                          IrradianceSample& out);

}  // namespace aleph
