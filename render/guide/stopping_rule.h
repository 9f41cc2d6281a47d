#pragma once
// When a pixel has enough samples (Yee 2000, section 6.2, and a rule of our own).

#include <cstdint>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/viewing.h"
#include "render/pixels/outlines.h"
#include "render/pixels/pixel_samples.h"
#include "render/settings/settings.h"

namespace aleph {

/// Seen is the error's energy around a pixel, a sum of some eight independent parts. It is within this many
/// times its own root mean square at 99 % of the pixels (chi-square of 8 degrees of freedom).
inline constexpr double error_deviations = 1.585;

/// The error of samples that is allowed where an error of so many just visible differences is asked for, over the noise
/// of single pixels that goes unseen (NoiseVisibility); 0 or more. Up to 1 in proportion to it, above as its power of
/// .8: the share of the pixels in which noise is seen rises more steeply than the noise.
double allow_noise(double error);

/// Errors that a viewer tolerates in a frame. Images have the frame's size.
struct VisibleLimits {
    const Image<float>& threshold;  ///< cd/m2 (6.9)
    const Image<float>& noise;      ///< cd/m2 (NoiseVisibility)
    const Image<float>& aleph;      ///< elevation of the threshold
    const Image<float>& accuracy;   ///< alpha, of cached light
    const Image<Outline>& outlines;
    const Image<float>& swing;  ///< blur_frame_estimate; empty: the shutter is closed
    ViewingConditions viewing;
};

/// The mean of a pixel's samples, as its neighbours or its own samples tell it. Where own samples decide, the picture
/// is biased (Kirk and Arvo 1991; README.md).
struct MeanEstimate {
    int samples = 0;
    double error2 = 0.0;    ///< squared error of the mean, from halves (PixelSamples::Error::total)
    double variance = 0.0;  ///< of one sample's luminance
    double around = 0.0;    ///< deviation of one sample of the pixels around (deviations_around), luminance
};

/// Returns whether a pixel is shown as white whatever its error: three standard errors less of all channels still are.
/// @param white   radiance that the display shows as white
/// @param around  variance of a sample's luminance, as the pixels around tell it: counts where it is the larger one
bool is_shown_white(const PixelSamples& pixel, double white, double around = 0.0);

/// Mean over the pixels around, without the pixel itself (mean_around), of the standard deviation of their samples'
/// light (PixelSamples::Error::total): of independent samples with as much error as theirs.
Image<float> deviations_around(const Image<PixelSamples>& pixels, int reach);

/// Estimates a pixel's mean and noise from the 24 pixels around (x, y). Only those count that have an outline as it
/// has, or have none as it has none: beside an outline the noise is another. Where there is no such pixel, all of them
/// tell; where it is alone, the pixel itself.
/// @param outlines  may be empty
MeanEstimate estimate_mean(const Image<PixelSamples>& pixels, const Image<Outline>& outlines, int x, int y);

/// The same from the pixel's own samples.
MeanEstimate estimate_own_mean(const PixelSamples& pixel);

/// Returns whether a rule stops at this estimate.
/// consecutive (6.10): the means of this stage and of the one before differ by less than the tolerance.
/// variance (6.12): the standard error of independent samples is below the tolerance; with Stopping::pixel, as printed,
/// their standard deviation, which does not fall with their number.
/// threshold: n samples are enough if error_deviations^2 s S / n is within the tolerance squared, with s the deviation
/// of the pixel's samples and S that of those around. The energy of the errors around is then within it, with
/// the fewest samples in all (Neyman 1934): where deviations are equal, when error_deviations standard errors are
/// within the tolerance; at a lone outline with fewer samples, around it with more.
/// @param tolerance  of luminance, in the samples' unit. 0 or less is met by an error of 0 only
bool is_enough(Sampling rule, Stopping stopping, const MeanEstimate& mean, double tolerance);

/// Returns whether a pixel's own samples tell a standard error beyond the tolerance, as where a few of them are far
/// brighter than the others.
bool stands_out(const PixelSamples& pixel, double tolerance);

/// The pixels of a stage that may take more samples, one element each.
struct StagePixels {
    std::vector<int> x, y;
    std::vector<int> samples;      ///< so far
    std::vector<float> error;      ///< standard error of the mean, in luminance, as Stopping says who tells it
    std::vector<float> deviation;  ///< of the luminance of one sample, likewise
    std::vector<float> tolerance;  ///< of the mean luminance (is_enough)
};

/// A rule of a program's own: SamplingSettings::own_rule.
class StoppingRule {
  public:
    virtual ~StoppingRule() = default;

    /// 1 for each pixel that has enough samples, 0 for those that double theirs. Called after each stage.
    virtual std::vector<std::uint8_t> find_enough(const StagePixels& pixels) const = 0;
};

/// Samples of the Aleph sampling protocol (6.13): most / aleph, but at least 16, and at most `most`.
int protocol_samples(double aleph, int most);

/// Samples before a rule is asked first.
int first_samples(Sampling rule, Outline outline, int most);

/// Errors of pixels within so many on either side add up, as energy, to what is seen at one: about half a cycle where
/// noise is seen best. 4 at 31 pixels per degree, at least 1.
int find_seen_reach(double pixels_per_degree);

/// Mean of the values around each pixel.
/// @param values    negative: unknown, not counted
/// @param with_own  whether the pixel's own value counts; it does where no other is known
/// @return negative where no value is known
Image<float> mean_around(const Image<float>& values, int reach, bool with_own);

}  // namespace aleph
