#pragma once
// Sections 5.2 to 5.4 of Yee 2000 (perception/README.md), slow and direct, in double: every level is expanded step by
// step to full size, 48 maps are stored at full size, a flood fill visits every pixel. Shares no code with the library.

#include <array>
#include <vector>

#include "engine/base/color.h"
#include "engine/base/image.h"

namespace aleph {

using DoubleImage = Image<double>;

DoubleImage reference_low_pass(const DoubleImage& image);
DoubleImage reference_reduce(const DoubleImage& image);
DoubleImage reference_expand(const DoubleImage& image, int width, int height);

/// Levels 0 .. count-1.
std::vector<DoubleImage> reference_pyramid(const DoubleImage& image, int count);

/// Level `from` expanded step by step to the size of level 0.
DoubleImage reference_full_size(const std::vector<DoubleImage>& pyramid, int from);

/// (1 - m)^2 of N(.), or 0 where the range is not above `floor`.
double reference_weight(const DoubleImage& map, double floor);

struct ReferenceMaps {
    DoubleImage saliency, aleph;
    std::array<DoubleImage, 7> bands;  ///< R_i
    DoubleImage band_sum;              ///< sum of L(i) over max(|A0|, |A7|)
    bool fallback = false;
};

/// Printed bands, 31 pixels per degree, 30 frames per second, guide saliency.
ReferenceMaps reference_perception(const Image<Rgb>& estimate, const Image<float>& velocity);

}  // namespace aleph
