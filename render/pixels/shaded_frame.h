#pragma once
// A rendered picture with its counts.

#include <array>
#include <cstdint>
#include <functional>

#include "engine/base/color.h"
#include "engine/base/image.h"
#include "render/settings/ray_counts.h"

namespace aleph {

/// Cause of a pixel's error.
enum class ErrorCause : std::uint8_t {
    edges,     ///< samples that saw several surfaces, textures
    blur,      ///< the same, while the shutter or the lens is open
    direct,    ///< direct light: shadows, lights of some size
    gloss,     ///< reflections and refractions
    indirect,  ///< interpolation between cache records
};
inline constexpr std::size_t cause_count = 5;

/// Standard errors of the pixels' luminance, as multiples of the visible threshold.
struct ErrorMaps {
    Image<float> total;
    std::array<Image<float>, cause_count> by_cause;
    int reach = 1;  ///< pixels on either side whose errors are seen together (find_seen_reach)
};

/// Estimated shares of pixels whose error is larger than what was asked for.
struct ErrorShares {
    double asked = 1.0;  ///< thresholds
    double beyond = 0.0;
    std::array<double, cause_count> by_cause{};  ///< if this were the only one
};

/// Work of the irradiance cache.
struct FillStatistics {
    std::uint64_t rounds = 0;   ///< of filling (cache_fill.h)
    std::uint64_t lookups = 0;  ///< by filling and by shading
    std::uint64_t hits = 0;     ///< look-ups that found a record
};

/// Sums over a frame.
struct FrameCounts {
    RayCounts rays;
    FillStatistics cache;
    std::uint64_t samples = 0;               ///< pixel samples
    std::uint64_t records = 0;               ///< irradiance values computed
    std::uint64_t multi_bounce_records = 0;  ///< not among them: those of the coarse cache of further bounces
    std::uint64_t multi_bounce_rays = 0;     ///< of all rays, those that filled this cache
    std::uint64_t invalid_samples = 0;       ///< pixel samples and irradiance values dropped for a NaN or infinity
};

/// Work and time of computing the light of a lighting keyframe.
struct KeyframeStatistics {
    std::int64_t frame = 0;
    FrameCounts counts;  ///< the quick estimates of its views included
    double seconds = 0.0;
};

/// Counts of filling and shading a frame: per pixel and in all.
struct FrameTally {
    Image<float> records;          ///< irradiance values computed for this pixel
    Image<float> invalid_samples;  ///< pixel samples and irradiance values dropped for a NaN or infinity
    FrameCounts counts;
};

struct ShadedFrame : FrameTally {
    Image<Rgb> color;  ///< mean of the valid samples, linear, exposure applied; 0 if no sample is valid
    /// The part of `color` that surfaces reflect of their indirect irradiance, read from the cache or gathered. Empty
    /// if light is found by paths.
    Image<Rgb> indirect;
    Image<float> coverage;  ///< share of the valid samples that hit a surface
    Image<float> samples;   ///< pixel samples taken
    /// Variance of the pixel's mean luminance, exposure applied, from its samples. With Integrator::path and 2 samples
    /// or more; otherwise empty, since samples that share a cache do not tell its error.
    Image<float> variance;
    /// Records that the pixel's irradiance was interpolated from: their mean number per sample, and the weighted mean
    /// of how far they may be used, m. Empty unless SampleOptions::record_maps.
    Image<float> cache_count, cache_radius;
    /// Estimated errors. Empty where the visible threshold is not known, or a pixel has a single sample.
    ErrorMaps errors;
    ErrorShares error_shares;
    double fill_seconds = 0.0, shade_seconds = 0.0;
};

/// Reports the progress of a frame: 0 to 1, and the stage's name. Called from the thread that renders the frame.
using FrameProgress = std::function<void(double fraction, const char* stage)>;

}  // namespace aleph
