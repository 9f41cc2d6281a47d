#pragma once
// Surfaces where light of further bounces is needed: those that gather rays hit, in the picture or not.

#include <vector>

#include "render/cache/cache_fill.h"

namespace aleph {

/// Adds surfaces, spread evenly over the picture, that this sample of its pixels shows and whose light is not known.
/// @param counts  increased by the rays cast
void add_seen_surfaces(const IndirectContext& context, const SampleHits& sample, std::vector<PixelSurface>& surfaces,
                       RayCounts& counts);

/// Hits of rays over the hemispheres of surfaces: one row for each surface.
struct BouncePlaces {
    Image<Hit> hits;
    Image<glm::vec3> directions;  ///< unit
    float solid_angle = 0.0f;     ///< sr, of a ray of the gathers that will hit them
};

/// Random numbers depend on the seed and on the places of the surfaces only.
/// @param counts  increased by the rays cast
BouncePlaces cast_bounce_places(const LightingContext& lighting, const std::vector<PixelSurface>& surfaces,
                                std::uint32_t seed, RayCounts& counts);

/// The surface that was hit, as a place of a cache.
PixelSurface make_bounce_surface(const ShadingScene& shading, const BouncePlaces& places, int x, int y);

/// The places to fill a cache at. They refer to `shading` and `places`.
FillPlaces make_fill_places(const ShadingScene& shading, const BouncePlaces& places);

}  // namespace aleph
