#pragma once
// Power of the lights: what each of them can bring to a point.

#include <span>
#include <vector>

#include "render/light/lights.h"

namespace aleph {

/// LightSet::bounds.
LightBounds make_light_bounds(const ShadingScene& shading, const LightSet& lights);

/// The lights as leaves of a tree. Textures are taken to be as bright as Emitter::brightest all over.
std::vector<LightNode> make_light_nodes(const ShadingScene& shading, const LightSet& lights);

/// About the illuminance that each of the first lights brings to a point without obstacles. Above 0 wherever the light
/// can bring any.
/// @param weights  set; a multiple of LightBounds::step of them, as far as the lights' arrays reach
void bound_illuminances(const LightBounds& lights, const Receiver& receiver, std::span<float> weights);

}  // namespace aleph
