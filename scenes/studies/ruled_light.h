#pragma once
// The indirect light of a frame at its pixel centres, from a cache whose radii follow a published rule. It is filled
// one record after the other, coarse pixels first, with the gathers of the renderer's own cache.

#include "scenes/studies/cached_light.h"
#include "scenes/studies/radius_rules.h"

namespace aleph {

/// @param accuracy  alpha, or for the rule `hessian` the bound over the square of the scene's radius
/// @param settings  its accuracy is not read; every value takes settings.gather rays
CachedLight compute_ruled_light(const StudyFrame& frame, const RenderSettings& settings, RadiusRule rule,
                                double accuracy);

}  // namespace aleph
