#pragma once
// Light that reaches a surface point straight from the lights.

#include "render/lattice.h"
#include "render/path.h"

namespace aleph {

/// The points on each light: part `part` of `parts`. With the same shift, all parts together are one lattice of
/// count * parts points, and each part is even by itself.
struct LightPoints {
    int count = 1;  ///< per part
    int part = 0;
    int parts = 1;  ///< 0: not known beforehand; any number of them is even

    glm::vec2 at(int i, const glm::vec2& shift) const {
        return parts > 0 ? lattice_point(i * parts + part, count * parts, shift)
                         : sequence_point(part * count + i, shift);
    }
};

/// Light that a surface scatters, without its own emission.
struct SampledLight {
    Rgb direct{0.0f};  ///< found by sampling the lights
    Rgb lobes{0.0f};   ///< found by sampling the lobes
};

/// Radiance that a surface scatters from the lights, without its own emission. The Lambert layer samples lights only;
/// the other lobes combine light and lobe sampling by the power heuristic (Veach 1997). Unbiased.
/// Within the limits of `beyond`, the rays that are sampled from the lobes go on as paths: they find reflections, and
/// what glass shows. With a depth of 0 the result is direct light alone.
/// @param points       per light that has an area, and as many samples of the lobes
/// @param random       moved on by a fixed number of dimensions per call
/// @param path_random  for those paths
SampledLight compute_sampled_light(const LightingContext& context, RayTask& task, const ViewedSurface& surface,
                                   const LightPoints& points, RandomStream& random, const PathState& beyond,
                                   RandomStream& path_random);

/// Direct light from a fixed pattern of points on each light. The pattern is the same for every pixel, so the result
/// has no noise that the model of vision would take for detail. Biased: penumbrae come in steps, and narrow highlights
/// are widened.
/// @param samples  per light that has an area
Rgb estimate_direct_light(const LightingContext& context, RayTask& task, const ViewedSurface& surface, int samples);

}  // namespace aleph
