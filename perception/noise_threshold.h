#pragma once
// Noise of single pixels that goes unseen.

#include <array>
#include <vector>

#include "engine/base/color.h"
#include "engine/base/frame_rate.h"
#include "engine/base/image.h"
#include "engine/base/viewing.h"

namespace aleph {

/// How noise of pixels is new.
enum class NoiseOverTime {
    fresh,  ///< in every frame: its spectrum over time is flat up to half the frame rate
    lasts,  ///< once: it is the same in every frame
};

/// Bands in which noise and contrast are looked at: the finest of visible_bands.h; the last stands for all below it.
inline constexpr int noise_bands = 4;
using BandContrasts = std::array<float, noise_bands>;

/// Red-green signal of linear Rec.709 RGB (visible_bands.h) without that of grey of the same luminance, .004 of it, and
/// how much luminance its noise of single pixels is worth where each is as visible: 1.3 to 1.75 times the signal at 20
/// to 80 cd/m2, 20 to 62 pixels per degree and up to 10 deg/s, .8 to 1.4 at 2 cd/m2, by the integral of
/// NoiseVisibility. The yellow-violet signal is worth .06 to .2.
inline constexpr Rgb red_green_weights{0.12682f, -0.08977f, -0.03705f};
inline constexpr float red_green_worth = 1.4f;

/// Visibility of noise that is independent from pixel to pixel, by castleCSF (castle.h): in just visible differences,
/// D^2 = 2 (sigma / L)^2 times the mean of (S / M)^2 over the frequencies that the noise has in space, the square of
/// half a cycle per pixel either way, and over time. S is the sensitivity to a patch of 1.5 cycles at the frequency
/// that a pattern has on the retina, times what a display that holds its frames passes of what the eye follows; M is
/// how much the contrast of the picture masks in the band (contrast_masking).
class NoiseVisibility {
  public:
    NoiseVisibility(const ViewingConditions& viewing, const FrameRate& frame_rate, NoiseOverTime over_time);

    /// The standard deviation of one pixel's luminance that is just visible, cd/m2. In proportion to luminance from 1e4
    /// cd/m2 up, to 1e12.
    /// @param luminance  that the eye is adapted to, cd/m2; NaN and values below 1e-3 count as 1e-3
    /// @param retinal, tracked  motion over the retina, and what the eye follows, deg/s; NaN and below 0 count as 0
    /// @param contrasts  amplitudes of the picture's bands over that luminance, finite, 0 and up
    float threshold(float luminance, float retinal, float tracked, const BandContrasts& contrasts = {}) const;

  private:
    struct Band {
        float noise = 0.0f;    ///< D L / sigma
        float pattern = 0.0f;  ///< sensitivity to a pattern of the band that stands still on what moves
    };
    using Bands = std::array<Band, noise_bands>;
    std::vector<Bands> sensitivity_;  ///< by luminance, retinal and tracked velocity
};

/// NoiseVisibility::threshold of every pixel.
/// @param picture, white  what is shown, white = 1; luminance of the display's white, cd/m2
/// @param adaptation_luminance  cd/m2, of the picture as the display shows it: from screen_reflection to white and that
/// @param retinal   deg/s (perception.h)
/// @param velocity  image velocity, deg/s: what is not retinal motion is tracked; empty: nothing is
/// @throws InputError if the sizes differ
Image<float> compute_noise_threshold(const NoiseVisibility& noise, const Image<Rgb>& picture, double white,
                                     const Image<float>& adaptation_luminance, const Image<float>& retinal,
                                     const Image<float>& velocity);

}  // namespace aleph
