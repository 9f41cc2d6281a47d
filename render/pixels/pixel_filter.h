#pragma once
// Reconstruction filters: how the light around a pixel's centre makes up the pixel.

#include "render/settings/settings.h"

namespace aleph {

/// Where a sample lies along x or y, in pixels from the pixel's centre: distributed like the filter (filter importance
/// sampling, Ernst et al. 2006), so that every sample counts the same and belongs to one pixel alone.
/// @param u  uniform in [0,1)
double place_in_filter(PixelFilter filter, double u);

}  // namespace aleph
