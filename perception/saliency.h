#pragma once
// The saliency map S of thesis 5.3: where the eye is drawn to.

#include <array>

#include "engine/base/image.h"
#include "perception/feature_maps.h"
#include "perception/perception_settings.h"

namespace aleph {

/// What S is made from. S itself is `scaled(raw)`: kept raw so that the Aleph pass scales it on the way.
struct Saliency {
    std::array<Image<float>, channel_count> conspicuity;  ///< by Channel: sums of N(feature), before their own N(.)
    Image<float> raw;                                     ///< sum of N(conspicuity)
    float minimum = 0.0f, maximum = 0.0f;                 ///< of raw
    bool fallback = false;  ///< nothing stood out, or everything did: S = tracking_efficiency everywhere

    /// Min-max of raw, [0,1] exactly.
    float scaled(float value) const;
};

/// @param largest_a  max |A| of the frame: feature maps of A, C1, C2 and orientation with a range of 1e-6 of it are 0
Saliency compute_saliency(const ChannelPyramids& pyramids, double largest_a, SaliencyGrid grid);

}  // namespace aleph
