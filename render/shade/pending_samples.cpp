#include "render/shade/pending_samples.h"

#include "render/surface/carried_point.h"

namespace aleph {

namespace {

/// Where its light is wanted (IndirectContext::seen).
PixelSurface place_surface(const IndirectContext& context, const PendingSample& sample) {
    PixelSurface surface = sample.surface;
    if (context.seen != nullptr) {
        // A sample waits only if it can be carried.
        surface.point = *carry_point(context.lighting.shading, surface.hit, surface.point);
    }
    return surface;
}

}  // namespace

void fill_pending(IrradianceCache& cache, const IndirectContext& context, const std::vector<PendingSample>& pending,
                  FrameTally& tally) {
    if (pending.empty()) return;
    const int count = static_cast<int>(pending.size());
    Image<float> accuracy(count, 1);
    FillPlaces places;
    places.points = Image<FillPoint>(count, 1);
    places.coarse_first = false;
    places.surface_at = [&](int x, int) { return place_surface(context, pending[x]); };
    for (int i = 0; i < count; ++i) {
        const PixelSurface surface = place_surface(context, pending[i]);
        accuracy(i, 0) = context.accuracy(surface.x, surface.y);
        places.points(i, 0) = {surface.point.position, surface.footprint, surface.point.normal};
    }
    FrameTally filled;
    filled.records = filled.invalid_samples = Image<float>(count, 1);
    const std::size_t known = cache.records().size();
    fill_places(cache, make_places_context(context, accuracy), places, filled);
    cache.finish(known);
    for (int i = 0; i < count; ++i) {
        const PixelSurface& surface = pending[i].surface;
        tally.records(surface.x, surface.y) += filled.records(i, 0);
        tally.invalid_samples(surface.x, surface.y) += filled.invalid_samples(i, 0);
    }
    tally.counts.rays += filled.counts.rays;
    tally.counts.records += filled.counts.records;
    tally.counts.invalid_samples += filled.counts.invalid_samples;
    tally.counts.cache.rounds += filled.counts.cache.rounds;
    tally.counts.cache.lookups += filled.counts.cache.lookups;
    tally.counts.cache.hits += filled.counts.cache.hits;
}

}  // namespace aleph
