#pragma once
// Places beside the pixels' own at which irradiance is needed: what gather rays hit needs light of further bounces, and
// what mirrors and smooth glass show needs light as what is in plain sight (KnownIrradiance).

#include <vector>

#include "render/cache/cache_fill.h"

namespace aleph {

/// Adds surfaces, spread evenly over the picture, that this sample of its pixels shows and whose light is not known.
void add_seen_surfaces(const IndirectContext& context, const SampleHits& sample, std::vector<PixelSurface>& surfaces,
                       RayCounts& counts);

/// Hits of rays over the hemispheres of surfaces: one row for each surface.
struct BouncePlaces {
    Image<Hit> hits;
    Image<glm::vec3> directions;  ///< unit
    float solid_angle = 0.0f;     ///< sr, of a ray of the gathers that will hit them
};

/// Random numbers depend on the seed and on the places of the surfaces only.
BouncePlaces cast_bounce_places(const LightingContext& lighting, const std::vector<PixelSurface>& surfaces,
                                std::uint32_t seed, RayCounts& counts);

/// The surface that was hit, as a place of a cache.
PixelSurface make_bounce_surface(const ShadingScene& shading, const BouncePlaces& places, int x, int y);

/// The places to fill a cache at. They refer to `shading` and `places`.
FillPlaces make_fill_places(const ShadingScene& shading, const BouncePlaces& places);

/// Places of the scene that mirrors, smooth glass and lobes about as narrow show.
struct MirrorPlaces {
    /// As many as pixels; distances count from the camera along the whole path. Nothing where a pixel shows no surface
    /// with a Lambert layer that way, or its light is known (CarriedLight).
    BouncePlaces places;
    Image<float> accuracy;  ///< alpha, by the pixel's and by the share of light that the mirrors reflect
    bool any = false;
};

/// One for each pixel of a sample: its path takes the brightest turn at every surface, up to the first one with a
/// Lambert layer. Footprints are those of flat mirrors.
/// @param sample  cast in the pose whose light is wanted
MirrorPlaces cast_mirror_places(const IndirectContext& context, const SampleHits& sample, RayCounts& counts);

/// Adds records to the cache until these places are covered.
void fill_mirror_places(IrradianceCache& cache, const IndirectContext& context, const SampleHits& sample,
                        FrameTally& tally);

}  // namespace aleph
