#include "render/sample_shading.h"

#include "render/bounce_levels.h"
#include "render/gather_at.h"

namespace aleph {

namespace {

/// Keeps the random numbers of paths apart from those of direct light and of gathers (gather_at.cpp).
constexpr std::uint32_t path_seed_mask = 0x70617468u;

RandomStream path_stream(const SampleShading& shading, const PixelSurface& surface) {
    return RandomStream({shading.context.settings.seed ^ path_seed_mask, shading.moment, surface.pixel,
                         static_cast<std::uint32_t>(surface.sample)});
}

PathState start_path(const RenderSettings& settings) {
    PathState state;
    state.left = {settings.bounces, settings.path_depth};
    return state;
}

/// Indirect irradiance: from key moments, from the cache, or gathered if neither has a record here. The latter happens
/// where neighbour clamping shrank a record after it covered this place, and at samples that filling did not visit.
Rgb find_irradiance(const SampleShading& shading, ShadingTask& task, const PixelSurface& surface) {
    const IndirectContext& context = shading.context;
    const float accuracy = context.accuracy(surface.x, surface.y);
    RecordUse* const used = shading.uses == nullptr ? nullptr : &(*shading.uses)(surface.x, surface.y);
    if (context.carried != nullptr) {
        ++task.lookups;
        if (const std::optional<Rgb> found = context.carried->find(surface, accuracy, task, used)) {
            ++task.hits;
            return *found;
        }
    }
    const CacheQuery place{surface.point.position, surface.point.normal, accuracy, &task};
    std::optional<float> ray_variance;
    if (shading.cache != nullptr && accuracy > 0.0f) {
        CacheQuery query = place;
        query.accuracy *= static_cast<float>(context.settings.shade_reach);
        query.used = used;
        ++task.lookups;
        if (const std::optional<Rgb> found = shading.cache->interpolate(query)) {
            ++task.hits;
            return *found;
        }
        ray_variance = shading.cache->expected_ray_variance(place);
    }
    ++task.computed;
    (*shading.records)(surface.x, surface.y) += 1.0f;
    const int rays = choose_rays(context.settings, accuracy, ray_variance);
    return gather_at(context, task, surface, task.scratch, rays).irradiance;
}

void add_by_paths(const SampleShading& shading, const SampleMoment& moment, ShadingTask& task,
                  const PixelSurface& surface, SampleLight& light) {
    RandomStream random = path_stream(shading, surface);
    light[LightPart::surface] = surface.material.emission;
    light[LightPart::gloss] =
        scatter_light(moment.lighting, task, surface, start_path(shading.context.settings), random);
}

void add_with_cache(const SampleShading& shading, ShadingTask& task, const PixelSurface& surface, SampleLight& light) {
    const RenderSettings& settings = shading.context.settings;
    RandomStream random({settings.seed, shading.moment, surface.pixel, 0});  // one lattice for all samples
    RandomStream path_random = path_stream(shading, surface);
    PathState beyond = start_path(settings);
    --beyond.left.depth;
    beyond.roulette_after = 0;  // most lobes reflect little, and there are many samples
    LightPoints points = shading.points;
    points.part = surface.sample;
    const SampledLight sampled =
        compute_sampled_light(shading.context.lighting, task, surface, points, random, beyond, path_random);
    light[LightPart::direct] = sampled.direct;
    light[LightPart::gloss] = sampled.lobes;
    light[LightPart::surface] = surface.material.emission;
    if (!shading.indirect || !surface.material.has_diffuse()) return;
    const LitSurface lit(surface);
    light.indirect = diffuse_radiance(surface.material, lit.cos_view, find_irradiance(shading, task, surface)) *
                     lit.below_sheen;
    light[LightPart::surface] += light.indirect;
}

}  // namespace

SampleLight shade_sample(const SampleShading& shading, const SampleMoment& moment, ShadingTask& task,
                         const PixelSurface& surface) {
    SampleLight light;
    light.instance = surface.hit.instance;
    light.normal = surface.point.geometric;
    if (shading.by_paths) {
        add_by_paths(shading, moment, task, surface, light);
    } else {
        add_with_cache(shading, task, surface, light);
    }
    // The camera may stand in what it sees from inside.
    if (const Rgb loss = Media().attenuation(surface); loss != Rgb(0.0f)) {
        const Rgb left = glm::exp(-loss * surface.distance);
        for (Rgb& part : light.parts) part *= left;
    }
    return light;
}

}  // namespace aleph
