#pragma once
// Pictures as a display shows them, in bands of spatial frequency, and how much their contrast hides.

#include <array>
#include <vector>

#include "engine/base/color.h"
#include "engine/base/image.h"

namespace aleph {

/// Achromatic (L + M), red-green (L - 2.3112 M) and yellow-violet (50.9875 S - (L + M)) signals of the cones of CIE
/// 2006, in cd/m2: grey of luminance Y has about (Y, 0, 0).
inline constexpr int visual_channels = 3;
using VisualChannels = std::array<Image<float>, visual_channels>;

/// Luminance that a screen adds to every pixel, cd/m2: it reflects about 1 % of the light around it, 64 lux in the
/// surroundings that sRGB is made for (IEC 61966-2-1). Without it the eye would adapt to the black beside a bright
/// thing, and see in it the faintest light of coarse bands.
inline constexpr float screen_reflection = 0.2f;

/// The light of a display, in one channel: components are clamped to [0,1], NaN counts as 0. The achromatic one has
/// screen_reflection too.
/// @param picture  linear RGB, Rec.709, white = 1
/// @param white    cd/m2
Image<float> compute_visual_channel(const Image<Rgb>& picture, double white, int channel);
VisualChannels compute_visual_channels(const Image<Rgb>& picture, double white);

/// A band of a decomposition, on levels of a pyramid: pixel i of level n lies on the picture's pixel 2^n i (pyramid.h).
struct BandShape {
    double frequency = 0.0;  ///< at which sensitivity is taken, cycles per pixel of the picture
    double gain = 1.0;       ///< amplitudes times gain add up, as squares, to the amplitude of any grating
    int signal_level = 0;    ///< of its signal: from the third band on 4 pixels a cycle or more, read between pixels
    int level = 0;           ///< of its amplitude
    int blurs = 0;           ///< passes of low_pass that average energy over about half a cycle
};

/// Bands of a picture, finest first, down to where a side has less than 4 pixels. With the frequencies and gains here
/// the bands' thresholds give a grating of .01 to .4 cycles per pixel its own threshold within 10 % (at 100 cd/m2).
std::vector<BandShape> visible_bands(int width, int height);

/// The signal of a channel in its finest bands, `most` at most; the rest below the last one is left out.
std::vector<Image<float>> split_bands(const Image<float>& channel, std::size_t most = 64);

/// Amplitude of a band's signal around each pixel of its level: sqrt(2 mean of squares), times the band's gain.
Image<float> local_amplitude(Image<float> signal, const BandShape& band);

/// How many times contrast that is there raises the threshold of what is added to it in its band and channel, 1 and up
/// (Mantiuk et al. 2024, "ColorVideoVDP": the constants of its version 0.5.4).
/// @param contrast  of the amplitude of what is there, in thresholds, 0 and up
float contrast_masking(float contrast, int channel);

}  // namespace aleph
