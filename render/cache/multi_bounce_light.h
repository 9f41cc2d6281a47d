#pragma once
// Light of several bounces, as a gather sees it: what a surface that a gather ray hit scatters of its own indirect
// irradiance. It comes from a cache of exactly the bounces that are left, or from one random path.

#include <optional>

#include "render/light/light_choice.h"

namespace aleph {

class IrradianceCache;

/// The light that hits of gather rays scatter in addition to direct light.
struct MultiBounceLight {
    int bounces = 0;  ///< of its irradiance; 0: there is none
    /// Cache of exactly so many bounces; null: every irradiance comes from a random path.
    const IrradianceCache* cache = nullptr;
    float accuracy = 0.0f;  ///< alpha of look-ups
    /// It is not looked up: gathers note where it comes from (FurtherLight).
    bool noted = false;
};

/// Where records do not reach, they are used so many times as far: their error is smaller than that of the one random
/// path in their place, which may meet the brightest spot of the scene.
inline constexpr float gap_reach = 1.4f;

/// Indirect irradiance at a surface point from the cache; nothing where no record reaches, even so.
std::optional<Rgb> find_cached_irradiance(RayTask& task, const SurfacePlace& point,
                                          const MultiBounceLight& multi_bounce);

/// The same without bias from one random path, whose first ray is counted as RayCounts::multi_bounce.
/// @param material  weighs the light by its relative_transmission; null: pure Lambert
/// @param depth     surfaces that may scatter on the path
Rgb sample_multi_bounce_irradiance(const LightingContext& context, RayTask& task, const SurfacePlace& point,
                                   const SurfaceMaterial* material, const MultiBounceLight& multi_bounce, int depth,
                                   RandomStream& random);

}  // namespace aleph
