#pragma once
// First hits: the surface point Q(u,v,t) behind every pixel (Yee 2000, 5.1.2), found once and used by every stage.

#include <functional>

#include "engine/base/image.h"
#include "engine/pose/camera_view.h"
#include "engine/rays/ray_scene.h"

namespace aleph {

/// The same ray, relative to the scene's anchor.
inline Ray to_scene(const RayScene& scene, const CameraRay& ray) {
    return {.origin = glm::vec3(ray.origin - scene.anchor()),
            .direction = glm::vec3(ray.direction),
            .near = ray.near,
            .choice = ray.choice};
}

/// Casts one ray for every pixel of `hits`, in packets over blocks of neighbouring pixels.
/// @param make_ray  the ray of pixel (x, y), world; called from any thread
void cast_rays(const RayScene& scene, const std::function<CameraRay(int x, int y)>& make_ray, Blend blend,
               Image<Hit>& hits);

}  // namespace aleph
