#pragma once
// The volumes that a path is in (KHR_materials_volume).

#include <array>

#include "render/surface/surface_material.h"

namespace aleph {

/// Media around a ray: meshes with a volume (KHR_materials_volume) that it has entered, the innermost last.
class Media {
  public:
    struct Medium {
        int material = no_index;
        float ior = 1.0f;
        Rgb attenuation{0.0f};  ///< 1/m
    };

    /// 1 outside of all.
    float ior() const { return size_ == 0 ? 1.0f : stack_[size_ - 1].ior; }
    /// 1/m, of the innermost; 0 outside.
    Rgb attenuation_inside() const;
    /// 1/m, of the ray that ends at this surface. If no mesh was entered and the surface is met from inside, the ray
    /// started inside: the camera is in the glass.
    Rgb attenuation(const ViewedSurface& end) const;
    /// Index of refraction of the far side over the viewer's side, at a surface with a volume.
    float ratio_at(const ViewedSurface& surface) const;
    /// Goes through a surface with a volume, by the side that was hit.
    void pass(const ViewedSurface& surface);

  private:
    int find(int material) const;

    std::array<Medium, 4> stack_{};  ///< deeper nesting than this is ignored
    int size_ = 0;
};

}  // namespace aleph
