#pragma once
// Irradiance caches of fewer bounces, for light of several bounces.
//
// Irradiance of n bounces is a gather of direct light and of what hits scatter of E_(n-1), their irradiance of n - 1
// bounces. E_(n-1) comes from a cache that holds it and nothing else: where bounces are mixed, some are counted twice.
// Caches are filled from the fewest bounces to the most, each before the next begins, so that no result depends on
// threads. They need records where gather rays of the next one arrive: at the hits of rays from surfaces of the
// picture, at the hits of rays from these, and so on. Where a look-up finds none, one random path takes its place.
//
// Their errors reach the picture averaged over a hemisphere and times the albedo, so each is filled to twice the
// accuracy of the next one, up to most_level_accuracy.

#include <optional>
#include <vector>

#include "render/cache/indirect_context.h"

namespace aleph {

/// Bounces of the picture's indirect light: the last surface of a path scatters direct light only.
int count_bounces(const RenderSettings& settings);

/// Makes the light that gathers for the picture find at their hits beside direct light.
/// @param cache  from fill_levels; null: random paths only, without bias
MultiBounceLight make_multi_bounce_light(const RenderSettings& settings, const IrradianceCache* cache);

/// A cache of one bounce fewer than the picture's, for the gathers that fill its cache.
/// @param context  of the picture
/// @param seen     surfaces of the picture whose light will be gathered (add_seen_surfaces)
/// @param counts   increased
/// @return nothing if the picture has one bounce, or `seen` is empty
std::optional<IrradianceCache> fill_levels(const IndirectContext& context, const std::vector<PixelSurface>& seen,
                                           FrameCounts& counts);

}  // namespace aleph
