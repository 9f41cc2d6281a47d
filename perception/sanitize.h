#pragma once
// Makes an estimate finite, not negative, and free of fireflies: one of them could outweigh the rest of the frame.

#include <cstdint>

#include "engine/base/color.h"
#include "engine/base/image.h"

namespace aleph {

struct SanitizeCounts {
    std::uint64_t replaced = 0;  ///< pixels with NaN or infinity: they get the median of their valid neighbours
    std::uint64_t clamped = 0;   ///< fireflies: they are scaled down to 10 times the 99.9 % quantile of luminance
};

/// Works in place. Negative values become 0. Holes fill from their rim inwards; a frame without a valid pixel becomes
/// black. If the 99.9 % quantile is 0, that of the pixels above 0 is used. In frames of fewer than 1000 pixels it is
/// the maximum: nothing is clamped.
SanitizeCounts sanitize_estimate(Image<Rgb>& estimate);

}  // namespace aleph
