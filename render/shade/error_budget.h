#pragma once
// How much a pixel's samples may err, given what else errs in it.

#include "engine/base/viewing.h"
#include "render/guide/stopping_rule.h"
#include "render/pixels/outlines.h"
#include "render/settings/settings.h"
#include "render/shade/progressive.h"
#include "render/shade/sample_shading.h"

namespace aleph {

/// Errors that a viewer tolerates in a frame. Images have the frame's size.
struct VisibleLimits {
    const Image<float>& threshold;  ///< cd/m2 (6.9)
    const Image<float>& noise;      ///< cd/m2 (NoiseVisibility)
    const Image<float>& aleph;      ///< elevation of the threshold
    const Image<float>& accuracy;   ///< alpha, of cached light
    const Image<Outline>& outlines;
    ViewingConditions viewing;
};

/// The luminance that samples may err by, as they have it (before exposure).
/// threshold: allow_noise of RenderSettings::error, times what noise of single pixels goes unseen.
/// consecutive, variance: RenderSettings::error times the threshold.
/// The Aleph map is that of pixel centres. Beside the outline of a moving object, a pixel's samples may belong to
/// another surface than its centre, which moves less and is seen better. So a pixel there keeps to the strictest
/// threshold of the nine around it.
/// @return empty for rules that need none
Image<float> compute_sampling_tolerance(const VisibleLimits& limits, const RenderSettings& settings, double exposure);

/// @param limits  null: not known, which Sampling::uniform alone allows
SamplingPlan make_sampling_plan(const VisibleLimits* limits, const RenderSettings& settings, double exposure);

}  // namespace aleph
