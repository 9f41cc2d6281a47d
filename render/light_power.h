#pragma once
// Choosing one light among many: by its power, and by what it can bring to a point.

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
float bound_illuminance(const LightBound& light, const glm::vec3& position, const glm::vec3& normal, bool behind);

/// A light chosen by LightSet::choice_ends.
struct LightChoice {
    int light = 0;
    float probability = 1.0f;
};
/// @param u  in [0,1)
LightChoice choose_at_random(const LightSet& lights, float u);

}  // namespace aleph
