#pragma once
// glTF's metallic-roughness surface as a Lambert layer under a GGX layer, split so that the Lambert part can be cached:
//   f = f_diffuse + f_glossy
//   f_diffuse = c/pi (1 - F(n.v)) (1 - F(n.l))   reciprocal; pure Lambert where KHR_materials_specular is 0
//   f_glossy  = F(v.h) D G2 / (4 n.v n.l)        GGX (Walter et al. 2007), height-correlated Smith (Heitz 2014)

#include "render/surface/surface_material.h"

namespace aleph {

/// Share of light that enters the Lambert layer at this cosine: 1 - F (Schlick 1994).
float diffuse_transmission(const SurfaceMaterial& material, float cosine);
/// Its cosine-weighted mean over the hemisphere: 1 - f0 - (f90 - f0) / 21.
float mean_diffuse_transmission(const SurfaceMaterial& material);

/// f_diffuse for the cosines of both directions with the shading normal.
Rgb evaluate_diffuse(const SurfaceMaterial& material, float cos_view, float cos_light);

/// How much of the light from a direction enters the Lambert layer through the gloss, over the mean over the
/// hemisphere; 1 where nothing enters.
float relative_transmission(const SurfaceMaterial& material, float cos_light);

/// Radiance of the Lambert layer at this cosine of the view.
/// @param irradiance  with the light of each direction times UpperLayers::entering. Plain irradiance is the same where
///                    light is uniform
Rgb diffuse_radiance(const SurfaceMaterial& material, float cos_view, const Rgb& irradiance);

/// F(v.h) of the glossy layer (Schlick 1994).
Rgb glossy_reflectance(const SurfaceMaterial& material, float cosine);

/// f_glossy in the shading frame (z is the normal, x the tangent of anisotropy) for unit directions; 0 if one is below
/// the surface, and for a mirror (SurfaceMaterial::is_mirror).
Rgb evaluate_glossy(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec3& light);
/// Visible-normal sampling (Heitz 2018): a direction for u in [0,1)^2. If its z is negative it contributes nothing.
/// A mirror's is the mirror direction.
glm::vec3 sample_glossy(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec2& u);
/// Density of sample_glossy per solid angle; 0 for a mirror.
float pdf_glossy(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec3& light);

/// Share of uniform light that a GGX lobe reflects to the viewer: the parts that are proportional to the reflectance
/// straight on and at grazing incidence.
struct AlbedoParts {
    float straight = 0.0f, grazing = 0.0f;
};

/// From a table; within .005.
/// @param cos_view  with the shading normal
AlbedoParts ggx_albedo(float alpha, float cos_view);
/// From so many samples.
AlbedoParts integrate_ggx_albedo(float alpha, float cos_view, int samples);

}  // namespace aleph
