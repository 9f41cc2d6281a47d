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

/// @param hit          of a surface that is_plain_lambert
/// @param direction    of the ray that hit it, unit
/// @param solid_angle  that the ray represents, sr
LambertHit make_lambert_hit(const ShadingScene& shading, const Hit& hit, const glm::vec3& direction, float solid_angle);

}  // namespace aleph
