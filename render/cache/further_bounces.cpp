#include "render/cache/further_bounces.h"

#include <algorithm>
#include <cstdlib>

#include "render/cache/bounce_places.h"
#include "render/cache/light_transport.h"

namespace aleph {

namespace {

double env(const char* name, double otherwise) {
    const char* text = std::getenv(name);
    return text ? std::atof(text) : otherwise;
}

/// alpha of the records.
float coarse_accuracy(const RenderSettings& settings) {
    return static_cast<float>(std::clamp(env("LOOSER", 4.0) * settings.cache.accuracy, settings.cache.accuracy, env("MOST", 1.0)));
}

}  // namespace

int count_bounces(const RenderSettings& settings) {
    return std::min(settings.light.bounces, settings.light.path_depth - 1);
}

MultiBounceLight make_multi_bounce_light(const RenderSettings& settings, const IrradianceCache* cache) {
    const double reach = std::min(1.0, shade_reach * coarse_accuracy(settings));
    return {std::max(0, count_bounces(settings) - 1), cache, static_cast<float>(reach)};
}

std::optional<IrradianceCache> solve_further_bounces(const IndirectContext& context,
                                                     const std::vector<PixelSurface>& seen, FrameCounts& counts) {
    MultiBounceLight further = make_multi_bounce_light(context.settings, nullptr);
    const int bounces = further.bounces;
    if (bounces == 0 || seen.empty()) return std::nullopt;
    RayCounts rays;
    const BouncePlaces places = cast_bounce_places(context.lighting, seen, context.settings.seed, rays);
    const int width = places.hits.width, height = places.hits.height;
    const Image<float> accuracy(width, height, coarse_accuracy(context.settings));
    DirectGrid direct(context.max_radius);
    IndirectContext coarse = make_places_context(context, accuracy);
    coarse.direct = &direct;
    further.bounces = bounces - 1;
    further.noted = true;
    coarse.multi_bounce = further;
    coarse.bounces_before = 1;
    FrameTally tally;
    tally.records = tally.invalid_samples = Image<float>(width, height);
    std::vector<GatheredRays> gathered;
    FillPlaces fill = make_fill_places(context.lighting.shading, places);
    fill.gathered = &gathered;
    if (env("ONCE", 1)) fill.coarse_first = false;
    IrradianceCache cache = make_cache(context.lighting.shading);
    fill_places(cache, coarse, fill, tally);
    if (bounces > 1) cache.restore(add_bounces(coarse, cache, std::move(gathered), bounces, tally.counts.rays));
    cache.finish();
    rays += tally.counts.rays;
    counts.rays += rays;
    counts.multi_bounce_rays += rays.total();
    counts.multi_bounce_records += tally.counts.records;
    return cache;
}

}  // namespace aleph
