#pragma once
// The share of pixels that are seen, from counts in blocks of them.

#include <span>

#include "render/output/frame_files.h"

namespace aleph {

/// Pixels of a block, and those that are counted.
struct BlockCount {
    double pixels = 0.0, counted = 0.0;
};

/// The 97.5th percentile of Student's t distribution.
/// @param freedom  degrees, 1 or more
double student_95(std::size_t freedom);

/// Blocks are clusters: pixels of one are alike. The interval is that of Student's t for the ratio of the blocks' sums
/// (Cochran 1977, 6.3), within 0 to 1. Few blocks may all have missed what is rare: by the rule of three up to 3 / n of
/// all blocks are of a kind that none of n is, so that the upper end is at least 3 / n of the largest share of a block;
/// where nothing was counted at all, of 1. In the same way the lower end is that of 3 / n of the blocks without any.
VerifiedShare estimate_share(std::span<const BlockCount> blocks);

}  // namespace aleph
