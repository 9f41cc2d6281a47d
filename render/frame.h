#pragma once
// Shading a frame: emission, direct light, and indirect light read from a filled cache, for every pixel sample.

#include "render/cache_fill.h"
#include "render/shaded_frame.h"

namespace aleph {

/// Fills a cache for the frame and shades it. With accuracy 0, irradiance is gathered at every sample instead.
/// @param centers  hits through the pixel centres, which are the samples if spp is 1
ShadedFrame shade_frame(const IndirectContext& context, const SampleHits& centers, double exposure);

}  // namespace aleph
