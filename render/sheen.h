#pragma once
// The sheen of cloth (KHR_materials_sheen): Charlie's distribution (Estevez and Kulla 2017, "Production Friendly
// Microfacet Sheen BRDF") with the visibility term of Neubelt and Pettineo 2013.

#include <glm/vec3.hpp>

namespace aleph {

/// The layer's BRDF without its colour, for unit directions in the shading frame; 0 if one is below the surface.
/// @param alpha  roughness squared, at least 1e-3
float evaluate_sheen(float alpha, const glm::vec3& view, const glm::vec3& light);

/// Its directional albedo, from a table of 32 x 32; within 0.01. At most 1.
float sheen_albedo(float alpha, float cos_view);

}  // namespace aleph
