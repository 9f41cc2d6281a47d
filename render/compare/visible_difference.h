#pragma once
// The difference between two sequences as a viewer sees it: an instrument that judges pictures and guides nothing.
// README.md has its steps and their sources: castleCSF (Ashraf et al. 2024), FovVideoVDP (Mantiuk et al. 2021) and
// ColorVideoVDP (Mantiuk et al. 2024).

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "engine/base/frame_rate.h"
#include "engine/base/viewing.h"
#include "perception/visible_bands.h"
#include "perception/vision/retinal_velocity.h"
#include "render/compare/surface_track.h"

namespace aleph {

/// How a sequence is shown and looked at.
struct ViewingSettings {
    ViewingConditions viewing;
    FrameRate frame_rate;
    double tracking = tracking_efficiency;  ///< share of the image velocity that the eye follows, [0,1]
};

/// framesPerSecond of a picture; nothing where it has none, or one that is not above 0.
std::optional<FrameRate> find_frame_rate(const ChannelImage& image);

/// Reads whiteLuminance, pixelsPerDegree, displayPersistence and framesPerSecond; others keep their defaults.
ViewingSettings read_viewing(const ChannelImage& maps);

/// The noise of a reference that is a mean of renderings: half the difference of the means of both halves of them,
/// which has the spectrum of the mean's own noise, and its variance. Reads noise.R, noise.G and noise.B, and the number
/// of renderings (`passes`); nothing if there are none, or one rendering.
Image<Rgb> read_noise(const ChannelImage& reference);

/// Two pictures of a frame.
struct PicturePair {
    Image<Rgb> picture, reference;  ///< linear RGB, Rec.709, white = 1
    Image<Rgb> noise{};  ///< of the reference (read_noise); its energy is taken off the difference's; may be empty
};

/// Visible differences of a frame, in just visible differences. A value that is not finite in either picture is
/// infinitely visible.
struct VisibleMaps {
    std::int64_t frame = 0;
    Image<float> seen;     ///< all together
    Image<float> flicker;  ///< what changes from frame to frame along the motion
    Image<float> lasting;  ///< what is the same in the frames around
};

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

class VisibleDifference {
  public:
    /// @param only  the frame whose maps are wanted; nothing: all
    explicit VisibleDifference(ViewingSettings settings, std::optional<std::int64_t> only = std::nullopt)
        : settings_(settings), only_(only) {}

    /// Takes the next frame. If its number does not follow the last one's, or `cut` is true, a new shot begins.
    /// @param maps  of the reference: motion to the next frame (read_motion)
    /// @return frames that are finished by this one, in order: of those, all frames that they depend on are known
    /// @throws InputError if sizes differ
    std::vector<VisibleMaps> add(std::int64_t frame, const PicturePair& pictures, MotionMaps maps, bool cut = false);

    /// Ends the sequence. @return the remaining frames
    std::vector<VisibleMaps> finish();

  private:
    using Bands = std::vector<Image<float>>;
    struct Frame {
        std::int64_t number;
        MotionMaps motion;
        std::array<Bands, visual_channels> error, noise;  ///< signals; noise is empty if there is none
        std::array<Bands, visual_channels> masker;        ///< amplitudes of what both pictures have
        Bands background;                                 ///< L + M that the eye is adapted to, cd/m2, by level
        std::vector<std::size_t> broken;                  ///< pixels that are not finite
    };

    void prepare(int width, int height);
    void measure_next(std::vector<VisibleMaps>& finished);
    VisibleMaps measure(std::size_t index) const;

    ViewingSettings settings_;
    std::optional<std::int64_t> only_;
    std::vector<BandShape> shapes_;
    std::vector<VisibleFilter> filters_;  ///< by channel and band
    std::deque<Frame> frames_;            ///< of this shot that are still needed
    std::size_t done_ = 0;                ///< frames at the front that are finished
};

}  // namespace aleph
