#pragma once
// From sums of samples to images.

#include "render/cache/irradiance_cache.h"
#include "render/pixels/pixel_samples.h"
#include "render/pixels/shaded_frame.h"

namespace aleph {

/// Fills colour, coverage and numbers of samples.
/// @param exposure       factor on light
/// @param with_indirect  fills ShadedFrame::indirect
/// @param with_variance  fills ShadedFrame::variance
void resolve_pixels(const Image<PixelSamples>& pixels, double exposure, bool with_indirect, bool with_variance,
                    ShadedFrame& out);

/// Only the number of samples, for a picture that nobody sees.
void count_samples(const Image<PixelSamples>& pixels, ShadedFrame& out);

/// Fills the images of the records that were used.
void resolve_uses(const Image<RecordUse>& uses, const Image<PixelSamples>& pixels, ShadedFrame& out);

}  // namespace aleph
