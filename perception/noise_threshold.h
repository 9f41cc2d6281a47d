#pragma once
// Noise of single pixels that goes unseen.

#include <vector>

#include "engine/base/frame_rate.h"
#include "engine/base/image.h"
#include "engine/base/viewing.h"

namespace aleph {

/// How noise of pixels is new.
enum class NoiseOverTime {
    fresh,  ///< in every frame: its spectrum over time is flat up to half the frame rate
    lasts,  ///< once: it is the same in every frame
};

/// Visibility of noise that is independent from pixel to pixel, by castleCSF (castle.h): in just visible differences,
/// D^2 = 2 (sigma / L)^2 times the mean of S^2 over the frequencies that the noise has in space, the square of half a
/// cycle per pixel either way, and over time. S is the sensitivity to a patch of 1.5 cycles at the frequency that a
/// pattern has on the retina, times what a display that holds its frames passes of what the eye follows.
class NoiseVisibility {
  public:
    NoiseVisibility(const ViewingConditions& viewing, const FrameRate& frame_rate, NoiseOverTime over_time);

    /// The standard deviation of one pixel's luminance that is just visible, cd/m2. In proportion to luminance from 1e4
    /// cd/m2 up, to 1e12.
    /// @param luminance  that the eye is adapted to, cd/m2; NaN and values below 1e-3 count as 1e-3
    /// @param retinal    motion over the retina, deg/s; NaN and negative values count as 0
    /// @param tracked    what the eye follows, deg/s, likewise
    float threshold(float luminance, float retinal, float tracked) const;

  private:
    std::vector<float> sensitivity_;  ///< D L / sigma by luminance, retinal and tracked velocity
};

/// NoiseVisibility::threshold of every pixel.
/// @param retinal   deg/s (perception.h)
/// @param velocity  image velocity, deg/s: what is not retinal motion is tracked; empty: nothing is
/// @throws InputError if the sizes differ
Image<float> compute_noise_threshold(const NoiseVisibility& noise, const Image<float>& adaptation_luminance,
                                     const Image<float>& retinal, const Image<float>& velocity);

}  // namespace aleph
