#pragma once
// The part of a surface that one ray represents. Textures are averaged over it.

#include "engine/pose/camera_view.h"
#include "render/surface/shading_scene.h"
#include "render/surface/texture.h"

namespace aleph {

/// Part of a surface around a point. If all values are zero, textures are read at the point itself.
struct RayFootprint {
    /// m, world: from this camera ray's point to its neighbours' points. The part is the parallelogram that they span.
    glm::vec3 dx{0.0f}, dy{0.0f};
    float width = 0.0f;  ///< m; for rays over a hemisphere or a light: side of a square of the ray's share of the area
    bool whole_pixel = false;  ///< no other ray shows the pixel
};

/// The footprint of a camera ray, from the points where the rays of neighbouring samples meet the tangent plane
/// (exact).
/// @param distance  along the ray, m
/// @param spacing  of the samples, pixels: 1 / sqrt(samples per pixel)
RayFootprint make_pixel_footprint(const CameraView& view, const SurfacePoint& point, const glm::vec3& direction,
                                  float distance, float spacing);

/// The footprint, where it meets a surface at a distance (m), of a ray that represents a solid angle (sr).
RayFootprint make_cone_footprint(const SurfacePoint& point, const glm::vec3& direction, float distance,
                                 float solid_angle);

/// Its area, m2.
/// @param cosine  between the ray and the true normal, at least 0
float cone_footprint_area(float cosine, float distance, float solid_angle);

/// The footprint in one of the surface's sets of texture coordinates.
UvFootprint make_uv_footprint(const SurfacePoint& point, const RayFootprint& footprint, int uv_set);

}  // namespace aleph
