#pragma once
// The sheen of cloth (KHR_materials_sheen): Charlie's distribution (Estevez and Kulla 2017, "Production Friendly
// Microfacet Sheen BRDF") with the visibility term of Neubelt and Pettineo 2013.

#include <glm/vec3.hpp>

namespace aleph {

/// The layer's BRDF without its colour, for unit directions in the shading frame; 0 if one is below the surface.
/// @param alpha  roughness squared, at least min_sheen_alpha
float evaluate_sheen(float alpha, const glm::vec3& view, const glm::vec3& light);
inline constexpr float min_sheen_alpha = 1e-3f;

/// Its directional albedo, from a table: by at most 0.004 times the larger of 1 and itself too large, and by at most
/// 5e-4 times that too small. This visibility term lets it exceed 1, up to 13 at grazing angles and low roughness;
/// there the layer has to be scaled down. Arguments out of range count as the nearest in range, no number as the
/// lowest.
float sheen_albedo(float alpha, float cos_view);

/// evaluate_sheen over the largest of 1 and its albedos for both directions: reciprocal, and adds no light.
float evaluate_sheen_layer(float alpha, const glm::vec3& view, const glm::vec3& light);
/// Directional albedo of that, from a table as sheen_albedo.
float sheen_layer_albedo(float alpha, float cos_view);

}  // namespace aleph
