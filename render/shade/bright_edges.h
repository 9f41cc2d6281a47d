#pragma once
// Outlines of lamps, windows and the sky. A lamp of a thousand times the brightness around it doubles that of a pixel
// whose filter it covers by a thousandth. Hardly any sample meets it, and without one the pixel's variance looks small.
// Emission that a camera ray meets needs no shading, so each sample of these pixels takes it from many rays.

#include "render/shade/sample_shading.h"

namespace aleph {

/// Pixels that may see such an outline, or a lamp too small for the pixels' centres to meet: 1, else 0.
/// @param exposure   brighter than about half of white counts
/// @param rays_cast  counts those around the picture
Image<std::uint8_t> find_bright_edges(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                                      double exposure, std::uint64_t& rays_cast);

/// The light that a ray's hit shows by itself: emission, or the environment where it met nothing.
Rgb light_seen(const SampleScene& scene, ShadingTask& task, const SamplePlace& place, const Hit& hit,
               const glm::vec3& direction, const glm::ivec2& pixel);

/// The mean of light_seen over more rays of the pixel's filter. They are those of no sample.
/// @param place  of the sample in whose place this is taken
Rgb average_light_seen(const SampleScene& scene, ShadingTask& task, const SamplePlace& place, const glm::ivec2& pixel);

}  // namespace aleph
