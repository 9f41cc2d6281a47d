#include "render/cache/bounce_levels.h"

#include <algorithm>

#include "render/cache/bounce_places.h"

namespace aleph {

namespace {

/// Levels below the picture's that have caches. The lowest gathers by random paths whatever bounces are left: hardly
/// any light.
constexpr int most_levels = 8;

constexpr double looser_by_level = 2.0, most_level_accuracy = 0.5;

/// alpha of a level, `fewer` below the picture's.
float level_accuracy(const RenderSettings& settings, int fewer) {
    double accuracy = settings.cache.accuracy;
    for (int i = 0; i < fewer && accuracy < most_level_accuracy; ++i) {
        accuracy = std::min(accuracy * looser_by_level, most_level_accuracy);
    }
    return static_cast<float>(accuracy);
}

MultiBounceLight make_level_light(const RenderSettings& settings, int fewer, const IrradianceCache* cache) {
    const double reach = shade_reach * level_accuracy(settings, fewer + 1);
    return {std::max(0, count_bounces(settings) - 1 - fewer), cache, static_cast<float>(reach)};
}

/// A cache of the light that surfaces have after `fewer` bounces fewer than the picture's.
IrradianceCache fill_level(const IndirectContext& context, const BouncePlaces& places, int fewer,
                           const IrradianceCache* below, FrameCounts& counts) {
    const int width = places.hits.width, height = places.hits.height;
    const Image<float> accuracy(width, height, level_accuracy(context.settings, fewer));
    DirectGrid direct(context.max_radius);
    IndirectContext level = make_places_context(context, accuracy);
    level.direct = &direct;
    level.multi_bounce = make_level_light(context.settings, fewer, below);
    level.bounces_before = fewer;
    FrameTally tally;
    tally.records = tally.invalid_samples = Image<float>(width, height);
    IrradianceCache cache = make_cache(context.lighting.shading);
    fill_places(cache, level, make_fill_places(context.lighting.shading, places), tally);
    cache.finish();
    counts.rays += tally.counts.rays;
    counts.multi_bounce_rays += tally.counts.rays.total();
    counts.multi_bounce_records += tally.counts.records;
    return cache;
}

}  // namespace

int count_bounces(const RenderSettings& settings) {
    return std::min(settings.light.bounces, settings.light.path_depth - 1);
}

MultiBounceLight make_multi_bounce_light(const RenderSettings& settings, const IrradianceCache* cache) {
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
    for (int fewer = 1; fewer <= levels; ++fewer) {
        places.push_back(cast_bounce_places(context.lighting, surfaces, context.settings.seed, rays));
        surfaces = choose_next_surfaces(context.lighting.shading, places.back());
    }
    counts.rays += rays;
    counts.multi_bounce_rays += rays.total();
    for (int fewer = levels; fewer >= 1; --fewer) {
        cache = fill_level(context, places[fewer - 1], fewer, cache ? &*cache : nullptr, counts);
    }
    return cache;
}

}  // namespace aleph
