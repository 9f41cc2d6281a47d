#pragma once
// Shading a frame: every pixel sample's emission, direct light, and indirect light read from a frozen cache.

#include "render/cache_fill.h"

namespace aleph {

struct ShadedFrame {
    Image<Rgb> color;       ///< linear, exposure applied
    Image<float> coverage;  ///< share of samples that hit something
    Image<float> samples;   ///< pixel samples taken
    Image<float> records;   ///< irradiance values computed in this pixel (filling included)
    Image<float> invalid;   ///< samples thrown away for a NaN or infinity
    RayCounts rays;
    FillStatistics cache;
    std::uint64_t record_count = 0;
    std::uint64_t invalid_count = 0;
    double fill_seconds = 0.0, shade_seconds = 0.0;
};

/// Fills a cache for the frame and shades it. Accuracy 0 gathers at every sample instead.
/// @param centers  hits through the pixel centres; used as the only sample when spp is 1
ShadedFrame shade_frame(const IndirectContext& context, const SampleHits& centers, double exposure);

}  // namespace aleph
