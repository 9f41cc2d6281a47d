#pragma once
// How much of a surface one ray stands for, so that textures are averaged over it instead of met at a point.

#include "engine/pose/camera_view.h"
#include "render/shading_scene.h"
#include "render/texture.h"

namespace aleph {

/// Part of a surface around a point. With all zero, textures are read at the point itself.
struct RayFootprint {
    /// m, world: how the point moves from one camera ray to its neighbours. The part is the parallelogram they span.
    glm::vec3 dx{0.0f}, dy{0.0f};
    float width = 0.0f;  ///< m; of a ray that is one of many: the side of a square of its share's area
};

/// The footprint of a camera ray: exact derivatives of where the rays of neighbouring samples meet the tangent plane.
/// @param distance  along the ray, m
/// @param spacing  of the samples, pixels: 1 / sqrt(samples per pixel)
RayFootprint make_pixel_footprint(const CameraView& view, const SurfacePoint& point, const glm::vec3& direction,
                                  float distance, float spacing);

/// The footprint of a ray that stands for `solid_angle`, where it meets a surface.
RayFootprint make_cone_footprint(const SurfacePoint& point, const glm::vec3& direction, float distance,
                                 float solid_angle);

/// The footprint in one of the surface's sets of texture coordinates.
UvFootprint make_uv_footprint(const SurfacePoint& point, const RayFootprint& footprint, int uv_set);

}  // namespace aleph
