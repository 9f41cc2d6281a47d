#pragma once
// Compares the frames of an animation with those of a reference, one after the other.

#include <cstdint>
#include <functional>
#include <map>

#include "render/compare/compare.h"
#include "render/compare/visible_shares.h"

namespace aleph {

struct FrameComparison {
    std::int64_t frame = 0;
    CompareResult result;
    std::optional<VisibleShares> visible;  ///< where maps for it were given
    bool same = false;                     ///< result.same, and at most `share` percent of the pixels have a visible difference
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
    double percent(std::size_t count) const {
        return pixels == 0 ? 0.0 : 100.0 * static_cast<double>(count) / static_cast<double>(pixels);
    }
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
