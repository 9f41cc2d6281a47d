#include "render/light_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

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

/// A light for a point, not sampled yet.
struct LightPick {
    int light = no_index;
    float probability = 0.0f;
    float total = 0.0f;  ///< illuminance of all that were compared
};

/// The position in a list of weights that a number in [0,1) falls on; its weight is above 0.
/// @param total  sum of the weights, above 0
int pick_weight(std::span<const float> weights, float total, float number) {
    const float place = number * total;
    float sum = 0.0f;
    std::size_t chosen = 0;
    for (const float weight : weights) {
        sum += weight;
        chosen += sum <= place ? 1 : 0;
    }
    chosen = std::min(chosen, weights.size() - 1);
    while (chosen > 0 && !(weights[chosen] > 0.0f)) --chosen;  // rounding at the end
    return static_cast<int>(chosen);
}

/// Among all lights.
LightPick pick_of_all(const LightSet& lights, const Receiver& receiver, float behind, float number) {
    static_assert(max_candidates % LightBounds::step == 0);
    const std::size_t count = static_cast<std::size_t>(lights.count());
    std::array<float, max_candidates> weights;
    bound_illuminances(lights.bounds, receiver.position, receiver.normal, behind,
                       {weights.data(), lights.bounds.strength.size()});
    LightPick pick;
    for (std::size_t i = 0; i < count; ++i) pick.total += weights[i];
    if (!std::isfinite(pick.total) || !(pick.total > 0.0f)) return pick;
    pick.light = pick_weight({weights.data(), count}, pick.total, number);
    pick.probability = weights[pick.light] / pick.total;
    return pick;
}

/// Among candidates that are drawn by their power.
LightPick pick_of_candidates(const LightSet& lights, const Receiver& receiver, float behind,
                             const LightNumbers& numbers) {
    std::array<LightChoice, max_candidates> choices;
    std::array<float, max_candidates> weights;
    LightPick pick;
    for (int c = 0; c < max_candidates; ++c) {
        choices[c] =
            choose_at_random(lights, (static_cast<float>(c) + numbers.candidates) / static_cast<float>(max_candidates));
        choices[c].probability *= static_cast<float>(max_candidates);
        weights[c] = bound_illuminance(lights.bounds, static_cast<std::size_t>(choices[c].light), receiver.position,
                                       receiver.normal, behind) /
                     choices[c].probability;
        pick.total += weights[c];
    }
    if (!std::isfinite(pick.total) || !(pick.total > 0.0f)) return pick;
    const int chosen = pick_weight(weights, pick.total, numbers.choice);
    pick.light = choices[chosen].light;
    pick.probability = choices[chosen].probability * weights[chosen] / pick.total;
    return pick;
}

/// @param behind  1 where light from behind the surface counts as well, else 0
LightPick pick_light(const LightSet& lights, const Receiver& receiver, float behind, const LightNumbers& numbers) {
    return lights.count() > max_candidates ? pick_of_candidates(lights, receiver, behind, numbers)
                                           : pick_of_all(lights, receiver, behind, numbers.choice);
}

/// Where no light is picked: nothing, or a value that is not finite, which is not hidden: the sample is dropped and
/// counted.
ScatteredLight without_light(const LightPick& pick) {
    return {{}, Rgb(std::isfinite(pick.total) ? 0.0f : pick.total)};
}

}  // namespace

Ray make_shadow_ray(const LitSurface& lit, const LightSample& sample) {
    const Ray ray{lit.point.ray_origin(), sample.direction, 0.0f, sample.distance};
    const glm::vec3 origin = lit.ray_origin(sample.direction);
    return origin == ray.origin ? ray : move_origin(ray, origin);
}

ScatteredLight choose_light(const LightingContext& context, const LitSurface& lit, const LobeShares& shares,
                            const LightNumbers& numbers) {
    const Receiver receiver{lit.point.ray_origin(), lit.point.normal};
    const LightPick pick = pick_light(context.lights, receiver, lit.material.has_glass() ? 1.0f : 0.0f, numbers);
    if (pick.light == no_index) return without_light(pick);
    const LightSample sample = sample_light(context.shading, context.lights, pick.light, receiver, numbers.point);
    if (sample.incoming == Rgb(0.0f) || !lit.is_reached(sample.direction)) return {};
    return {make_shadow_ray(lit, sample),
            scatter_towards(lit, sample.direction, sample.pdf, shares) * sample.incoming / pick.probability};
}

ScatteredLight choose_lambert_light(const LightingContext& context, const SurfacePlace& place,
                                    const LightNumbers& numbers) {
    const Receiver receiver{place.ray_origin(), place.normal};
    const LightPick pick = pick_light(context.lights, receiver, 0.0f, numbers);
    if (pick.light == no_index) return without_light(pick);
    const LightSample sample = sample_light(context.shading, context.lights, pick.light, receiver, numbers.point);
    const float cosine = glm::dot(place.normal, sample.direction);
    if (!(cosine > 0.0f && glm::dot(place.geometric, sample.direction) > 0.0f)) return {};
    return {{receiver.position, sample.direction, 0.0f, sample.distance},
            sample.incoming * (cosine / (std::numbers::pi_v<float> * pick.probability))};
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
