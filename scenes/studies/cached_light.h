#pragma once
// The indirect light of a frame at its pixel centres, from the irradiance cache. Light is the luminance of what a
// surface reflects of its indirect irradiance, in cd/m2.

#include "scenes/studies/study_frame.h"

namespace aleph {

/// Indirect light of every pixel, and what it cost.
struct CachedLight {
    Image<float> light;            ///< cd/m2; 0 where nothing reflects diffusely
    Image<float> records;          ///< irradiance values computed at each pixel
    std::size_t record_count = 0;  ///< irradiance values in all
    std::size_t late = 0;          ///< those of them that were gathered for one pixel alone, where no record was found
    std::uint64_t gather_rays = 0, shadow_rays = 0;
    std::uint64_t lookup_rays = 0;  ///< by shading's look-ups, to see whether something stands before a record
    // Of a processor.
    double fill_seconds = 0.0, late_seconds = 0.0;
    double lookup_seconds = 0.0;  ///< of the look-ups alone
    std::size_t lookups = 0;      ///< of shading

    double rays() const { return static_cast<double>(gather_rays + shadow_rays + lookup_rays); }
    double seconds() const { return fill_seconds + late_seconds + lookup_seconds; }
};

/// Fills a cache and reads it at every pixel centre, as a frame with one sample per pixel does.
/// @param alpha  accuracy of every pixel
/// @param smooth  whether records near each other are averaged at the end, as for a frame
CachedLight compute_cached_light(const StudyFrame& frame, const RenderSettings& settings, const Image<float>& alpha,
                                 bool smooth = true);

}  // namespace aleph
