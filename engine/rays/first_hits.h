#pragma once
// First hits: the surface point Q(u,v,t) behind every pixel (Yee 2000, 5.1.2), found once and used by every stage.

#include <functional>

#include "engine/base/image.h"
#include "engine/pose/camera_view.h"
#include "engine/rays/ray_scene.h"

namespace aleph {

/// Casts one ray for every pixel of `hits`, in packets over blocks of neighbouring pixels. Hit::distance is in lengths
/// of the ray's direction.
/// @param make_ray  the ray of pixel (x, y), world; called from any thread
void cast_rays(const RayScene& scene, const std::function<CameraRay(int x, int y)>& make_ray, Blend blend,
               Image<Hit>& hits);

/// Casts the ray through the point (offset_x, offset_y) of every pixel; (.5, .5) is the centre. Blended
/// surfaces are holes where their alpha is below a half. Hit::distance is along a unit direction, m.
/// @param rays_cast  if given, increased by the number of rays
Image<Hit> cast_first_hits(const RayScene& scene, const CameraView& view, double offset_x = 0.5, double offset_y = 0.5,
                           std::uint64_t* rays_cast = nullptr);

}  // namespace aleph
