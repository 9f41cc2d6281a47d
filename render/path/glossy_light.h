#pragma once
// Indirect light of lobes so wide, or so faint, that irradiance can stand in for it: albedo times E / pi, which is
// exact where the same light comes from everywhere. No ray is cast from such a lobe. Light that lamps and the
// environment shed straight on the surface is still found by sampling the lights, with full weight.

#include "render/surface/scatter.h"

namespace aleph {

/// The lobes of a surface that rays are cast from, and what stands in for the others.
struct SampledLobes {
    LobeShares shares{};  ///< sum to 1, or are all 0
    Rgb radiance{0.0f};   ///< indirect light of lobes that are not sampled
    float error = 0.0f;   ///< of its luminance, root mean square, by how much light varies with direction in rooms
};

/// Leaves out the lobes with the smallest errors, as many as the tolerance allows. The Lambert layer is never sampled.
/// Lobes of a roughness below .3, and glass, which also shows what lies behind it, always are.
/// @param irradiance  indirect, of the Lambert layer
/// @param tolerance   for `error`, in units of radiance; 0: every lobe is sampled
SampledLobes choose_sampled_lobes(const LitSurface& lit, const Rgb& irradiance, float tolerance);

}  // namespace aleph
