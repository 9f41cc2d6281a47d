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

// Oriented energy at one level of a Gaussian pyramid: Greenspan et al. 1994 (Yee 2000, section 5.3).

inline constexpr int orientation_count = 4;
/// Directions of the wave vector, x right and y down: 0 responds to vertical lines, 90 to horizontal lines, 45 to lines
/// that rise to the right (/), 135 to lines that fall to the right (\).
inline constexpr std::array<double, orientation_count> orientation_degrees = {0, 45, 90, 135};

/// |lowpass(h e^{i k.x})| per orientation with h = level - lowpass(level), |k| = pi/2 per pixel of this level.
std::array<Image<float>, orientation_count> compute_orientations(const Image<float>& level);

}  // namespace aleph
