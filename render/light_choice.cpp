#include "render/light_choice.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/light_power.h"

namespace aleph {

namespace {

constexpr int max_candidates = 16;  // lights compared at a point
constexpr int max_sheets = 64;      // sheets that a shadow ray passes

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

}  // namespace

Ray make_shadow_ray(const LitSurface& lit, const LightSample& sample) {
    const Ray ray{lit.point.ray_origin(), sample.direction, 0.0f, sample.distance};
    const glm::vec3 origin = lit.ray_origin(sample.direction);
    return origin == ray.origin ? ray : move_origin(ray, origin);
}

ScatteredLight choose_light(const LightingContext& context, const LitSurface& lit, const LobeShares& shares,
                            RandomStream& random) {
    const int lights = context.lights.count();
    if (lights == 0) return {};
    const int candidates = std::min(lights, max_candidates);
    const Receiver receiver{lit.point.ray_origin(), lit.point.normal};
    std::array<ScatteredLight, max_candidates> scattered;
    std::array<float, max_candidates> cumulative{};
    float total = 0.0f;
    for (int c = 0; c < candidates; ++c) {
        LightChoice choice{c, 1.0f};
        if (candidates < lights) {
            choice = choose_at_random(context.lights,
                                      (static_cast<float>(c) + random.next()) / static_cast<float>(candidates));
            choice.probability *= static_cast<float>(candidates);
        }
        const LightSample sample =
            sample_light(context.shading, context.lights, choice.light, receiver, random.next_2d());
        if (sample.incoming != Rgb(0.0f) && lit.is_reached(sample.direction)) {
            scattered[c].radiance =
                scatter_towards(lit, sample.direction, sample.pdf, shares) * sample.incoming / choice.probability;
            scattered[c].shadow_ray = make_shadow_ray(lit, sample);
            const float brings = luminance(scattered[c].radiance);
            if (!std::isfinite(brings)) return scattered[c];  // not hidden: the sample is dropped and counted
            total += brings;
        }
        cumulative[c] = total;
    }
    if (!(total > 0.0f)) return {};
    const float pick = random.next() * total;
    int chosen = 0;
    while (chosen + 1 < candidates && cumulative[chosen] <= pick) ++chosen;
    ScatteredLight& picked = scattered[chosen];
    const float weight = luminance(picked.radiance);
    if (!(weight > 0.0f)) return {};
    picked.radiance *= total / weight;
    return picked;
}

Rgb find_transmittance(const LightingContext& context, RayTask& task, const Ray& ray) {
    if (!context.shading.has_sheets) {
        ++task.counts.shadow;
        return Rgb(task.tracer.occluded(ray) ? 0.0f : 1.0f);
    }
    Rgb passed(1.0f);
    Ray left = ray;
    for (int sheet = 0; sheet < max_sheets; ++sheet) {
        ++task.counts.shadow;
        const Hit hit = task.tracer.intersect(left);
        if (hit.instance == no_index) return passed;
        const SurfacePoint point = make_surface_point(context.shading, hit, left.direction);
        const ViewedSurface surface = view_surface(context.shading, point, -left.direction, {});
        if (!surface.material.passes_straight()) return Rgb(0.0f);
        const LitSurface lit(surface);
        passed *= sheet_transmittance(lit);
        if (passed == Rgb(0.0f)) return passed;
        left = move_origin(left, lit.ray_origin(left.direction));
    }
    return Rgb(0.0f);
}

}  // namespace aleph
