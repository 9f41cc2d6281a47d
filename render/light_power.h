#pragma once
// Choosing one light among many: by its power, and by what it can bring to a point.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "render/lights.h"

namespace aleph {

/// LightSet::choice_ends.
std::vector<float> make_choice_ends(const ShadingScene& shading, const LightSet& lights);

/// LightSet::bounds.
std::vector<LightBound> make_light_bounds(const ShadingScene& shading, const LightSet& lights);

/// About the illuminance that a light brings to a point without obstacles. Above 0 wherever the light can bring any.
/// @param normal  unit, of the surface
/// @param behind  light from behind the surface counts as well
inline float bound_illuminance(const LightBound& light, const glm::vec3& position, const glm::vec3& normal,
                               bool behind) {
    constexpr float least = 1e-3f;  // rounding must not exclude a light that brings a little
    if (light.reach == LightBound::Reach::everywhere) return light.strength;
    if (light.reach == LightBound::Reach::directional) {
        return light.strength * (behind ? 1.0f : std::max(least, glm::dot(light.axis, normal)));
    }
    const glm::vec3 to_light = light.position - position;
    const float distance2 = glm::dot(to_light, to_light), radius2 = light.radius * light.radius;
    if (distance2 <= 1.01f * radius2) return radius2 > 0.0f ? light.strength / radius2 : 0.0f;
    const float inverse = 1.0f / std::sqrt(distance2);
    // The cosine at the light's centre, and more by what its size may add.
    const auto widen = [&](float along) { return std::clamp((along + light.radius) * inverse, least, 1.0f); };
    float share = behind ? 1.0f : widen(glm::dot(to_light, normal));
    if (light.one_sided) share *= widen(-glm::dot(to_light, light.axis));
    return light.strength * share * (inverse * inverse);
}

/// A light chosen by LightSet::choice_ends.
struct LightChoice {
    int light = 0;
    float probability = 1.0f;
};
/// @param u  in [0,1)
LightChoice choose_at_random(const LightSet& lights, float u);

}  // namespace aleph
