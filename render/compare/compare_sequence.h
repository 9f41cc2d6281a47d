#pragma once
// Compares the frames of an animation with those of a reference, one after the other, and tells how much of pictures
// shows a visible difference.

#include <cstdint>
#include <functional>
#include <map>

#include "render/compare/compare.h"
#include "render/compare/visible_difference.h"

namespace aleph {

/// Shares of pixels with a difference of at least one just visible difference, percent.
struct VisibleShares {
    double seen = 0.0, flicker = 0.0, lasting = 0.0;
    /// As `seen`, each pixel weighed by how likely viewers look there; nothing where saliency is not known.
    std::optional<double> noticed{};
};

/// Counts over any number of frames.
class VisibleCount {
  public:
    /// @param saliency  [0,1], of the frame's size, or null
    void add(const VisibleMaps& maps, const Image<float>* saliency);
    VisibleShares shares() const;
    std::size_t pixels() const { return pixels_; }

  private:
    std::size_t pixels_ = 0, seen_ = 0, flicker_ = 0, lasting_ = 0;
    double noticed_ = 0.0, looked_ = 0.0;
    bool has_saliency_ = true;
};

/// @throws InputError if either has no R, G, B
PicturePair read_pair(const ChannelImage& a, const ChannelImage& b);

struct FrameComparison {
    std::int64_t frame = 0;
    CompareResult result;
    std::optional<VisibleShares> visible;  ///< where maps for it were given
    bool same = false;  ///< result.same(), and at most `share` percent of the pixels have a visible difference
};

/// Over all frames so far.
struct SequenceSummary {
    std::size_t frames = 0;
    std::size_t different = 0;        ///< frames that are not the same
    std::size_t pixels = 0;           ///< of all frames
    std::size_t beyond = 0;           ///< pixels beyond the tolerance
    double max_abs = 0.0, rms = 0.0;  ///< over all compared channels
    std::int64_t worst_frame = 0;     ///< the first one with the largest difference
    NonFinite a, b;
    std::optional<ThresholdDifference> threshold;
    std::optional<VisibleShares> visible;

    bool same() const { return different == 0; }
    double percent(std::size_t count) const { return percent_of(static_cast<double>(count), pixels); }
};

/// Maps of the reference (`aleph maps`); both may be the same.
struct SequenceMaps {
    const ChannelImage* threshold = nullptr;  ///< compares luminance by its threshold.Y
    const ChannelImage* visible = nullptr;    ///< measures visible differences along its motion
};

/// Called with the visible differences of each frame, in order.
using ReceiveVisible = std::function<void(const VisibleMaps&)>;

class SequenceComparison {
  public:
    /// @param cuts  frames that begin a new shot: no motion leads there from the frame before
    explicit SequenceComparison(CompareSettings settings, std::vector<std::int64_t> cuts = {},
                                ReceiveVisible receive = {});

    /// Compares the next frame; frames are in ascending order.
    /// @throws InputError as compare_images, or if the size changes between consecutive frames
    void add(std::int64_t frame, const ChannelImage& a, const ChannelImage& b, const SequenceMaps& maps);

    /// Ends the sequence: visible differences depend on later frames.
    void finish();

    /// All frames so far; complete after finish().
    const std::vector<FrameComparison>& frames() const { return frames_; }
    SequenceSummary summary() const;

  private:
    void take(const std::vector<VisibleMaps>& maps);

    CompareSettings settings_;
    std::vector<std::int64_t> cuts_;
    ReceiveVisible receive_;
    std::vector<FrameComparison> frames_;
    std::optional<VisibleDifference> visible_;
    std::map<std::int64_t, Image<float>> saliency_;  ///< of frames that are not finished; empty where it is not known
    VisibleCount visible_count_;
    ThresholdSum threshold_;
};

}  // namespace aleph
