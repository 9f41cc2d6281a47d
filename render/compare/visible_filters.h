#pragma once
// The eye's response to a band's signal over the frames: filters along the motion that it follows.

#include <vector>

#include "engine/base/frame_rate.h"
#include "engine/base/viewing.h"
#include "perception/visible_bands.h"

namespace aleph {

/// Frames before and after the current one that a filter takes: about .15 s, from 1 to 7.
int filter_reach(const FrameRate& frame_rate);

/// Filters of one band and channel, by luminance and velocity. The signal along the motion is split into 2 reach + 1
/// frequencies over time. Each is weighed by castleCSF's sensitivity, for a patch of 1.5 cycles around the pixel
/// (Mantiuk et al. 2024, "ColorVideoVDP"), at the frequency that it has on the retina: what of the motion the eye does
/// not follow shifts it by frequency times velocity, either way. A display that holds its frames blurs what the eye
/// follows (display_hold.h), and shows each frequency together with its mirror about half the frame rate.
class VisibleFilter {
  public:
    /// @param frequency  cycles per degree
    /// @param tracking   share of the image velocity that the eye follows, up to pursuit_limit
    VisibleFilter(int channel, double frequency, const ViewingConditions& viewing, const FrameRate& frame_rate,
                  double tracking);

    /// The filter at one pixel: `weights[k]` is that of the frames k before and k after.
    /// @param luminance  cd/m2 that the eye is adapted to
    /// @param velocity   image velocity, deg/s
    /// @param weights    of 0 to reach: 1 / contrast
    /// @return the sensitivity to what lasts, 1 / contrast: the weights' sum over all frames
    float evaluate(float luminance, float velocity, float* weights) const;

  private:
    int reach_;
    std::vector<float> nodes_;  ///< by luminance, velocity, and k; the last of each is the sensitivity to what lasts
};

}  // namespace aleph
