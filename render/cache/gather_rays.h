#pragma once
// The rays of a gather: one in each cell of the strata, or several.

#include <span>

#include "engine/base/sampling.h"
#include "render/cache/gather.h"

namespace aleph {

/// Sets how many rays each cell takes (GatherScratch::sides). Returns their number.
int divide_cells(const HemisphereStrata& strata, std::span<const DividedCell> divided, GatherScratch& scratch);

/// Sets the rays of all cells, as far as they are above the true surface, their places, and which cells are below it.
/// @param basis  of the hemisphere
/// @param most   rays of all cells (divide_cells)
void place_rays(const HemisphereStrata& strata, const Basis& basis, const SurfacePlace& point,
                const CellNumbers& numbers, int most, GatherScratch& scratch);

/// @param scratch  of a gather; loses its `further`
KeptRays keep_rays(GatherScratch& scratch);
/// Sets what add_up_rays reads.
void restore_rays(const KeptRays& kept, GatherScratch& scratch);

}  // namespace aleph
