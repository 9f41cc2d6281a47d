#pragma once
// Light that reaches a surface point straight from the lights.

#include "render/path/path.h"
#include "render/pixels/pixel_sequence.h"

namespace aleph {

/// Samples of direct light, shared out among all lights.
struct DirectSamples {
    int first = 0;  ///< of the pixel's sequence
    int count = 1;
};

/// Radiance that a surface scatters from the lights, without its own emission: the mean of these samples, each of one
/// light that is chosen by about what it brings. Unbiased. The light and the point on it take one point of
/// SampleUse::light_point. Samples of the lobes are left to the caller. Each light is weighted against them by its own
/// density alone (power heuristic, Veach 1997), as if it were the only one: so a ray that meets the light needs no
/// other weight than that of PathState, whatever the choice of lights and the number of samples.
/// @param shares  of the lobes from which directions are sampled as well; those of share 0 have full weight
Rgb sample_direct_light(const LightingContext& context, RayTask& task, const LitSurface& lit, const LobeShares& shares,
                        const PixelSequence& sequence, const DirectSamples& samples);

/// Direct light from a fixed pattern of points on each light. The pattern is the same for every pixel, so the result
/// has no noise that the model of vision would take for detail. Biased: penumbrae come in steps, and narrow highlights
/// are widened. More than 16 lights share the samples that 16 would have.
/// @param samples  per light that has an area
Rgb estimate_direct_light(const LightingContext& context, RayTask& task, const ViewedSurface& surface, int samples);

}  // namespace aleph
