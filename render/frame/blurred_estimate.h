#pragma once
// The quick estimate as shutter and lens blur it: what a viewer sees. Contrast is lower there, and a silhouette that
// moves has the luminance of both sides.

#include <functional>

#include "render/estimate/estimate.h"
#include "render/shade/sample_shading.h"

namespace aleph {

/// A frame's quick estimate at the shutter's centre, through a pinhole.
struct SharpEstimate {
    const ShadingScene& shading;
    const CameraView& view;
    const SampleHits& centers;
    const Image<Rgb>& picture;
    const EstimateNodes* nodes;  ///< for the indirect light; null if there is none
    EstimateKind kind;
    double exposure;
};

/// Times and places on the lens that a blurred estimate is the mean of. They are the same in all pixels, so that the
/// estimate has no noise.
inline constexpr int blur_looks = 8;

/// At each of its times, every pixel shows a surface. Its light is read from the sharp estimate where that shows the
/// same point, and is computed elsewhere. So what does not move and is in focus keeps its values.
/// @param look    the scene at a place of the shutter, in [0,1], valid until the next call
Image<Rgb> blur_estimate(const SharpEstimate& sharp, const Lens& lens,
                         const std::function<SampleScene(double place)>& look, RayCounts& counts);

}  // namespace aleph
