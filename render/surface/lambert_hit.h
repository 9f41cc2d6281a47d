#pragma once
// The little that a gather ray needs of a pure Lambert surface, without the rest of SurfacePoint and SurfaceMaterial.

#include "render/surface/shading_scene.h"

namespace aleph {

struct LambertHit {
    glm::vec3 position{0.0f};   ///< m, relative to the anchor, along the ray: less exact than that of a SurfacePlace
    glm::vec3 geometric{0.0f};  ///< unit, towards the viewer
    Rgb albedo{0.0f};           ///< averaged over the footprint
};

/// Fetches what make_surface_place will read of the mesh into the cache: first the triangle, some hits later its
/// corners.
void prefetch_triangle(const ShadingScene& shading, const Hit& hit);
void prefetch_corners(const ShadingScene& shading, const Hit& hit);

/// The mesh is read only for textures and vertex colours.
/// @param hit          of a surface that is plain_lambert
/// @param normal       of the hit (Tracer::intersect)
LambertHit make_lambert_hit(const ShadingScene& shading, const Ray& ray, const Hit& hit, const glm::vec3& normal,
                            float solid_angle);

}  // namespace aleph
