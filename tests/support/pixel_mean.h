#pragma once

#include <gtest/gtest.h>

#include "render/shade/frame.h"
#include "tests/support/mean.h"

namespace aleph {

/// The mean of the red of all pixels, none of which may be invalid.
inline Mean mean_of_pixels(const ShadedFrame& frame) {
    EXPECT_EQ(frame.counts.invalid_samples, 0u);
    Mean mean;
    for (const Rgb& pixel : frame.color.pixels) mean.add(pixel.x);
    return mean;
}

}  // namespace aleph
