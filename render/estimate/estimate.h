#pragma once
// The quick estimate of a frame: a cheap picture for the model of vision. It is not part of the rendered frame.

#include "render/estimate/indirect_estimate.h"
#include "render/settings/settings.h"

namespace aleph {

struct EstimateOptions {
    EstimateKind kind = EstimateKind::direct;
    /// With `direct`: nodes of this view (gather_estimate), whose light of one bounce is added; may be null.
    const EstimateNodes* indirect = nullptr;
    double exposure = 1.0;
};

/// One sample at every pixel centre, from the frame's first hits. Exposure is applied; values that are not finite are
/// kept (perception/sanitize.h replaces them).
/// flat: albedo plus emission, as under constant white light; no rays.
/// direct: emission plus direct light from a fixed pattern of points per light (estimate_direct_light).
/// @param counts  increased by the rays cast
Image<Rgb> compute_estimate(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                            const EstimateOptions& options, RayCounts& counts);

/// Returns the radiance that an estimate shows for a surface, without indirect light and exposure.
/// @param task  its rays are those of Blend::cutout
Rgb estimate_radiance(const LightingContext& context, RayTask& task, const PixelSurface& surface, EstimateKind kind);

/// 0.18 / exp(mean log Y) over the pixels of an estimate with Y > 0; nothing if there are none.
std::optional<double> compute_exposure(const Image<Rgb>& estimate);

}  // namespace aleph
