#pragma once
// Fills an irradiance cache for a frame, with the same records for any number of threads.
//
// The frame is divided into tiles, each with one pixel sample at its corner. Tiles start at 64 pixels and halve down to
// single pixels, so that the first records, which are far apart, are placed evenly. A tile needs a record if no record
// covers its sample. Tiles of one size are filled in rounds; in each round
//   1. all threads look for tiles that need a record. The cache does not change meanwhile;
//   2. one thread goes through these tiles in order and accepts a tile unless the expected reach of a tile accepted
//      before covers it. Tiles that are not accepted wait for the next round;
//   3. all threads gather irradiance for the accepted tiles. Random numbers depend on seed, frame and place on the
//      surface only (gather_at.cpp);
//   4. one thread inserts the records in the order of their tiles.
// No step depends on the order in which threads work.

#include <functional>

#include "render/cache/indirect_context.h"

namespace aleph {

/// The surface of a pixel's sample.
struct FillPoint {
    glm::vec3 position{0.0f};  ///< m, relative to the anchor of IndirectContext::lighting
    float footprint = -1.0f;   ///< m, of the pixel; negative: no record is needed, or light is known (CarriedLight)
    glm::vec3 normal{0.0f};    ///< unit
    float reflected = 0.0f;    ///< luminance of radiance over irradiance
};

/// The point of a surface that needs light.
FillPoint make_fill_point(const PixelSurface& surface);

/// The surface that a pixel shows, in the pose whose light is wanted; nothing if it is not there.
std::optional<PixelSurface> find_surface(const IndirectContext& context, const SampleHits& sample, int x, int y);

/// The same if its light has to be computed.
std::optional<PixelSurface> find_needed(const IndirectContext& context, const SampleHits& sample, int x, int y,
                                        RayTask& task);

/// Those of every `step`th pixel of every `step`th row; elsewhere no light is needed.
Image<FillPoint> find_points(const IndirectContext& context, const SampleHits& sample, int step, RayCounts& counts);

/// Surfaces that may need light, in rows and columns. `accuracy` of the context and the images of the tally have the
/// same size.
struct FillPlaces {
    Image<FillPoint> points;
    /// The surface of a point that needs light. Called from any thread.
    std::function<PixelSurface(int x, int y)> surface_at;
    /// Tiles start large; otherwise every point is looked at once.
    bool coarse_first = true;
    int finest = 1;  ///< the last tiles' size, a power of 2
    /// Fewest and most rays of a gather, which takes those that bring its standard error to `noise`, relative. 0: as
    /// many as the accuracy needs (choose_rays).
    int rays = 0, most_rays = 0;
    double noise = 0.0;
    /// If given, what the gather of every record found is added, in the order of the records.
    std::vector<KeptRays>* gathered = nullptr;
};

/// Adds records until every place is covered. A gather that is not finite makes no record: it is counted as invalid,
/// and shading finds that sample's irradiance by rays of its own if no other record covers it.
void fill_places(IrradianceCache& cache, const IndirectContext& context, FillPlaces places, FrameTally& tally);

/// Bounds for a pixel: R_i is at least min_radius_pixels, and at the pixel's own accuracy S_i reaches a pixel.
/// @param footprint  m, of the pixel
RadiusBounds radius_bounds(const IndirectContext& context, float footprint, float accuracy);

/// fill_places for the surfaces that this sample of the pixels shows.
/// @param sample  if it is the pixels' first, tiles start large; later samples are looked at pixel by pixel
void fill_cache(IrradianceCache& cache, const IndirectContext& context, const SampleHits& sample, FrameTally& tally,
                int finest = 1);

/// An empty cache whose index spans the whole scene.
IrradianceCache make_cache(const ShadingScene& shading);

/// Half the diagonal of the visible scene's bounds, m; that of a 2 m cube if nothing is visible.
float scene_radius(const ShadingScene& shading);

}  // namespace aleph
