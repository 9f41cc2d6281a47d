#pragma once
// From sums of samples to images.

#include "render/cache/irradiance_cache.h"
#include "render/pixels/outlines.h"
#include "render/pixels/pixel_samples.h"
#include "render/pixels/shaded_frame.h"

namespace aleph {

/// Gives what the means of pixels have lost since they were kept to the pixels around that show the same object, the
/// pixel itself too, in equal parts; what they have gained is taken from these in proportion to their light. The light
/// of the picture is then what decisions without own samples leave, and a rare bright sample is no longer one bright
/// pixel. Pixels that show nothing but the background change only because of such pixels. A channel that
/// is shown as white has lost nothing that is seen. Pixels with an outline share among themselves, whatever their
/// objects: what they lose may be light of another object, and which one their first samples saw is chance.
/// @param outlines  empty: none has one
/// @param reach  pixels on either side
/// @param white  radiance that the display shows as white
void spread_lost_light(Image<PixelSamples>& pixels, const Image<Outline>& outlines, int reach, double white);

/// Fills colour, coverage and numbers of samples.
void resolve_pixels(const Image<PixelSamples>& pixels, double exposure, bool with_indirect, bool with_variance,
                    ShadedFrame& out);

/// Only the number of samples, for a picture that nobody sees.
void count_samples(const Image<PixelSamples>& pixels, ShadedFrame& out);

/// Fills the images of the records that were used.
void resolve_uses(const Image<RecordUse>& uses, const Image<PixelSamples>& pixels, ShadedFrame& out);

}  // namespace aleph
