#include "render/light/light_choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/light/light_cut.h"

namespace aleph {

namespace {

/// From another origin to the end of the ray.
Ray move_origin(const Ray& ray, const glm::vec3& origin) {
    Ray moved{origin, ray.direction, 0.0f, ray.far};
    if (!std::isfinite(ray.far)) return moved;
    const glm::vec3 left = ray.origin + ray.direction * ray.far - origin;
    moved.far = std::max(0.0f, glm::dot(left, ray.direction));
    if (moved.far > 0.0f) {
        moved.far = glm::length(left);
        moved.direction = left / moved.far;
    }
    return moved;
}

/// Samples one light.
/// @param scatter  gives the light that is scattered of a sample of this probability
template <class Scatter>
ScatteredLight sample_one_light(const LightingContext& context, const Receiver& from, const LightNumbers& numbers,
                                const Scatter& scatter) {
    std::optional<SeenOpenings> seen;
    const Receiver receiver = with_openings(from, seen);
    const LightCut cut = find_light_cut(context.lights, receiver, context.met);
    const LightPick pick = pick_light(cut, receiver, numbers.choice);
    // A value that is not finite is not hidden: the sample is dropped and counted.
    if (pick.light == no_index) return {{}, Rgb(std::isfinite(cut.total) ? 0.0f : cut.total)};
    return scatter(sample_light(context.shading, context.lights, pick.light, receiver, numbers.point),
                   pick.probability);
}

}  // namespace

Ray make_shadow_ray(const LitSurface& lit, const LightSample& sample) {
    const Ray ray{lit.point.ray_origin(), sample.direction, 0.0f, sample.distance};
    const glm::vec3 origin = lit.ray_origin(sample.direction);
    return origin == ray.origin ? ray : move_origin(ray, origin);
}

ScatteredLight choose_light(const LightingContext& context, const LitSurface& lit, const LobeShares& shares,
                            const LightNumbers& numbers) {
    const Receiver receiver = make_receiver(context, lit);
    const auto scatter = [&](const LightSample& sample, float probability) -> ScatteredLight {
        if (sample.incoming == Rgb(0.0f) || !lit.is_reached(sample.direction)) return {};
        return {make_shadow_ray(lit, sample),
                scatter_towards(lit, sample.direction, sample.pdf, shares) * sample.incoming / probability,
                context.shading.needs_shadow_ray(sample.pdf)};
    };
    return sample_one_light(context, receiver, numbers, scatter);
}

ScatteredLight choose_lambert_light(const LightingContext& context, const SurfacePlace& place,
                                    const LightNumbers& numbers) {
    const Receiver receiver = make_lambert_receiver(context, place);
    const auto scatter = [&](const LightSample& sample, float probability) -> ScatteredLight {
        const float cosine = glm::dot(place.normal, sample.direction);
        if (!(cosine > 0.0f && glm::dot(place.geometric, sample.direction) > 0.0f)) return {};
        return {{receiver.position, sample.direction, 0.0f, sample.distance},
                sample.incoming * (cosine / (std::numbers::pi_v<float> * probability)),
                context.shading.needs_shadow_ray(sample.pdf)};
    };
    return sample_one_light(context, receiver, numbers, scatter);
}

Rgb transmit_to_light(const Media& around, const LitSurface& lit, const Ray& shadow_ray) {
    return transmit(around.attenuation_towards(shadow_ray.direction, lit.point, lit.material), shadow_ray.far);
}

bool pass_sheet(const ShadingScene& shading, const Hit& hit, Ray& ray, Rgb& passed) {
    const SurfacePoint point = make_surface_point(shading, hit, ray.direction);
    const ViewedSurface surface = view_surface(shading, point, -ray.direction, {});
    if (!surface.material.passes_straight()) return false;
    const LitSurface lit(surface);
    passed *= sheet_transmittance(lit);
    ray = move_origin(ray, lit.ray_origin(ray.direction));
    return true;
}

Hit find_beyond_sheets(const LightingContext& context, RayTask& task, Ray& ray, Rgb& passed, std::uint64_t& count) {
    for (int sheet = 0;; ++sheet) {
        ++count;
        const Hit hit = task.tracer.intersect(ray);
        if (hit.instance == no_index || !context.shading.has_thin_glass || sheet == max_sheets) return hit;
        if (!pass_sheet(context.shading, hit, ray, passed)) return hit;
    }
}

Rgb find_transmittance(const LightingContext& context, RayTask& task, const Ray& ray) {
    if (!context.shading.has_thin_glass) {
        ++task.counts.shadow;
        return Rgb(task.tracer.transmittance(ray));
    }
    Rgb passed(task.tracer.transmittance(ray, true));
    Ray left = ray;
    for (int sheet = 0; sheet < max_sheets; ++sheet) {
        ++task.counts.shadow;
        const Hit hit = task.tracer.intersect_others(left);
        if (hit.instance == no_index) return passed;
        if (!pass_sheet(context.shading, hit, left, passed)) return Rgb(0.0f);
    }
    return Rgb(0.0f);
}

}  // namespace aleph
