#include "render/cache/bounce_levels.h"

#include <algorithm>

#include "render/cache/bounce_places.h"

namespace aleph {

namespace {

/// Levels below the picture's that have caches. The lowest gathers by random paths whatever bounces are left: hardly
/// any light.
constexpr int most_levels = 8;

constexpr double looser_by_level = 2.0, most_level_accuracy = 0.5;

/// alpha of a level, `turns` below the picture's.
float level_accuracy(const RenderSettings& settings, int turns) {
    double accuracy = settings.cache.accuracy;
    for (int i = 0; i < turns && accuracy < most_level_accuracy; ++i) {
        accuracy = std::min(accuracy * looser_by_level, most_level_accuracy);
    }
    return static_cast<float>(accuracy);
}

DeeperLight make_level_light(const RenderSettings& settings, int turns, const IrradianceCache* cache) {
    const double reach = shade_reach * level_accuracy(settings, turns + 1);
    return {std::max(0, count_bounces(settings) - 1 - turns), cache, static_cast<float>(reach)};
}

/// A cache of the light that surfaces have after `turns` turns fewer than the picture's.
IrradianceCache fill_level(const IndirectContext& context, const BouncePlaces& places, int turns,
                           const IrradianceCache* below, FrameCounts& counts) {
    const int width = places.hits.width, height = places.hits.height;
    const Image<float> accuracy(width, height, level_accuracy(context.settings, turns));
    DirectGrid direct(context.max_radius);
    IndirectContext level = make_places_context(context, accuracy);
    level.direct = &direct;
    level.deeper = make_level_light(context.settings, turns, below);
    level.turns_before = turns;
    FrameTally tally;
    tally.records = tally.invalid_samples = Image<float>(width, height);
    IrradianceCache cache = make_cache(context.lighting.shading);
    fill_places(cache, level, make_fill_places(context.lighting.shading, places), tally);
    cache.finish();
    counts.rays += tally.counts.rays;
    counts.deeper_rays += tally.counts.rays.total();
    counts.deeper_records += tally.counts.records;
    return cache;
}

}  // namespace

int count_bounces(const RenderSettings& settings) {
    return std::min(settings.light.bounces, settings.light.path_depth - 1);
}

DeeperLight make_deeper_light(const RenderSettings& settings, const IrradianceCache* cache) {
    return make_level_light(settings, 0, cache);
}

std::optional<IrradianceCache> fill_levels(const IndirectContext& context, const std::vector<PixelSurface>& seen,
                                           FrameCounts& counts) {
    std::optional<IrradianceCache> cache;
    if (seen.empty()) return cache;
    const int levels = std::min(count_bounces(context.settings) - 1, most_levels);
    RayCounts rays;
    std::vector<BouncePlaces> places;
    std::vector<PixelSurface> surfaces = seen;
    for (int turns = 1; turns <= levels; ++turns) {
        places.push_back(cast_bounce_places(context.lighting, surfaces, context.settings.seed, rays));
        surfaces = choose_next_surfaces(context.lighting.shading, places.back());
    }
    counts.rays += rays;
    counts.deeper_rays += rays.total();
    for (int turns = levels; turns >= 1; --turns) {
        cache = fill_level(context, places[turns - 1], turns, cache ? &*cache : nullptr, counts);
    }
    return cache;
}

}  // namespace aleph
