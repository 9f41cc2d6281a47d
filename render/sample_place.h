#pragma once
// How the samples of a frame's pixels are placed.

#include "render/pixel_surfaces.h"
#include "render/settings.h"

namespace aleph {

/// Placing of sample `index` of the pixels. A single sample is the pixel's centre.
SamplePlace make_sample_place(const RenderSettings& settings, const CameraView& view, const Lens& lens, bool blended,
                              int index);

}  // namespace aleph
