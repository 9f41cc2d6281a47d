#pragma once
// The rays of a gather: one in each cell of the strata.

#include "engine/base/sampling.h"
#include "render/cache/gather.h"

namespace aleph {

/// Sets the rays of all cells, as far as they are above the true surface, their places, and which cells are below it.
/// @param basis  of the hemisphere
void place_rays(const HemisphereStrata& strata, const Basis& basis, const SurfacePlace& point,
                const CellNumbers& numbers, GatherScratch& scratch);

/// @param scratch  of a gather; loses its `further`
KeptRays keep_rays(GatherScratch& scratch);
/// Sets what add_up_rays reads.
void restore_rays(const KeptRays& kept, GatherScratch& scratch);

}  // namespace aleph
