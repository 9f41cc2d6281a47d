#pragma once
// Fills an irradiance cache for a frame, in an order that does not depend on threads (DESIGN "Repeatable").
// Tiles start large and shrink. In a round the cache is frozen: every tile whose sample nothing covers proposes it; a
// proposal inside the expected reach of one accepted before it waits for the next round; gathers run in parallel;
// records are inserted in tile order. So the result is close to a sequential coarse-to-fine fill (PERFORMANCE.md).

#include <functional>

#include "render/irradiance_cache.h"
#include "render/pixel_surfaces.h"
#include "render/settings.h"

namespace aleph {

struct FillStatistics {
    std::uint64_t rounds = 0;
    std::uint64_t lookups = 0, hits = 0;
};

/// Told how far a frame is, 0 to 1, and in which stage; may be called from any thread.
using FrameProgress = std::function<void(double fraction, const char* stage)>;

/// What a frame's indirect light is computed from.
struct IndirectContext {
    const LightingContext& lighting;
    const CameraView& view;
    const RenderSettings& settings;
    const Image<float>& accuracy;  ///< alpha per pixel
    std::uint32_t frame = 0;       ///< random numbers depend on it
    float largest_radius = 1.0f;   ///< m, from the scene's size
    FrameProgress progress;        ///< may be empty
};

/// The irradiance at one pixel sample, gathered anew.
IrradianceSample gather_at(const IndirectContext& context, Tracer& tracer, const PixelSurface& surface, int x, int y,
                           int sample, GatherScratch& scratch, RayCounts& counts);

/// Whether a pixel sample's shading reads indirect irradiance at all.
bool needs_irradiance(const SampleHits& sample, const PixelSurface& surface, int x, int y);

/// Bounds of R_i for a pixel: at its own accuracy a record reaches at least min_radius_pixels.
RadiusBounds radius_bounds(const IndirectContext& context, const PixelSurface& surface, float accuracy);

/// Adds records until every sample of the pass is covered.
/// @param sample_index  which of the pixel's samples; the first starts with large tiles, later ones visit every pixel
/// @param records  counts per pixel, increased where an irradiance value was computed
void fill_cache(IrradianceCache& cache, const IndirectContext& context, const SampleHits& sample, int sample_index,
                Image<float>& records, RayCounts& counts, FillStatistics& statistics);

/// An empty cache whose index holds the whole scene.
IrradianceCache make_cache(const ShadingScene& shading);

/// Half the diagonal of the visible scene's bounds, m; 1 if it is empty.
float scene_radius(const ShadingScene& shading);

}  // namespace aleph
