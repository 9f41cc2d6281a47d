#pragma once
// Samples that wait for indirect light, because the cache had no record where they are.

#include <vector>

#include "render/cache/cache_fill.h"
#include "render/shade/sample_shading.h"

namespace aleph {

struct PendingSample {
    PixelSurface surface;
    SampleLight light;  ///< without indirect light
};

/// Adds records until the cache covers the samples, in the order of the list.
/// @param tally  of the frame; increased
void fill_pending(IrradianceCache& cache, const IndirectContext& context, const std::vector<PendingSample>& pending,
                  FrameTally& tally);

}  // namespace aleph
