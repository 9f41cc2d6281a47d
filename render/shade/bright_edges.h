#pragma once
// Outlines of what is brighter than its surroundings by itself: lamps, windows, the sky. A pixel there may see a lamp
// through a thousandth of its filter, and still be twice as bright for it. Few of its samples meet the lamp, and those
// that do not are no sign that none would. What is seen directly needs no shading, so many more rays tell it.

#include "render/shade/sample_shading.h"

namespace aleph {

/// Pixels that may see such an outline: 1, else 0.
/// @param centers   hits of the pixels' centres
/// @param exposure  brighter than about half of white counts
Image<std::uint8_t> find_bright_edges(const ShadingScene& shading, const CameraView& view, const SampleHits& centers,
                                      double exposure);

/// What a ray's hit shows by itself: emission, or the environment where it met nothing.
Rgb light_seen(const SampleScene& scene, const SamplePlace& place, const Hit& hit, const glm::vec3& direction,
               const glm::ivec2& pixel);

/// The mean of light_seen over more rays of the pixel's filter. They are those of no sample.
/// @param place  of the sample in whose place this is taken
Rgb average_light_seen(const SampleScene& scene, ShadingTask& task, const SamplePlace& place, const glm::ivec2& pixel);

}  // namespace aleph
