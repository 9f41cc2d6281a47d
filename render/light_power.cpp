#include "render/light_power.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/environment_map.h"

namespace aleph {

namespace {

/// W, as a sphere around the visible scene takes it in; roughly, for a choice among lights.
std::vector<double> estimate_powers(const ShadingScene& shading, const LightSet& lights) {
    constexpr double half_turn = std::numbers::pi;
    const glm::vec3 diagonal = shading.bounds.high - shading.bounds.low;
    const double radius2 = diagonal.x >= 0.0f ? 0.25 * glm::dot(diagonal, diagonal) : 1.0;
    std::vector<double> powers;
    for (const Emitter& emitter : lights.emitters) {
        powers.push_back(half_turn * luminance(emitter.radiance) * emitter.area * (emitter.double_sided ? 2.0 : 1.0));
    }
    for (const PunctualLight& light : lights.punctual) {
        const double solid_angle =
            light.kind == Light::Kind::spot ? 2.0 * half_turn * light.outer_versine : 4.0 * half_turn;
        powers.push_back(luminance(light.intensity) *
                         (light.kind == Light::Kind::directional ? half_turn * radius2 : solid_angle));
    }
    if (lights.has_environment) {
        const double mean = shading.environment_map != nullptr ? shading.environment_map->mean_luminance : 1.0;
        powers.push_back(half_turn * half_turn * radius2 * mean * luminance(shading.environment));
    }
    return powers;
}

LightBound bound_emitter(const Emitter& emitter) {
    LightBound bound;
    bound.position = emitter.center;
    bound.radius = emitter.radius;
    bound.strength = luminance(emitter.radiance) * emitter.area;
    if (emitter.double_sided) return bound;
    bound.axis = emitter.triangles.front().normal;
    bound.one_sided = std::ranges::all_of(
        emitter.triangles, [&](const Emitter::Triangle& t) { return glm::dot(t.normal, bound.axis) > 0.9999f; });
    return bound;
}

}  // namespace

std::vector<float> make_choice_ends(const ShadingScene& shading, const LightSet& lights) {
    const std::vector<double> powers = estimate_powers(shading, lights);
    double total = 0.0, end = 0.0;
    for (const double power : powers) total += std::isfinite(power) ? power : 0.0;
    const double uniform = 1.0 / static_cast<double>(powers.size());
    std::vector<float> ends;
    for (const double power : powers) {
        const double share = std::isfinite(power) ? power / total : 0.0;
        end += total > 0.0 ? 0.9 * share + 0.1 * uniform : uniform;
        ends.push_back(static_cast<float>(end));
    }
    if (!ends.empty()) ends.back() = 1.0f;
    return ends;
}

std::vector<LightBound> make_light_bounds(const ShadingScene& shading, const LightSet& lights) {
    std::vector<LightBound> bounds;
    for (const Emitter& emitter : lights.emitters) bounds.push_back(bound_emitter(emitter));
    for (const PunctualLight& light : lights.punctual) {
        LightBound bound;
        bound.strength = luminance(light.intensity);
        bound.position = light.position;
        if (light.kind == Light::Kind::directional) {
            bound.reach = LightBound::Reach::directional;
            bound.axis = -light.direction;
        }
        bounds.push_back(bound);
    }
    if (lights.has_environment) {
        const double mean = shading.environment_map != nullptr ? shading.environment_map->mean_luminance : 1.0;
        LightBound bound;
        bound.reach = LightBound::Reach::everywhere;
        bound.strength = static_cast<float>(std::numbers::pi * mean * luminance(shading.environment));
        bounds.push_back(bound);
    }
    // A light that is not a number is chosen as any other: what it lights is dropped and counted, not hidden.
    for (LightBound& bound : bounds) {
        if (!std::isfinite(bound.strength)) bound.strength = 1.0f;
    }
    return bounds;
}

LightChoice choose_at_random(const LightSet& lights, float u) {
    const std::vector<float>& ends = lights.choice_ends;
    const auto found = std::upper_bound(ends.begin(), ends.end(), u);
    const std::size_t i = std::min(static_cast<std::size_t>(found - ends.begin()), ends.size() - 1);
    return {static_cast<int>(i), ends[i] - (i == 0 ? 0.0f : ends[i - 1])};
}

}  // namespace aleph
