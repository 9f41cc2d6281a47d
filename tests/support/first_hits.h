#pragma once

#include "engine/pose/posed_view.h"
#include "engine/rays/first_hits.h"

namespace aleph {

/// Casts the ray through the point (offset_x, offset_y) of every pixel; (.5, .5) is the centre. Blended surfaces are
/// holes where their alpha is below a half. Hit::distance is along a unit direction, m.
inline Image<Hit> cast_first_hits(const RayScene& scene, const CameraView& view, double offset_x = 0.5,
                                  double offset_y = 0.5) {
    Image<Hit> hits(view.width, view.height);
    const auto ray_of = [&](int x, int y) { return make_camera_ray(view, x + offset_x, y + offset_y); };
    cast_rays(scene, ray_of, Blend::cutout, hits);
    return hits;
}

inline Image<Hit> cast_first_hits(const Scene& scene, const PosedView& posed) {
    RayScene rays(scene);
    rays.update(posed.pose, compute_anchor(posed.view));
    return cast_first_hits(rays, posed.view);
}

}  // namespace aleph
