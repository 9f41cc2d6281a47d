#pragma once
// The saliency map S (Yee 2000, section 5.3): where the eye is drawn to.

#include <array>
#include <vector>

#include "engine/base/image.h"
#include "perception/saliency/feature_maps.h"
#include "perception/saliency/saliency_grid.h"

namespace aleph {

struct Saliency {
    Image<float> map;       ///< S, [0,1], at full size
    bool fallback = false;  ///< nothing stood out, or everything did: S = tracking_efficiency everywhere

    /// By FeatureChannel: sums of N(feature), before their own N(.). Rasters of level `conspicuity_level`.
    std::array<Image<float>, channel_count> conspicuity;
    int conspicuity_level = 0;     ///< 0 with grid `full`, 2 with `center`
    std::vector<LevelSize> sizes;  ///< of levels 0..8
};

/// A channel's conspicuity at full size.
Image<float> full_conspicuity(const Saliency& saliency, FeatureChannel channel);

/// @param max_a  max |A| of the frame: feature maps of A, C1, C2 and orientation with a range of at most 1e-6 of it
/// become 0
Saliency compute_saliency(const ChannelPyramids& pyramids, double max_a, SaliencyGrid grid);

}  // namespace aleph
