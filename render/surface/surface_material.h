#pragma once
// The material of a surface point: the scene's values with textures applied. bsdf.h has the reflection of each layer,
// scatter.h all of them together.

#include <algorithm>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/base/color.h"
#include "render/surface/microfacets.h"
#include "render/surface/shading_scene.h"
#include "render/surface/texture.h"

namespace aleph {

/// The glossy layer.
struct GlossyLayer {
    Rgb f0{0.0f};      ///< reflectance at normal incidence
    float f90 = 0.0f;  ///< reflectance at grazing incidence
    /// Largest channel of the dielectric f0, and the reflectance at grazing incidence: light that does not reach the
    /// Lambert layer.
    float f0_max = 0.0f, f90_max = 0.0f;
    float alpha = 1.0f;       ///< GGX width: roughness squared
    float stretch = 0.0f;     ///< anisotropy: widens the lobe along `tangent` from alpha towards 1
    glm::vec3 tangent{0.0f};  ///< world, unit, if stretch > 0
};

/// The part of the surface that is a clear dielectric interface, with the microfacets of the glossy layer.
struct GlassLayer {
    float share = 0.0f;     ///< of the surface
    Rgb tint{1.0f};         ///< of the light that passes it
    float specular = 1.0f;  ///< factor on its reflectance (KHR_materials_specular)
    float ior = 1.5f;
    bool volume = false;     ///< light that passes refracts, into what the mesh encloses; else the surface is a sheet
    float ior_ratio = 1.5f;  ///< index of refraction of the far side over that of the viewer's side
    Rgb attenuation{0.0f};   ///< of the volume, 1/m
};

struct SheenLayer {
    Rgb color{0.0f};
    float alpha = 1.0f;  ///< its width
};

/// The clear coat.
struct CoatLayer {
    float strength = 0.0f;
    float alpha = 0.0f;      ///< GGX width
    glm::vec3 normal{0.0f};  ///< world, unit; 0: as the surface's shading normal
};

/// The layers, from below: Lambert and glass side by side, the glossy layer, sheen, coat.
struct SurfaceMaterial {
    Rgb diffuse{0.0f};   ///< albedo of the Lambert layer
    Rgb emission{0.0f};  ///< radiance that leaves the visible side
    GlossyLayer gloss{};
    GlassLayer glass{};
    SheenLayer sheen{};
    CoatLayer coat{};

    bool has_diffuse() const { return diffuse != Rgb(0.0f); }
    bool has_glossy() const { return gloss.f90 > 0.0f || gloss.f0 != Rgb(0.0f); }
    bool has_coat() const { return coat.strength > 0.0f; }
    bool has_sheen() const { return sheen.color != Rgb(0.0f); }
    bool has_glass() const { return glass.share > 0.0f; }
    /// Returns whether anything but the Lambert layer scatters light.
    bool has_specular() const { return has_glossy() || has_glass() || has_coat() || has_sheen(); }
    /// Returns whether the glossy layer is smooth to single precision, along the tangent too.
    bool is_mirror() const { return stretched_width() < min_ggx_alpha; }
    bool is_coat_mirror() const { return coat.alpha < min_ggx_alpha; }
    /// Glass without microfacets: smooth, or between equal media, where nothing turns.
    bool is_glass_smooth() const { return is_mirror() || glass.ior_ratio == 1.0f; }
    /// Returns whether light passes it without a turn: a smooth sheet.
    bool passes_straight() const { return has_glass() && !glass.volume && is_glass_smooth(); }
    /// Returns whether a rough gloss scatters all that it scatters.
    bool is_gloss_alone() const {
        return has_glossy() && !is_mirror() && !has_diffuse() && !has_coat() && !has_sheen() && !has_glass();
    }
    /// GGX widths along the tangent and across it (KHR_materials_anisotropy), unless it is a mirror.
    glm::vec2 widths() const { return {stretched_width(), std::max(gloss.alpha, min_ggx_alpha)}; }
    /// Along the tangent.
    float stretched_width() const { return gloss.alpha + (1.0f - gloss.alpha) * gloss.stretch; }
};

/// A surface point as it is shaded.
struct ViewedSurface {
    SurfacePoint point;
    SurfaceMaterial material;
    glm::vec3 view{0.0f};  ///< unit, towards the viewer
};

/// Textures are averaged over the footprint. Normal maps are left out: view_surface applies them. An unlit material
/// (KHR_materials_unlit) shows its base colour as radiance from both sides, reflects nothing and is not a light: only
/// camera rays see it.
SurfaceMaterial evaluate_material(const ShadingScene& shading, const SurfacePoint& point,
                                  const RayFootprint& footprint);

/// The material as paths see it that a Lambert layer turned: lobes have at least the scene's caustic_width, so that
/// light which a mirror or a narrow lobe sends from a small lamp to a diffuse surface is found by sampling the lamp,
/// and not by chance (Kaplanyan and Dachsbacher 2013, "Path Space Regularization for Holistic and Robust Light
/// Transport"). Smooth sheets of glass still pass light straight, and from inside glass lobes stay narrow near and
/// beyond the critical angle. Without caustics there are no lobes.
void blur_caustics(const ShadingScene& shading, ViewedSurface& surface);

/// SurfaceMaterial::emission of a material that is not unlit.
Rgb surface_emission(const ShadingScene& shading, const SurfacePoint& point, const RayFootprint& footprint);
/// The texture that emission is multiplied by; white without one.
Rgb emission_texel(const ShadingScene& shading, const SurfacePoint& point, const RayFootprint& footprint);

/// Share of the rays to the footprint that the surface stops: less than 1 where a mask or blending lets some pass
/// (Blend::random).
float surface_coverage(const ShadingScene& shading, const SurfacePoint& point, const RayFootprint& footprint);

/// The surface with its material and the normals that the normal maps give. Where a lobe depends on the view,
/// interpolated normals too pass keep_visible: at a silhouette they may face away from the viewer, and the lobe would
/// be black.
/// @param view  unit, towards the viewer
ViewedSurface view_surface(const ShadingScene& shading, const SurfacePoint& point, const glm::vec3& view,
                           const RayFootprint& footprint);

/// A normal between `normal` and `fallback` (both unit) as near as possible to `normal`, for which both the viewer and
/// the mirror direction are above the true surface, so that no light comes from behind it.
/// @param geometric  unit, on the viewer's side
glm::vec3 keep_visible(const glm::vec3& normal, const glm::vec3& fallback, const glm::vec3& geometric,
                       const glm::vec3& view);

}  // namespace aleph
