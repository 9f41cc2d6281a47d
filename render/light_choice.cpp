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
                            const LightNumbers& numbers) {
    const int lights = context.lights.count();
    if (lights == 0) return {};
    const int candidates = std::min(lights, max_candidates);
    const Receiver receiver{lit.point.ray_origin(), lit.point.normal};
    const bool behind = lit.material.has_glass();
    std::array<LightChoice, max_candidates> choices;
    std::array<float, max_candidates> weights;
    float total = 0.0f;
    for (int c = 0; c < candidates; ++c) {
        choices[c].light = c;
        if (candidates < lights) {
            choices[c] = choose_at_random(
                context.lights, (static_cast<float>(c) + numbers.candidates) / static_cast<float>(candidates));
            choices[c].probability *= static_cast<float>(candidates);
        }
        weights[c] =
            bound_illuminance(context.lights.bounds[choices[c].light], receiver.position, receiver.normal, behind) /
            choices[c].probability;
        total += weights[c];
    }
    if (!std::isfinite(total)) return {{}, Rgb(total)};  // not hidden: the sample is dropped and counted
    if (!(total > 0.0f)) return {};
    float left = numbers.choice * total;
    int c = 0;
    while (c + 1 < candidates && left >= weights[c]) left -= weights[c++];
    while (c > 0 && !(weights[c] > 0.0f)) --c;  // rounding at the end
    const LightSample sample = sample_light(context.shading, context.lights, choices[c].light, receiver, numbers.point);
    if (sample.incoming == Rgb(0.0f) || !lit.is_reached(sample.direction)) return {};
    const float probability = choices[c].probability * weights[c] / total;
    return {make_shadow_ray(lit, sample),
            scatter_towards(lit, sample.direction, sample.pdf, shares) * sample.incoming / probability};
}

ScatteredLight choose_light(const LightingContext& context, const LitSurface& lit, const LobeShares& shares,
                            RandomStream& random) {
    LightNumbers numbers;
    if (context.lights.count() > max_candidates) numbers.candidates = random.next();
    numbers.choice = random.next();
    numbers.point = random.next_2d();
    return choose_light(context, lit, shares, numbers);
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
