#include "render/light_power.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

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

void add_light(LightBounds& bounds, const glm::vec3& place, bool nearby, float radius, float strength,
               const std::optional<glm::vec3>& axis = {}) {
    bounds.x.push_back(place.x);
    bounds.y.push_back(place.y);
    bounds.z.push_back(place.z);
    bounds.nearby.push_back(nearby ? 1.0f : 0.0f);
    bounds.radius.push_back(radius);
    const glm::vec3 normal = axis.value_or(glm::vec3(0.0f));
    bounds.axis_x.push_back(normal.x);
    bounds.axis_y.push_back(normal.y);
    bounds.axis_z.push_back(normal.z);
    bounds.one_sided.push_back(axis ? 1.0f : 0.0f);
    // A light that is not a number is chosen as any other: what it lights is dropped and counted, not hidden.
    bounds.strength.push_back(std::isfinite(strength) ? strength : 1.0f);
    bounds.inside.push_back(radius > 0.0f ? bounds.strength.back() / (radius * radius) : 0.0f);
}

/// The normal of a flat light that shines on one side; else nothing.
std::optional<glm::vec3> find_axis(const Emitter& emitter) {
    const glm::vec3 axis = emitter.triangles.front().normal;
    const bool flat = std::ranges::all_of(
        emitter.triangles, [&](const Emitter::Triangle& t) { return glm::dot(t.normal, axis) > 0.9999f; });
    if (emitter.double_sided || !flat) return {};
    return axis;
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

LightBounds make_light_bounds(const ShadingScene& shading, const LightSet& lights) {
    LightBounds bounds;
    for (const Emitter& emitter : lights.emitters) {
        add_light(bounds, emitter.center, true, emitter.radius, luminance(emitter.radiance) * emitter.area,
                  find_axis(emitter));
    }
    for (const PunctualLight& light : lights.punctual) {
        const bool nearby = light.kind != Light::Kind::directional;
        add_light(bounds, nearby ? light.position : -light.direction, nearby, 0.0f, luminance(light.intensity));
    }
    if (lights.has_environment) {
        const double mean = shading.environment_map != nullptr ? shading.environment_map->mean_luminance : 1.0;
        add_light(bounds, glm::vec3(0.0f), false, 1.0f,
                  static_cast<float>(std::numbers::pi * mean * luminance(shading.environment)));
    }
    while (bounds.strength.size() % LightBounds::step != 0) add_light(bounds, glm::vec3(0.0f), false, 0.0f, 0.0f);
    return bounds;
}

LightChoice choose_at_random(const LightSet& lights, float u) {
    const std::vector<float>& ends = lights.choice_ends;
    const auto found = std::upper_bound(ends.begin(), ends.end(), u);
    const std::size_t i = std::min(static_cast<std::size_t>(found - ends.begin()), ends.size() - 1);
    return {static_cast<int>(i), ends[i] - (i == 0 ? 0.0f : ends[i - 1])};
}

}  // namespace aleph
