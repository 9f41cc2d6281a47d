#pragma once
// Shading a frame: every pixel sample's emission, direct light, and indirect light read from a frozen cache.

#include "render/cache_fill.h"

namespace aleph {

/// What rendering one frame cost and what it threw away.
struct FrameCounts {
    RayCounts rays;
    FillStatistics cache;
    std::uint64_t samples = 0;          ///< pixel samples
    std::uint64_t records = 0;          ///< irradiance values computed
    std::uint64_t invalid_samples = 0;  ///< sum of ShadedFrame::invalid_samples
};

struct ShadedFrame {
    Image<Rgb> color;              ///< linear, exposure applied
    Image<float> coverage;         ///< share of samples that hit something
    Image<float> samples;          ///< pixel samples taken
    Image<float> records;          ///< irradiance values computed in this pixel (filling included)
    Image<float> invalid_samples;  ///< samples thrown away because their radiance was not finite
    FrameCounts counts;            ///< sums over the frame
    double fill_seconds = 0.0, shade_seconds = 0.0;
};

/// Fills a cache for the frame and shades it. Accuracy 0 gathers at every sample instead.
/// @param centers  hits through the pixel centres; used as the only sample when spp is 1
ShadedFrame shade_frame(const IndirectContext& context, const SampleHits& centers, double exposure);

}  // namespace aleph
