#include "render/cache/further_bounces.h"

#include <algorithm>
#include <numbers>

#include "render/cache/bounce_places.h"

namespace aleph {

namespace {

/// alpha of the records, over the picture's; but for pictures of great accuracy it is the loosest one.
constexpr double looser = 2.5, loosest_record = 0.7;

constexpr double sampled_accuracy = 0.05;  // stands for that of a picture without records

/// Rays of a record, and its standard error where the light comes by few ways, as through a door: there few rays meet
/// most of it, and their error would be that of whole walls.
constexpr int fewest_rays = 64, most_record_rays = 1024;
constexpr double record_noise_aim = 0.15;

/// Pixels for each ray of a record, from the fewest on. From 160x120 up records do not grow in number, while their
/// noise, common to all that see a wall, does not shrink with it as that of samples: so their work grows instead.
constexpr int pixels_per_ray = 300;

int choose_fewest_rays(const PictureSettings& picture) {
    const std::int64_t pixels = std::int64_t{picture.width} * picture.height;
    return static_cast<int>(std::clamp<std::int64_t>(pixels / pixels_per_ray, fewest_rays, most_record_rays));
}

/// The records' alpha. Records that reach far bring light from where there is more of it into corners: an error that
/// lasts from frame to frame, and that is seen where noise of its size is not.
float choose_alpha(const RenderSettings& settings) {
    const double asked = settings.cache.accuracy, picture = asked > 0.0 ? asked : sampled_accuracy;
    return static_cast<float>(std::max(picture, std::min(looser * picture, loosest_record)));
}

}  // namespace

KnownIrradiance make_further_irradiance(const MultiBounceLight& light) {
    return {light.bounces, [light](const ViewedSurface& surface, const Hit&, float, const Rgb&, RayTask& task) {
                return find_cached_irradiance(task, surface.point, light);
            }};
}

std::optional<Rgb> find_cached_irradiance(RayTask& task, const SurfacePlace& point,
                                          const MultiBounceLight& multi_bounce) {
    if (multi_bounce.cache == nullptr) return std::nullopt;
    CacheQuery query{point.position, point.normal, multi_bounce.accuracy, &task};
    std::optional<Rgb> found = multi_bounce.cache->interpolate(query);
    if (found) return found;
    query.accuracy = gap_reach * multi_bounce.accuracy;
    return multi_bounce.cache->interpolate(query);
}

Rgb sample_multi_bounce_irradiance(const LightingContext& context, RayTask& task, const SurfacePlace& point,
                                   const SurfaceMaterial* material, const MultiBounceLight& multi_bounce, int depth,
                                   RandomStream& random) {
    if (multi_bounce.bounces <= 0) return Rgb(0.0f);
    const glm::vec3 local = sample_cosine_hemisphere(random.next_2d());
    const glm::vec3 direction = make_basis(point.normal).to_world(local);
    if (!(glm::dot(direction, point.geometric) > 0.0f)) return Rgb(0.0f);
    ++task.counts.multi_bounce;
    PathState state = start_indirect({multi_bounce.bounces - 1, depth}, context.around);
    // Where a cache knows most of this light, long paths would cost more than all the rest.
    if (multi_bounce.cache != nullptr) state.roulette_after = 0;
    const float enters = material == nullptr ? 1.0f : UpperLayers(*material, point.normal).entering(direction, local.z);
    return enters * std::numbers::pi_v<float> *
           follow_ray(context, task, {point.ray_origin(), direction}, state, random);
}

int count_bounces(const RenderSettings& settings) {
    return std::min(settings.light.bounces, settings.light.path_depth - 1);
}

KnownIrradiance make_frame_irradiance(const IndirectContext& context, const IrradianceCache* cache) {
    const auto find = [&context, cache](const ViewedSurface& surface, const Hit& hit, float accuracy, const Rgb&,
                                        RayTask& task) -> std::optional<Rgb> {
        if (context.carried != nullptr) {
            PixelSurface place{surface};
            place.hit = hit;
            if (const std::optional<Rgb> found = context.carried->find(place, accuracy, task)) return found;
        }
        if (cache == nullptr) return std::nullopt;
        return cache->interpolate({surface.point.position, surface.point.normal, accuracy * shade_reach, &task});
    };
    return {count_bounces(context.settings), find};
}

MultiBounceLight make_multi_bounce_light(const RenderSettings& settings, const FurtherBounces* known) {
    MultiBounceLight light{.bounces = std::max(0, count_bounces(settings) - 1)};
    if (known == nullptr) return light;
    light.cache = &known->cache;
    light.accuracy = shade_reach * known->accuracy;
    return light;
}

std::optional<FurtherBounces> solve_further_bounces(const IndirectContext& context,
                                                    const std::vector<PixelSurface>& seen, FrameCounts& counts) {
    const int bounces = count_bounces(context.settings) - 1;
    if (bounces <= 0 || seen.empty()) return std::nullopt;
    FrameTally tally;
    const BouncePlaces places = cast_bounce_places(context.lighting, seen, context.settings.seed, tally.counts.rays);
    tally.records = tally.invalid_samples = Image<float>(places.hits.width, places.hits.height);
    std::vector<KeptRays> gathered;
    FillPlaces fill = make_fill_places(context.lighting.shading, places);
    fill.coarse_first = false;
    fill.rays = choose_fewest_rays(context.settings.picture);
    fill.most_rays = most_record_rays;
    fill.noise = record_noise_aim;
    fill.gathered = &gathered;
    DirectGrid direct(context.max_radius);
    FurtherBounces known{make_cache(context.lighting.shading), choose_alpha(context.settings)};
    const Image<float> accuracy(places.hits.width, places.hits.height, known.accuracy);
    IndirectContext coarse = make_places_context(context, accuracy);
    coarse.direct = &direct;
    coarse.bounces.further = {.bounces = bounces - 1, .noted = true};
    coarse.bounces.before = 1;
    fill_places(known.cache, coarse, fill, tally);
    const float reach = shade_reach * known.accuracy;
    if (bounces > 1) {
        known.cache.prepare();
        known.cache.restore(add_bounces(coarse, known.cache, reach, std::move(gathered), bounces, tally.counts.rays));
    }
    known.cache.finish();
    known.cache.prepare();
    counts.rays += tally.counts.rays;
    counts.multi_bounce_rays += tally.counts.rays.total();
    counts.multi_bounce_records += tally.counts.records;
    return known;
}

std::optional<FurtherBounces> restore_further_bounces(const IndirectContext& context,
                                                      const std::vector<IrradianceRecord>& records) {
    if (records.empty()) return std::nullopt;
    FurtherBounces known{make_cache(context.lighting.shading), choose_alpha(context.settings)};
    known.cache.restore(records);
    known.cache.prepare();
    return known;
}

}  // namespace aleph
