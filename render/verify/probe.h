#pragma once
// Pictures checked in random places: what a viewer sees of their difference from what they converge to.

#include <functional>
#include <string>
#include <vector>

#include "render/output/verified_statistics.h"
#include "render/verify/picture_keeper.h"
#include "render/verify/probe_reference.h"

namespace aleph {

/// Pixels of a block, and how many of them differ visibly (VisibleMaps).
struct ProbeResult {
    ProbePlace place;
    double pixels = 0.0;
    double beyond = 0.0;  ///< by more than the error asked for
    double seen = 0.0, flicker = 0.0, lasting = 0.0;  ///< by at least one just visible difference
    double noise = 0.0;      ///< of the reference: mean square, just visible differences
    int samples = 0;         ///< of the reference, by pixel and frame
    std::size_t window = 0;  ///< frames it is judged over
    bool operator==(const ProbeResult&) const = default;
};

/// Largest mean square of the reference's own noise in a block, in just visible differences. Its energy is taken off, so
/// that what remains is scatter of differences that are barely seen or barely not.
inline constexpr double settled_noise = 0.1;

/// Measures probes. A probe is a function of scene, settings, frames and its number.
class Prober {
  public:
    /// @param settings  of the pictures that are checked
    /// @param frames    of which they are; at least one
    /// @param pictures  must outlive this
    /// @throws InputError as Sequence
    Prober(Scene scene, const RenderSettings& settings, const std::string& camera, std::vector<std::int64_t> frames,
           PictureKeeper& pictures);

    /// The reference takes as many samples as settle its noise: for each pixel at least 64 in each frame, at most 12,288
    /// in all frames of the window.
    ProbeResult measure(std::size_t number);

  private:
    Sequence reference_;
    int width_, height_;
    double error_;  ///< just visible differences
    std::vector<std::int64_t> frames_;
    PictureKeeper& pictures_;
};

/// Shares of all pixels of all frames.
/// @param error  that was asked for, in just visible differences
VerifiedStatistics sum_up(std::span<const ProbeResult> probes, double error);

}  // namespace aleph
