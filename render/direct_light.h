#pragma once
// Light that reaches a surface point straight from the lights.

#include "engine/base/sampling.h"
#include "render/bsdf.h"
#include "render/lattice.h"
#include "render/lights.h"
#include "render/ray_task.h"

namespace aleph {

/// The parts of a posed scene that shading needs.
struct LightingContext {
    const ShadingScene& shading;
    const LightSet& lights;
    const RayScene& rays;
};

/// The points on each light: part `part` of `parts`. With the same shift, all parts together are one lattice of
/// count * parts points, and each part is even by itself.
struct LightPoints {
    int count = 1;  ///< per part
    int part = 0;
    int parts = 1;

    glm::vec2 at(int i, const glm::vec2& shift) const { return lattice_point(i * parts + part, count * parts, shift); }
};

/// Outgoing radiance from direct light, without the surface's own emission. The Lambert layer samples lights; the
/// glossy layer combines light and visible-normal sampling by the power heuristic (Veach 1997). Unbiased.
/// @param points  per light that has an area, and as many samples of the glossy lobe
/// @param random  moved on by a fixed number of dimensions per call
Rgb compute_direct_light(const LightingContext& context, RayTask& task, const ViewedSurface& surface,
                         const LightPoints& points, RandomStream& random);

/// Direct light from a fixed pattern of points on each light. The pattern is the same for every pixel, so the result
/// has no noise that the model of vision would take for detail. Biased: penumbrae come in steps, and narrow highlights
/// are widened.
/// @param samples  per light that has an area
Rgb estimate_direct_light(const LightingContext& context, RayTask& task, const ViewedSurface& surface, int samples);

}  // namespace aleph
