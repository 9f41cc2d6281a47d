#pragma once
// glTF's metallic-roughness surface as a Lambert layer under a GGX layer, split so that the Lambert part can be cached:
//   f = f_diffuse + f_glossy
//   f_diffuse = c/pi (1 - F(n.v)) (1 - F(n.l))   reciprocal; pure Lambert where KHR_materials_specular is 0
//   f_glossy  = F(v.h) D G2 / (4 n.v n.l)        GGX (Walter et al. 2007), height-correlated Smith (Heitz 2014)

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/base/color.h"
#include "render/shading_scene.h"
#include "render/texture_footprint.h"

namespace aleph {

/// The material of one surface point, with texture values applied.
struct SurfaceMaterial {
    Rgb diffuse{0.0f};    ///< albedo of the Lambert layer
    Rgb f0{0.0f};         ///< reflectance of the glossy layer at normal incidence
    float f90 = 0.0f;     ///< reflectance of the glossy layer at grazing incidence
    float f0_max = 0.0f;  ///< largest channel of the dielectric f0: light that does not reach the Lambert layer
    float alpha = 1.0f;   ///< GGX width, roughness squared, at least 1e-3
    Rgb emission{0.0f};   ///< radiance that leaves the visible side
    bool has_diffuse() const { return diffuse != Rgb(0.0f); }
    bool has_glossy() const { return f90 > 0.0f || f0 != Rgb(0.0f); }
};

/// A surface point as it is shaded.
struct ViewedSurface {
    SurfacePoint point;
    SurfaceMaterial material;
    glm::vec3 view{0.0f};  ///< unit, towards the viewer
};

/// Textures are averaged over the footprint. An unlit material (KHR_materials_unlit) shows its base colour as radiance
/// from both sides, reflects nothing and is not a light: only camera rays see it.
SurfaceMaterial evaluate_material(const ShadingScene& shading, const SurfacePoint& point,
                                  const RayFootprint& footprint);

/// Share of light that enters the Lambert layer at this cosine: 1 - F (Schlick 1994).
float diffuse_transmission(const SurfaceMaterial& material, float cosine);
/// Its cosine-weighted mean over the hemisphere: 1 - f0 - (f90 - f0) / 21.
float mean_diffuse_transmission(const SurfaceMaterial& material);

/// f_diffuse for the cosines of both directions with the shading normal.
Rgb evaluate_diffuse(const SurfaceMaterial& material, float cos_view, float cos_light);

/// Radiance of the Lambert layer for an irradiance E at this cosine of the view. Exact for uniform incoming light.
Rgb diffuse_radiance(const SurfaceMaterial& material, float cos_view, const Rgb& irradiance);

/// f_glossy in the shading frame (z is the normal) for unit directions; 0 if one is below the surface.
Rgb evaluate_glossy(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec3& light);
/// Visible-normal sampling (Heitz 2018): a direction for u in [0,1)^2. If its z is negative it contributes nothing.
glm::vec3 sample_glossy(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec2& u);
/// Density of sample_glossy per solid angle.
float pdf_glossy(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec3& light);

}  // namespace aleph
