#pragma once
// Makes an estimate fit for the model: finite, not negative, without fireflies (HARD_CASES PY-05 to PY-07).

#include <cstdint>

#include "engine/base/color.h"
#include "engine/base/image.h"

namespace aleph {

struct SanitizeCounts {
    std::uint64_t replaced = 0;  ///< pixels with NaN or infinity: the median of their valid neighbours instead
    std::uint64_t clamped = 0;   ///< fireflies: scaled down to 10 x the 99.9 % quantile of luminance
};

/// In place. Negative values become 0. Holes of more than one pixel fill from their rim inwards; a frame without any
/// valid pixel becomes black. Where most of the frame is black, so that its 99.9 % quantile is 0, the quantile of the
/// pixels above 0 stands in; under 1000 pixels the nearest rank is the maximum and nothing is clamped.
SanitizeCounts sanitize_estimate(Image<Rgb>& estimate);

}  // namespace aleph
