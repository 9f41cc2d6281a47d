#pragma once
// Surfaces that pixels show by mirrors and by smooth glass. They need irradiance as those in plain sight do: paths that
// arrive there look it up (KnownIrradiance).

#include "render/cache/bounce_places.h"

namespace aleph {

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
/// @param counts  increased by the rays cast
MirrorPlaces cast_mirror_places(const IndirectContext& context, const SampleHits& sample, RayCounts& counts);

/// Adds records to the cache until these places are covered.
/// @param tally  increased; its images have the frame's size
void fill_mirror_places(IrradianceCache& cache, const IndirectContext& context, const SampleHits& sample,
                        FrameTally& tally);

}  // namespace aleph
