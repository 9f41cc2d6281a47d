#pragma once
// The same point of a surface in another pose of the scene: light that was computed there belongs to it.

#include <optional>

#include "render/surface/shading_scene.h"

namespace aleph {

/// A surface point as it lies in another pose. Its place on the triangle and its side are the same. Its shading normal
/// turns with the triangle, so that normal maps and bent normals keep their effect.
/// @param to    the pose
/// @param hit   names the point
/// @param from  make_surface_point of the hit in the pose where it was found, perhaps with another shading normal
/// @return nothing if the surface is hidden in the pose `to`
std::optional<SurfacePoint> carry_point(const ShadingScene& to, const Hit& hit, const SurfacePoint& from);

}  // namespace aleph
