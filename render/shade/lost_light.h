#pragma once
// Light that the means of pixels lost when further samples were taken because of the first ones.

#include "engine/base/image.h"
#include "render/pixels/pixel_samples.h"

namespace aleph {

/// Gives what the means of pixels have lost since they were kept to the pixels around that show the same object, the
/// pixel itself too, in equal parts; what they have gained is taken from these in proportion to their light. The light
/// of the picture is then what decisions without own samples leave, and a rare bright sample is no longer one bright
/// pixel. Pixels that show nothing but the background change only because of such pixels.
/// @param reach  pixels on either side
void spread_lost_light(Image<PixelSamples>& pixels, int reach);

}  // namespace aleph
