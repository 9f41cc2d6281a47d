#pragma once
// Shading a frame: emission, direct light, and indirect light read from a filled cache, for every pixel sample.

#include "render/cache_fill.h"

namespace aleph {

/// A rendered picture with its counts.
struct ShadedFrame : FrameTally {
    Image<Rgb> color;       ///< mean of the valid samples, linear, exposure applied; 0 if no sample is valid
    Image<float> coverage;  ///< share of the valid samples that hit a surface
    Image<float> samples;   ///< pixel samples taken
    double fill_seconds = 0.0, shade_seconds = 0.0;
};

/// Fills a cache for the frame and shades it. With accuracy 0, irradiance is gathered at every sample instead.
/// @param centers  hits through the pixel centres, which are the samples if spp is 1
ShadedFrame shade_frame(const IndirectContext& context, const SampleHits& centers, double exposure);

}  // namespace aleph
