#include "render/shade/sample_shading.h"

#include "render/cache/aimed_rays.h"
#include "render/cache/gather_at.h"
#include "render/settings/numbers.h"

namespace aleph {

namespace {

constexpr std::uint32_t irradiance_seed_mask = 0x69727261u;  // apart from path_seed_mask and others (gather_at.cpp)

/// Rays over the hemisphere of a sample. `gather` is their number where there are no records that it speaks of, and
/// their error does not decide the number of samples.
int count_sample_rays(const RenderSettings& settings) {
    const bool has_records = settings.cache.accuracy > 0.0;
    const bool chosen = !has_records && settings.sampling.rule == Sampling::uniform && settings.cache.gather > 0;
    return chosen ? settings.cache.gather : sample_rays;
}

/// Indirect irradiance from lighting keyframes or from the cache, while the shutter is open at its centre; nothing
/// where neither has a record.
std::optional<Rgb> look_up(const SampleShading& shading, ShadingTask& task, const PixelSurface& surface) {
    const IndirectContext& context = shading.context;
    const float accuracy = context.accuracy(surface.x, surface.y);
    RecordUse* const used = shading.uses == nullptr ? nullptr : &(*shading.uses)(surface.x, surface.y);
    std::optional<Rgb> found;
    if (shading.blurred) {
        if (shading.shutter == nullptr || !(accuracy > 0.0f)) return std::nullopt;
        ++task.lookups;
        RayTask& rays = shading.shutter->is_at_center() ? task.at_frame : task;
        found = shading.shutter->find(surface, accuracy, rays, used);
    } else if (context.carried != nullptr) {
        ++task.lookups;
        found = context.carried->find(surface, accuracy, task, used);
    }
    if (!found && !shading.blurred && shading.cache != nullptr && accuracy > 0.0f) {
        CacheQuery query{surface.point.position, surface.point.normal, accuracy * shade_reach, &task};
        query.used = used;
        ++task.lookups;
        found = shading.cache->interpolate(query);
    }
    if (found) ++task.hits;
    return found;
}

/// Indirect irradiance at the sample's own time, from random paths whose first directions belong to the pixel's
/// sequence. Lamps that they meet straight away are direct light.
Rgb sample_irradiance(const SampleShading& shading, const SampleScene& scene, ShadingTask& task,
                      const PixelSurface& surface) {
    const RenderSettings& settings = shading.context.settings;
    const PixelSequence sequence(settings.seed, shading.context.frame, surface.x, surface.y);
    RandomStream random = path_stream(settings.seed, shading.context.frame, surface, irradiance_seed_mask);
    PathState state =
        start_indirect({settings.light.bounces - 1, settings.light.path_depth - 1}, scene.lighting.around);
    state.known = shading.known;
    state.accuracy = shading.context.accuracy(surface.x, surface.y);
    const Basis basis = make_basis(surface.point.normal);
    const int rays = count_sample_rays(settings);
    const BrightSurfaces* const surfaces = shading.blurred ? nullptr : shading.context.bright;
    const int aimed = surfaces == nullptr ? 0 : std::max(1, rays / around_per_aimed);
    std::optional<BrightSampler> bright;
    const Receiver receiver{surface.point.ray_origin(), surface.point.normal};
    if (aimed > 0) state.bright = &bright.emplace(*surfaces, receiver, rays, aimed);
    const UpperLayers layers(surface.material, surface.point.normal);
    Rgb sum(0.0f);
    const auto follow = [&](const glm::vec3& direction, float cosine) {
        if (!(glm::dot(direction, surface.point.geometric) > 0.0f)) return;
        ++task.counts.path;
        sum += follow_ray(scene.lighting, task, {receiver.position, direction}, state, random) *
               layers.entering(direction, cosine);
    };
    for (int i = 0; i < rays; ++i) {
        const glm::vec2 u = sequence.at_2d(SampleUse::indirect, surface.sample * rays + i);
        const glm::vec3 local = sample_cosine_hemisphere(u);
        follow(basis.to_world(local), local.z);
    }
    for (int i = 0; i < aimed; ++i) {
        const int at = surface.sample * aimed + i;
        const BrightSampler::Aim aim =
            bright->aim({sequence.at_1d(SampleUse::bright_choice, at), sequence.at_2d(SampleUse::bright_point, at)});
        state.patch = aim.patch;
        if (aim.patch != no_index) follow(aim.direction, glm::dot(surface.point.normal, aim.direction));
    }
    return sum * (pi / static_cast<float>(rays));
}

PathState start_beyond(const SampleShading& shading, const SampleScene& scene, const PixelSurface& surface) {
    PathState beyond = start_path(shading.context.settings, scene.lighting.around);
    --beyond.left.depth;
    beyond.roulette_after = 0;  // most lobes reflect little, and there are many samples
    beyond.survival = 40.0f;    // but those that end by chance leave bright dots, where gloss shows a lamp in gloss
    beyond.splits = 3;          // without a limit stacks of panes cost several times the rays
    beyond.known = shading.known;
    beyond.accuracy = shading.context.accuracy(surface.x, surface.y);
    return beyond;
}

/// Adds all but the indirect light of the Lambert layer.
void add_with_cache(const SampleShading& shading, const SampleScene& scene, ShadingTask& task,
                    const PixelSurface& surface, SampleLight& light) {
    const LightingContext& lighting = scene.lighting;
    const RenderSettings& settings = shading.context.settings;
    const LitSurface lit(surface);
    const LobeShares shares = share_lobes(lit, LobeSet::specular);
    light[LightPart::surface] = surface.material.emission;
    const PixelSequence sequence(settings.seed, shading.context.frame, surface.x, surface.y);
    const int count = settings.light.light_samples;
    light[LightPart::direct] =
        sample_direct_light(lighting, task, lit, shares, sequence, {surface.sample * count, count});
    if (shares != LobeShares{}) {
        const int i = surface.sample;
        const ScatterSample sample =
            sample_scatter(lit, shares, sequence.at_1d(SampleUse::lobe_choice, i),
                           sequence.at_2d(SampleUse::lobe_direction, i), sequence.at_1d(SampleUse::lobe_side, i));
        RandomStream random = path_stream(settings.seed, shading.context.frame, surface);
        light[LightPart::gloss] =
            follow_sample(lighting, task, lit, sample, start_beyond(shading, scene, surface), random);
    }
}

}  // namespace

RandomStream path_stream(std::uint32_t seed, std::uint32_t noise_key, const PixelSurface& surface, std::uint32_t mask) {
    return RandomStream({seed ^ mask, noise_key, surface.pixel, static_cast<std::uint32_t>(surface.sample)});
}

PathState start_path(const RenderSettings& settings, const Media& around) {
    return {.left = {settings.light.bounces, settings.light.path_depth}, .media = around};
}

SampleScene scene_before(const SampleScene& scene, RayTask& task, const PixelSurface& surface) {
    SampleScene before = scene;
    Media& media = before.lighting.around;
    if (!media.is_empty() && (scene.view.orthographic || scene.lens.radius > 0.0))
        media = find_media(scene.lighting.shading, task.tracer, {surface.point.ray_origin(), surface.point.geometric},
                           task.counts.primary);
    return before;
}

Rgb share_left(const Media& before, const PixelSurface& surface) {
    return transmit(before.attenuation(surface.point, surface.material), surface.hit.distance);
}

Rgb find_emission(const SampleScene& scene, RayTask& task, const SamplePlace& place, const Hit& hit,
                  const glm::vec3& direction, const glm::ivec2& pixel) {
    if (hit.instance == no_index) return environment_radiance(scene.lighting.shading, direction);
    const PixelSurface surface = make_pixel_surface(scene.lighting.shading, scene.view, place, hit, direction, pixel);
    return surface.material.emission * share_left(scene_before(scene, task, surface).lighting.around, surface);
}

void begin_light(const PixelSurface& surface, SampleLight& light) {
    light.place = {.instance = surface.hit.instance,
                   .position = surface.point.position,
                   .geometric = surface.point.geometric,
                   .normal = surface.point.normal,
                   .footprint = surface.footprint};
}

void shade_sample(const SampleShading& shading, const SampleScene& scene, ShadingTask& task,
                  const PixelSurface& surface, const PixelSamples& pixel, SampleLight& light) {
    const bool needs_irradiance = shading.indirect && surface.material.has_diffuse();
    std::optional<Rgb> irradiance;
    if (needs_irradiance) {
        // Irradiance that other samples read may not hold at this one's time.
        if (!shading.blurred || (shading.shutter != nullptr && shading.shutter->is_still()))
            irradiance = pixel.find_irradiance(light);
        if (!irradiance) irradiance = light.irradiance = look_up(shading, task, surface);
    }
    add_with_cache(shading, scene, task, surface, light);
    const Rgb left = share_left(scene.lighting.around, surface);
    for (Rgb& part : light.parts) part *= left;
    if (!needs_irradiance) return;
    if (!irradiance) irradiance = sample_irradiance(shading, scene, task, surface);
    const LitSurface lit(surface);
    light.indirect = diffuse_radiance(surface.material, lit.cos_view, *irradiance) * lit.below_sheen * left;
    light[LightPart::surface] += light.indirect;
}

}  // namespace aleph
