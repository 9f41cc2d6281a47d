#pragma once
// The coat and the sheen, and what they leave to the layers below: 1 - their albedo for the direction ("albedo
// scaling", Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks"). Symmetric in the directions of
// light and view, so that the surface is reciprocal:
//   the Lambert layer          t(v) t(l) / mean of t: under uniform light it has t(v) of its radiance
//   lobes that depend on view  the smaller of t(v) and t(l), as KHR_materials_sheen has it

#include "render/surface/surface_material.h"

namespace aleph {

inline constexpr float coat_f0 = 0.04f;  // KHR_materials_clearcoat: index of refraction 1.5

/// Reflectance of the coat's microfacets (Schlick 1994).
float coat_reflectance(const CoatLayer& coat, float cosine);

/// Share of uniform light that the coat reflects to the viewer, from a table: within 1.5e-3.
/// @param cosine  of the view with the coat's normal
float coat_albedo(const CoatLayer& coat, float cosine);

/// Directions are unit, in the world. On the far side of the surface they count as mirrored to the near side.
class UpperLayers {
  public:
    /// @param material  is referred to
    /// @param normal    the shading normal
    UpperLayers(const SurfaceMaterial& material, const glm::vec3& normal);

    /// Share of light along a direction that the coat leaves to what lies below.
    float below_coat(const glm::vec3& direction) const;
    /// Share that the coat and the sheen leave.
    float below_all(const glm::vec3& direction) const;
    /// below_all over its mean over what the Lambert layer takes.
    float relative(const glm::vec3& direction) const { return any_ ? below_all(direction) / mean_ : 1.0f; }
    /// How much of the light from a direction enters the Lambert layer, over the mean over the hemisphere:
    /// what irradiance for diffuse_radiance has to be weighed by.
    /// @param cosine  of the direction with the normal
    float entering(const glm::vec3& direction, float cosine) const;

  private:
    float left_by(float cos_coat, float cos_sheen) const;

    const SurfaceMaterial& material_;
    glm::vec3 normal_, coat_normal_;
    bool any_;
    float mean_ = 1.0f;
};

}  // namespace aleph
