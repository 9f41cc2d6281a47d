#pragma once
// The quick estimate of a frame: the cheap picture that the model of vision looks at, never part of the result.

#include "render/direct_light.h"
#include "render/pixel_surfaces.h"
#include "render/settings.h"

namespace aleph {

/// One sample at every pixel centre, from the frame's own first hits. Not sanitized; exposure applied.
/// flat: albedo plus emission, as under constant white light; no rays.
/// direct: emission plus direct light from a fixed pattern of points per light (estimate_direct_light).
Image<Rgb> compute_estimate(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                            EstimateKind kind, double exposure, RayCounts& counts);

/// .18 / exp(mean log Y) over the pixels with Y > 0 of an estimate; 1 where there are none.
double compute_exposure(const Image<Rgb>& estimate);

}  // namespace aleph
