#include "render/sample_shading.h"

#include "render/bounce_levels.h"
#include "render/gather_at.h"
#include "render/glossy_light.h"

namespace aleph {

namespace {

/// Keeps the random numbers of paths apart from those of direct light and of gathers (gather_at.cpp).
constexpr std::uint32_t path_seed_mask = 0x70617468u;

constexpr int lights_in_mirrors = 4;  // PathState::light_samples

/// Root mean square error of irradiance that stands in for lobes, over the tolerance of the pixel's samples. At 2.8
/// standard deviations that is .28 of the tolerance, and with the error of samples, which is independent, 1.04 of it.
constexpr float stand_in_share = 0.1f;

RandomStream path_stream(const SampleShading& shading, const PixelSurface& surface) {
    return RandomStream({shading.context.settings.seed ^ path_seed_mask, shading.moment, surface.pixel,
                         static_cast<std::uint32_t>(surface.sample)});
}

PathState start_path(const RenderSettings& settings) {
    PathState state;
    state.left = {settings.bounces, settings.path_depth};
    return state;
}

/// Indirect irradiance from key moments or from the cache; nothing where neither has a record.
std::optional<Rgb> read_irradiance(const SampleShading& shading, ShadingTask& task, const PixelSurface& surface) {
    const IndirectContext& context = shading.context;
    const float accuracy = context.accuracy(surface.x, surface.y);
    RecordUse* const used = shading.uses == nullptr ? nullptr : &(*shading.uses)(surface.x, surface.y);
    std::optional<Rgb> found;
    if (context.carried != nullptr) {
        ++task.lookups;
        found = context.carried->find(surface, accuracy, task, used);
    }
    if (!found && shading.cache != nullptr && accuracy > 0.0f) {
        const float reach = accuracy * static_cast<float>(context.settings.shade_reach);
        CacheQuery query{surface.point.position, surface.point.normal, reach, &task};
        query.used = used;
        ++task.lookups;
        found = shading.cache->interpolate(query);
    }
    if (found) ++task.hits;
    return found;
}

/// Indirect irradiance from rays of its own.
Rgb gather_irradiance(const SampleShading& shading, ShadingTask& task, const PixelSurface& surface) {
    const IndirectContext& context = shading.context;
    const float accuracy = context.accuracy(surface.x, surface.y);
    std::optional<float> ray_variance;
    if (shading.cache != nullptr) {
        ray_variance = shading.cache->expected_ray_variance({surface.point.position, surface.point.normal, accuracy});
    }
    ++task.computed;
    (*shading.records)(surface.x, surface.y) += 1.0f;
    return gather_at(context, task, surface, task.scratch, choose_rays(context.settings, accuracy, ray_variance))
        .irradiance;
}

/// Share of light that reaches the camera: it may stand in what it sees from inside.
Rgb share_left(const PixelSurface& surface) {
    const Rgb loss = Media().attenuation(surface);
    return loss == Rgb(0.0f) ? Rgb(1.0f) : glm::exp(-loss * surface.distance);
}

/// Adds what the surface reflects of its irradiance.
void add_irradiance(const PixelSurface& surface, const Rgb& irradiance, SampleLight& light) {
    const LitSurface lit(surface);
    light.indirect =
        diffuse_radiance(surface.material, lit.cos_view, irradiance) * lit.below_sheen * share_left(surface);
    light[LightPart::surface] += light.indirect;
}

void add_by_paths(const SampleShading& shading, const SampleMoment& moment, ShadingTask& task,
                  const PixelSurface& surface, SampleLight& light) {
    RandomStream random = path_stream(shading, surface);
    light[LightPart::surface] = surface.material.emission;
    light[LightPart::gloss] =
        scatter_light(moment.lighting, task, surface, start_path(shading.context.settings), random);
}

/// Lobes to sample, and what stands in for the others where the irradiance is known.
SampledLobes choose_lobes(const SampleShading& shading, const PixelSurface& surface,
                          const std::optional<Rgb>& irradiance) {
    const LitSurface lit(surface);
    const bool tolerant = shading.gloss_tolerance != nullptr && irradiance && surface.material.has_specular();
    const float tolerance = tolerant ? stand_in_share * (*shading.gloss_tolerance)(surface.x, surface.y) : 0.0f;
    return choose_sampled_lobes(lit, irradiance.value_or(Rgb(0.0f)), tolerance);
}

/// @param irradiance  indirect; nothing where it is not known
void add_with_cache(const SampleShading& shading, ShadingTask& task, const PixelSurface& surface,
                    const std::optional<Rgb>& irradiance, SampleLight& light) {
    const RenderSettings& settings = shading.context.settings;
    RandomStream random({settings.seed, shading.moment, surface.pixel, 0});  // one lattice for all samples
    RandomStream path_random = path_stream(shading, surface);
    PathState beyond = start_path(settings);
    --beyond.left.depth;
    beyond.roulette_after = 0;  // most lobes reflect little, and there are many samples
    beyond.survival = 4.0f;     // but a path that ends early leaves noise behind the rays already cast
    beyond.known = shading.known;
    beyond.accuracy = shading.context.accuracy(surface.x, surface.y);
    beyond.light_samples = lights_in_mirrors;
    LightPoints points = shading.points;
    points.part = surface.sample;
    const SampledLobes lobes = choose_lobes(shading, surface, irradiance);
    const SampledLight sampled = compute_sampled_light(shading.context.lighting, task, surface, points, random, beyond,
                                                       path_random, &lobes.shares);
    light[LightPart::direct] = sampled.direct;
    light[LightPart::gloss] = sampled.lobes + lobes.radiance;
    light[LightPart::surface] = surface.material.emission;
}

}  // namespace

bool shade_sample(const SampleShading& shading, const SampleMoment& moment, ShadingTask& task,
                  const PixelSurface& surface, SampleLight& light) {
    light = {};
    light.instance = surface.hit.instance;
    light.normal = surface.point.geometric;
    const bool needs_irradiance = !shading.by_paths && shading.indirect && surface.material.has_diffuse();
    std::optional<Rgb> irradiance;
    if (needs_irradiance) irradiance = read_irradiance(shading, task, surface);
    if (shading.by_paths) {
        add_by_paths(shading, moment, task, surface, light);
    } else {
        add_with_cache(shading, task, surface, irradiance, light);
    }
    const Rgb left = share_left(surface);
    for (Rgb& part : light.parts) part *= left;
    if (!needs_irradiance) return true;
    if (!irradiance && shading.cache == nullptr) irradiance = gather_irradiance(shading, task, surface);
    if (irradiance) add_irradiance(surface, *irradiance, light);
    return irradiance.has_value();
}

void add_indirect(const SampleShading& shading, ShadingTask& task, const PixelSurface& surface, SampleLight& light) {
    const std::optional<Rgb> irradiance = read_irradiance(shading, task, surface);
    add_irradiance(surface, irradiance ? *irradiance : gather_irradiance(shading, task, surface), light);
}

}  // namespace aleph
