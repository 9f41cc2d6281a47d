#pragma once
// The volumes that a path is in (KHR_materials_volume).

#include <array>

#include "render/surface/ray_task.h"
#include "render/surface/surface_material.h"

namespace aleph {

/// Share of light that is left on its way through a medium (Beer-Lambert): 1/m, and m, which may be infinite.
Rgb transmit(const Rgb& attenuation, float distance);

/// Media around a ray: meshes with a volume (KHR_materials_volume) that it has entered, the innermost last.
class Media {
  public:
    struct Medium {
        int material = no_index;
        float ior = 1.0f;
        Rgb attenuation{0.0f};  ///< 1/m
    };

    bool is_empty() const { return size_ == 0; }
    /// 1 outside of all.
    float ior() const { return size_ == 0 ? 1.0f : stack_[size_ - 1].ior; }
    /// 1/m, of the innermost; 0 outside.
    Rgb attenuation_inside() const;
    /// 1/m, of the ray that ends at this surface. If no mesh was entered and the surface is met from inside, the ray
    /// started inside.
    Rgb attenuation(const SurfacePoint& end, const SurfaceMaterial& material) const;
    /// 1/m, of a ray that leaves the surface in a direction: behind it, of the medium there.
    Rgb attenuation_towards(const glm::vec3& direction, const SurfacePoint& start,
                            const SurfaceMaterial& material) const;
    /// Index of refraction of the far side over the viewer's side, at a surface with a volume.
    float ratio_at(const ViewedSurface& surface) const;
    /// Goes through a surface with a volume, by the side that was hit.
    void pass(const SurfacePoint& surface, const SurfaceMaterial& material);
    /// Adds the innermost medium.
    void enter(const SurfacePoint& surface, const SurfaceMaterial& material);
    /// Adds the outermost one.
    void enclose(const SurfacePoint& surface, const SurfaceMaterial& material);
    /// Removes a medium. @return whether it was there
    bool leave(int material);

  private:
    int find(int material) const;

    std::array<Medium, 4> stack_{};  ///< deeper nesting than this is ignored
    int size_ = 0;
};

/// The media that the origin of a ray is in: volumes whose back the ray meets before their front. Their meshes have to
/// be closed, or to lie before the whole sky as a sheet of water does.
/// @param counts  increased by the rays cast: none in a scene without volumes
Media find_media(const ShadingScene& shading, Tracer& tracer, Ray ray, std::uint64_t& counts);

}  // namespace aleph
