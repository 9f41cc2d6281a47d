#pragma once
// Power of the lights: what each of them can bring to a point.

#include <cmath>
#include <span>
#include <vector>

#include "render/light/lights.h"

namespace aleph {

/// LightSet::bounds.
LightBounds make_light_bounds(const ShadingScene& shading, const LightSet& lights);

/// The lights as leaves of a tree. Textures are taken to be as bright as Emitter::brightest all over.
std::vector<LightNode> make_light_nodes(const ShadingScene& shading, const LightSet& lights);

/// About the illuminance that light i brings to a point without obstacles. Above 0 wherever the light can bring any.
/// Without branches, so that a loop over lights becomes vector instructions.
/// @param normal  unit, of the surface
/// @param behind  1 where light from behind the surface counts as well, else 0
inline float bound_illuminance(const LightBounds& lights, std::size_t i, const glm::vec3& position,
                               const glm::vec3& normal, float behind) {
    constexpr float least = 1e-3f;  // rounding must not exclude a light that brings a little
    const float nearby = lights.nearby[i], radius = lights.radius[i], strength = lights.strength[i];
    const float inside = lights.inside[i], one_sided = lights.one_sided[i];
    const float x = lights.x[i] - nearby * position.x, y = lights.y[i] - nearby * position.y,
                z = lights.z[i] - nearby * position.z;
    const float distance2 = x * x + y * y + z * z;
    const float inverse = 1.0f / std::sqrt(distance2);
    // The cosine at the light's centre, and more by what its size may add.
    const auto widen = [radius, inverse](float along) {
        const float wide = (along + radius) * inverse;
        const float enough = wide < least ? least : wide;
        return enough > 1.0f ? 1.0f : enough;
    };
    const float facing = widen(x * normal.x + y * normal.y + z * normal.z);
    const float shining = widen(-(x * lights.axis_x[i] + y * lights.axis_y[i] + z * lights.axis_z[i]));
    const float share = (behind > 0.0f ? 1.0f : facing) * (one_sided > 0.0f ? shining : 1.0f);
    const float outside = strength * share * (inverse * inverse);
    return distance2 <= 1.01f * (radius * radius) ? inside : outside;
}

/// That of the first lights.
/// @param weights  set; a multiple of LightBounds::step of them, as far as the lights' arrays reach
void bound_illuminances(const LightBounds& lights, const glm::vec3& position, const glm::vec3& normal, float behind,
                        std::span<float> weights);

}  // namespace aleph
