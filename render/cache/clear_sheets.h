#pragma once
// Rays of a gather through panes. What lies behind is met as if there were no pane: rays are aimed at it, and its light
// is read from the direct grid.

#include "render/cache/gather.h"

namespace aleph {

/// Takes rays that meet thin clear glass straight through it, as the glass lobe's sample has it. Distances are those
/// from the rays' origins.
/// @param scratch  with hits; sets `passed` and `reflected`
void pass_clear_sheets(const LightingContext& context, RayTask& task, RandomStream& random, GatherScratch& scratch);

/// The sample of a sheet that turns this ray; null: it met no clear sheet.
const ScatterSample* find_reflected(const GatherScratch& scratch, std::size_t ray);

}  // namespace aleph
