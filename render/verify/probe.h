#pragma once
// Pictures checked in random places: what a viewer sees of their difference from what they converge to.

#include <functional>
#include <list>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/output/frame_files.h"
#include "render/verify/probe_reference.h"

namespace aleph {

/// Pixels of a block, and how many of them differ visibly (VisibleMaps).
struct ProbeResult {
    ProbePlace place;
    double pixels = 0.0;
    double beyond = 0.0;                              ///< by more than the error asked for
    double seen = 0.0, flicker = 0.0, lasting = 0.0;  ///< by at least one just visible difference
    double noise = 0.0;                               ///< of the reference: mean square, just visible differences
    int samples = 0;                                  ///< of the reference, by pixel and frame
    std::size_t window = 0;                           ///< frames it is judged over
    bool operator==(const ProbeResult&) const = default;
};

/// Largest mean square of the reference's own noise in a block, in just visible differences. Its energy is taken off,
/// so that what remains is scatter of differences that are barely seen or barely not.
inline constexpr double settled_noise = 0.1;

/// Pictures of frames that were rendered already, so that they need not be rendered again.
class PictureKeeper {
  public:
    using Make = std::function<Image<Rgb>(std::int64_t frame)>;

    /// @param make  renders a frame that is not kept
    /// @param most  bytes that are kept; beyond them the pictures that were not used for longest are dropped
    PictureKeeper(Make make, std::size_t most) : make_(std::move(make)), most_(most) {}

    void keep(std::int64_t frame, Image<Rgb> picture);
    /// The picture of a frame, valid until the next call.
    const Image<Rgb>& find(std::int64_t frame);

  private:
    Make make_;
    std::size_t most_, bytes_ = 0;
    std::list<std::pair<std::int64_t, Image<Rgb>>> pictures_;  ///< used last first
};

/// Measures probes. A probe is a function of scene, settings, frames and its number.
class Prober {
  public:
    /// @param settings  of the pictures that are checked
    /// @param frames    of which they are; at least one
    /// @param pictures  must outlive this
    /// @throws InputError as Sequence
    Prober(Scene scene, const RenderSettings& settings, const std::string& camera, std::vector<std::int64_t> frames,
           PictureKeeper& pictures);

    /// The reference takes as many samples as settle its noise: for each pixel at least 64 in each frame, at most
    /// 12,288 in all frames of the window.
    /// @param progress  of each picture; what it throws ends the probe
    ProbeResult measure(std::size_t number, const FrameProgress& progress = {});

  private:
    Sequence reference_;
    int width_, height_;
    double error_;  ///< just visible differences
    std::vector<std::int64_t> frames_;
    PictureKeeper& pictures_;
};

/// Pixels of a block, and those that are counted.
struct BlockCount {
    double pixels = 0.0, counted = 0.0;
};

/// The 97.5th percentile of Student's t distribution.
/// @param freedom  degrees, 1 or more
double student_95(std::size_t freedom);

/// Blocks are clusters: pixels of one are alike. The interval is that of Student's t for the ratio of the blocks' sums
/// (Cochran 1977, 6.3), within 0 to 1. Few blocks may all have missed what is rare: the upper end is that of these
/// blocks and one more, in which the square root of the largest share of a block is counted, midway in logarithms from
/// that to all; where nothing was counted, all is, which comes to the rule of three. The lower end is likewise that of
/// the pixels that are not counted.
VerifiedShare estimate_share(std::span<const BlockCount> blocks);

/// Shares of all pixels of all frames.
/// @param error  that was asked for, in just visible differences
VerifiedStatistics sum_up(std::span<const ProbeResult> probes, double error);

}  // namespace aleph
