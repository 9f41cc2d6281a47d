#pragma once
// The little that a gather ray needs of a pure Lambert surface, without the rest of SurfacePoint and SurfaceMaterial.

#include "render/shading_scene.h"

namespace aleph {

/// A surface that scatters by its Lambert layer alone, and whose normals no map changes.
bool is_plain_lambert(const ShadingScene& shading, int material);

struct LambertHit {
    glm::vec3 position{0.0f};   ///< m, relative to the anchor
    glm::vec3 geometric{0.0f};  ///< unit, towards the viewer
    Rgb albedo{0.0f};           ///< averaged over the footprint
};

/// Fetches what make_lambert_hit will read of the mesh into the cache: first the triangle, some hits later its corners.
void prefetch_triangle(const ShadingScene& shading, const Hit& hit);
void prefetch_corners(const ShadingScene& shading, const Hit& hit);

/// Sets every member of `met`, in place: a copy read at once would wait for the writes, and with them for the mesh's
/// data, hit by hit.
/// @param hit          of a surface that is_plain_lambert
/// @param direction    of the ray that hit it, unit
/// @param solid_angle  that the ray represents, sr
void make_lambert_hit(const ShadingScene& shading, const Hit& hit, const glm::vec3& direction, float solid_angle,
                      LambertHit& met);

}  // namespace aleph
