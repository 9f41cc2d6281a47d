#pragma once
// Drawing one light among many by its power.

#include <vector>

#include "render/lights.h"

namespace aleph {

/// LightSet::choice_ends.
std::vector<float> make_choice_ends(const ShadingScene& shading, const LightSet& lights);

/// A light chosen by LightSet::choice_ends.
struct LightChoice {
    int light = 0;
    float probability = 1.0f;
};
/// @param u  in [0,1)
LightChoice choose_at_random(const LightSet& lights, float u);

}  // namespace aleph
