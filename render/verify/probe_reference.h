#pragma once
// Where probes lie, the frames around them, and the reference of a block in each of these.

#include <array>
#include <span>
#include <vector>

#include "render/compare/visible_difference.h"
#include "render/frame/sequence.h"
#include "render/pixels/picture_part.h"

namespace aleph {

/// A block of a frame's picture.
struct ProbePlace {
    std::int64_t frame = 0;
    PictureArea block;
    bool operator==(const ProbePlace&) const = default;
};

/// The place of a probe. The picture is divided into blocks of equal size, up to 16 pixels wide and high; frames,
/// columns and rows follow a sequence of low discrepancy (the additive recurrence of Roberts 2018), so that any first
/// probes are spread evenly over all three.
/// @param number  of the probe, from 0 on
/// @param frames  at least one
ProbePlace place_probe(std::size_t number, std::span<const std::int64_t> frames, int width, int height);

/// A frame of a probe's window.
struct ProbeFrame {
    std::int64_t frame = 0;
    MotionMaps motion;  ///< of the area
    PicturePart part;   ///< pixels that the reference is rendered for, of the whole picture
    /// Two means of the area of as many samples, whose mean is the reference and whose difference its noise; 0 beyond
    /// the part.
    std::array<Image<Rgb>, 2> halves;
    int samples = 0;  ///< of a pixel of the part, in both
};

/// The frames that judge a probe: its own and those that the instrument looks at beside it (filter_reach), as far as
/// they are of its shot.
struct ProbeWindow {
    std::vector<ProbeFrame> frames;
    PictureArea area;   ///< all parts and what the eye is adapted to around them, at multiples of 16 pixels
    PictureArea block;  ///< relative to the area
};

/// The motion of a frame as the instrument takes it.
MotionMaps read_maps(const FrameOutput& output);

/// Frames that the instrument looks at for one of them: within the range, without a cut between.
std::vector<std::int64_t> list_window(std::int64_t frame, int reach, const FrameRange& range,
                                      std::span<const std::int64_t> cuts);

/// In the probe's frame the part is the block with a margin; in the others it is where its surfaces are.
/// @param sequence  with traced_reference_settings
ProbeWindow find_probe_window(const ProbePlace& place, Sequence& sequence);

/// Adds samples to every frame's reference. Their random numbers are those of no other frame, round or picture.
/// @param round    number of the call for this window, from 0 on
/// @param samples  of each half, 2 or more
/// @param progress  of each picture (FrameRequest)
void add_reference_samples(ProbeWindow& window, int round, int samples, Sequence& sequence,
                           const FrameProgress& progress);

/// The error itself in the part; elsewhere means of what is near, over wider areas the farther away it is (push and
/// pull, Gortler et al. 1996). So an error that is even in the part is even everywhere: the part's outline is no edge
/// of it. Values that are not finite count as unknown. 0 if nothing is known.
Image<Rgb> continue_error(const Image<Rgb>& error, const PicturePart& part);

/// Pictures of the area as the instrument takes them. Beyond the part their difference is continued (continue_error).
PicturePair make_probe_pair(const ProbeFrame& frame, const PictureArea& area, const Image<Rgb>& picture);

}  // namespace aleph
