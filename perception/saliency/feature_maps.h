#pragma once
// The 48 feature maps (Yee 2000, eq. 5.4): differences of centre and surround levels, stored at the centre's own size.
// Expansion is linear, so |expand(difference)| is the difference of both levels at full size.

#include <array>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/pyramid.h"

namespace aleph {

inline constexpr int saliency_levels = 9;  ///< Gaussian levels 0..8; a level of 1x1 stays 1x1

/// Each channel has its own conspicuity map.
enum class FeatureChannel { intensity, color, orientation, motion };
inline constexpr int channel_count = 4;

struct FeatureMap {
    FeatureChannel channel;
    int level;                ///< centre: 2, 3 or 4
    Image<float> difference;  ///< centre - expanded surround, signed, at the centre's size
};

inline constexpr int finest_center = 2;  ///< no feature map uses levels 0 and 1: they may be empty
inline constexpr int coarsest_center = 4;

/// Gaussian pyramids of the feature maps' inputs, levels 0..8 each. C1 and C2 share the colour channel.
struct ChannelPyramids {
    LevelSize size;  ///< of level 0
    std::vector<Image<float>> a, c1, c2;
    std::vector<Image<float>> velocity;  ///< deg/s
};

/// (5.4) for (centre, surround) in (2,5) (2,6) (3,6) (3,7) (4,7) (4,8): 6 intensity, 12 colour, 24 orientation and 6
/// motion maps, in a fixed order.
std::vector<FeatureMap> make_feature_maps(const ChannelPyramids& pyramids);

}  // namespace aleph
