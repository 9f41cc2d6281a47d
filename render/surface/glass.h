#pragma once
// A dielectric interface that light passes (KHR_materials_transmission): microfacets that reflect and refract (Walter
// et al. 2007). A mesh with a volume (KHR_materials_volume) refracts by its index of refraction; without one it is a
// thin sheet, which light leaves in the direction in which it came, spread by the roughness. Directions are unit, in
// the shading frame; the viewer's is above the surface.

#include "render/surface/surface_material.h"

namespace aleph {

/// f times the cosine of the light, and the density per steradian with which it is sampled.
struct LobeValue {
    Rgb f_cos{0.0f};
    float pdf = 0.0f;
};

/// Share of the light that an interface reflects.
/// @param cosine  of the view with the microfacet's normal
float glass_reflectance(const SurfaceMaterial& material, float cosine);

/// 0 for glass without roughness.
LobeValue evaluate_glass(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec3& light);

struct GlassSample {
    glm::vec3 light{0.0f};  ///< z < 0: passed
    Rgb weight{0.0f};       ///< f cos / density, of glass without roughness
};

/// @param side  in [0,1): below the reflectance, the light is reflected
GlassSample sample_glass(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec2& u, float side);

/// Share of light that a smooth sheet passes.
Rgb evaluate_sheet(const SurfaceMaterial& material, float cos_view);

}  // namespace aleph
