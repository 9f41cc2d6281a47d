#pragma once
// Which channels of two pictures are compared with each other.

#include <cmath>
#include <string>
#include <vector>

#include "engine/image/image_file.h"

namespace aleph {

/// One channel of both pictures, of one size.
struct ChannelPair {
    std::string name;
    const Image<float>* a;
    const Image<float>* b;
};

/// The channels that are compared, in the order of b. `variance.Y` and `error.*` say how certain a picture is and are
/// compared only if they are named. `samples.Y`, `records.Y`, `invalid.Y`, `cache.count` and `cache.radius` say how a
/// picture was made: they are left out if only one picture has them.
/// @param wanted  channels ("Z") or layers ("forward"); empty: all
/// @throws InputError if sizes or channels differ, or a wanted channel is not in both
std::vector<ChannelPair> match_channels(const ChannelImage& a, const ChannelImage& b,
                                        const std::vector<std::string>& wanted);

/// R, G and B among the pairs, in this order; empty if one is missing.
std::vector<ChannelPair> colour_pairs(const std::vector<ChannelPair>& pairs);

/// Calls visit(i, a, b) for the finite values of a pair.
template <class Visit>
void for_finite(const ChannelPair& pair, const Visit& visit) {
    for (std::size_t i = 0; i < pair.a->size(); ++i) {
        const double a = pair.a->pixels[i], b = pair.b->pixels[i];
        if (std::isfinite(a) && std::isfinite(b)) visit(i, a, b);
    }
}

}  // namespace aleph
