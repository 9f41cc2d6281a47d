#pragma once
// What was found where pictures were checked by references (`aleph render --verify`).

#include <cstddef>
#include <optional>

namespace aleph {

/// An estimated share, 0 to 1, and the ends of its interval at 95 %.
struct VerifiedShare {
    double share = 0.0, low = 0.0, high = 1.0;
};

struct VerifiedStatistics {
    double error = 1.0;         ///< just visible differences: what was asked for
    VerifiedShare beyond;       ///< pixels that differ by more than that
    VerifiedShare seen;         ///< by at least one
    VerifiedShare flicker;      ///< the same, by what changes from frame to frame
    VerifiedShare lasting;      ///< and by what is the same in the frames around
    std::size_t blocks = 0;     ///< of pixels that were checked
    std::size_t frames = 0;     ///< that they are in
    std::size_t window = 1;     ///< frames that a block was judged over, at most
    std::size_t unsettled = 0;  ///< blocks whose reference was still noisy at the limit of its samples
    std::optional<double> estimated = std::nullopt;  ///< share of the pixels beyond, as rendering estimated it
    double seconds = 0.0;                            ///< that it took, of a clock
};

}  // namespace aleph
