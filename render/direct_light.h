#pragma once
// Light that reaches a surface point straight from the lights.

#include "engine/base/sampling.h"
#include "render/bsdf.h"
#include "render/lights.h"
#include "render/ray_counts.h"

namespace aleph {

/// What shading needs of a posed scene, bundled.
struct LightingContext {
    const ShadingScene& shading;
    const LightSet& lights;
    const RayScene& rays;
};

/// Point i of n of a rank-1 lattice (golden ratio), shifted by `shift` modulo 1: even in both coordinates for any n.
glm::vec2 lattice_point(int i, int n, const glm::vec2& shift);

/// Which points on each light: those of part `part` of `parts`. With the same random numbers the parts together make
/// one lattice of count * parts points, and each of them is even by itself.
struct LightPoints {
    int count = 1;  ///< per part
    int part = 0;
    int parts = 1;

    glm::vec2 at(int i, const glm::vec2& shift) const { return lattice_point(i * parts + part, count * parts, shift); }
};

/// Outgoing radiance from direct light, without the surface's own emission. The Lambert layer samples lights; the
/// glossy layer combines light and visible-normal sampling by the power heuristic (Veach 1997). Unbiased.
/// @param view   unit, from the point towards the viewer
/// @param points  per light that has an area; of the glossy lobe as many
/// @param random  moved on by a fixed number of dimensions per call
Rgb compute_direct_light(const LightingContext& context, Tracer& tracer, const SurfacePoint& point,
                         const SurfaceMaterial& material, const glm::vec3& view, const LightPoints& points,
                         RandomStream& random, RayCounts& counts);

/// Direct light from a fixed pattern of points on each light: the same for every pixel, so that it holds no noise that
/// a model of vision would take for detail. Biased (penumbrae come in steps).
Rgb estimate_direct_light(const LightingContext& context, Tracer& tracer, const SurfacePoint& point,
                          const SurfaceMaterial& material, const glm::vec3& view, int samples, RayCounts& counts);

}  // namespace aleph
