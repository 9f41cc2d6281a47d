#pragma once
// Light that reaches a surface point straight from the lights.

#include "render/path/path.h"
#include "render/pixels/lattice.h"
#include "render/pixels/pixel_sequence.h"

namespace aleph {

/// The points on each light: part `part` of `parts`. With the same shift, all parts together are one lattice of
/// count * parts points, and each part is even by itself.
struct LightPoints {
    int count = 1;  ///< per part
    int part = 0;
    int parts = 1;

    glm::vec2 at(int i, const glm::vec2& shift) const { return lattice_point(i * parts + part, count * parts, shift); }
};

/// Light that a surface scatters, without its own emission.
struct SampledLight {
    Rgb direct{0.0f};  ///< found by sampling the lights
    Rgb lobes{0.0f};   ///< found by sampling the lobes
};

/// Samples of direct light, shared out among all lights.
struct DirectSamples {
    int first = 0;  ///< of the pixel's sequence
    int count = 1;
    /// Luminance of radiance: lights that together cannot bring so much, even without shadows, are left out.
    float tolerance = 0.0f;
    float* left_out = nullptr;  ///< set, if not null, to a bound of the luminance of what was left out
};

/// Radiance that a surface scatters from the lights, without its own emission: the mean of these samples, each of one
/// light that is chosen by about what it brings. Unbiased for all lights that are not left out. The light and the point
/// on it take one point of SampleUse::light_point.
/// Samples of the lobes are left to the caller. Each light is weighted against them by its own density alone (power
/// heuristic, Veach 1997), as if it were the only one: so a ray that meets the light needs no other weight than that
/// of PathState, whatever the choice of lights and the number of samples.
/// @param shares  of the lobes from which directions are sampled as well; those of share 0 have full weight
Rgb sample_direct_light(const LightingContext& context, RayTask& task, const LitSurface& lit, const LobeShares& shares,
                        const PixelSequence& sequence, const DirectSamples& samples);

/// Paths that go on from samples of the lobes.
struct LobePaths {
    PathState beyond;
    RandomStream& random;
    const LobeShares* shares = nullptr;  ///< of sampled lobes (choose_sampled_lobes); null: all but the Lambert layer
};

/// Radiance that a surface scatters from the lights, without its own emission. The Lambert layer samples lights only;
/// the other lobes combine light and lobe sampling by the power heuristic (Veach 1997). Unbiased.
/// Within the limits of `paths.beyond`, the rays that are sampled from the lobes go on as paths: they find reflections,
/// and what glass shows. With a depth of 0 the result is direct light alone. More than 16 lights share the samples that
/// 16 would have.
/// @param points  per light that has an area, and as many samples of the lobes
/// @param random  moved on by a fixed number of dimensions per call
SampledLight compute_sampled_light(const LightingContext& context, RayTask& task, const ViewedSurface& surface,
                                   const LightPoints& points, RandomStream& random, const LobePaths& paths);

/// Direct light from a fixed pattern of points on each light. The pattern is the same for every pixel, so the result
/// has no noise that the model of vision would take for detail. Biased: penumbrae come in steps, and narrow highlights
/// are widened.
/// @param samples  per light that has an area
Rgb estimate_direct_light(const LightingContext& context, RayTask& task, const ViewedSurface& surface, int samples);

}  // namespace aleph
