#pragma once
// Reconstruction filters: how the light around a pixel's centre makes up the pixel.

namespace aleph {

enum class PixelFilter {
    box,              ///< the pixel's square
    blackman_harris,  ///< smooth, 3 pixels wide; less aliasing than the box at edges and fine detail
};

/// Where a sample lies along x or y, in pixels from the pixel's centre: distributed like the filter (filter importance
/// sampling, Ernst et al. 2006), so that every sample counts the same and belongs to one pixel alone.
/// @param u  uniform in [0,1)
double place_in_filter(PixelFilter filter, double u);

}  // namespace aleph
