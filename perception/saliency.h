#pragma once
// The saliency map S of thesis 5.3: where the eye is drawn to.

#include <array>

#include "engine/base/image.h"
#include "perception/feature_maps.h"
#include "perception/perception_settings.h"

namespace aleph {

/// S before its last step, which scale_saliency_row does: it needs one pass less when the Aleph pass does it on the
/// way.
struct Saliency {
    std::vector<LevelSize> sizes;  ///< of levels 0..8
    /// By FeatureChannel: sums of N(feature), before their own N(.). Rasters of `conspicuity_level`.
    std::array<Image<float>, channel_count> conspicuity;
    int conspicuity_level = 0;             ///< 0 with grid `full`, 2 with `center`
    Image<float> map;                      ///< sum of N(conspicuity)
    float minimum = 0.0f, maximum = 0.0f;  ///< of the sum
    bool fallback = false;                 ///< nothing stood out, or everything did: S = tracking_efficiency everywhere
};

/// A channel's conspicuity at full size.
Image<float> full_conspicuity(const Saliency& saliency, FeatureChannel channel);

/// Turns row y of the map into S: min-max to [0,1] exactly.
void scale_saliency_row(Saliency& saliency, int y);

/// @param largest_a  max |A| of the frame: feature maps of A, C1, C2 and orientation with a range of 1e-6 of it are 0
Saliency compute_saliency(const ChannelPyramids& pyramids, double largest_a, SaliencyGrid grid);

}  // namespace aleph
