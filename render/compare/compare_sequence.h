#pragma once
// Compares the frames of an animation with those of a reference, one after the other. Of the frames before, only the
// luminance error and the motion of the last one are kept.

#include <cstdint>

#include "render/compare/compare.h"
#include "render/compare/compare_flicker.h"

namespace aleph {

struct FrameComparison {
    std::int64_t frame = 0;
    CompareResult result;
    std::optional<FlickerFigures> flicker;  ///< from the frame before, if that was compared and has motion
    bool same = false;  ///< result.same, and at most `share` percent of the pixels flicker beyond the threshold
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
    std::size_t flicker_pairs = 0;          ///< pairs of consecutive frames
    std::optional<FlickerFigures> flicker;  ///< if there is a pair

    bool same() const { return different == 0; }
    double percent(std::size_t count) const {
        return pixels == 0 ? 0.0 : 100.0 * static_cast<double>(count) / static_cast<double>(pixels);
    }
};

class SequenceComparison {
  public:
    /// @param cuts  frames that begin a new shot: nothing flickers from the frame before
    explicit SequenceComparison(CompareSettings settings, std::vector<std::int64_t> cuts = {});

    /// Compares the next frame; frames are in ascending order. Flicker is measured where the frame before has the
    /// number frame - 1 and its maps have motion.
    /// @param maps  of the reference (`aleph maps`), or null
    /// @throws InputError as compare_images, or if the size changes between consecutive frames
    FrameComparison add(std::int64_t frame, const ChannelImage& a, const ChannelImage& b, const ChannelImage* maps);

    SequenceSummary summary() const;

  private:
    struct Last {
        std::int64_t frame;
        LuminanceError error;
        FlickerMaps maps;
    };
    std::optional<FlickerFigures> follow(std::int64_t frame, const LuminanceError& error,
                                         const std::optional<FlickerMaps>& maps);
    void add_to_summary(const FrameComparison& comparison);

    CompareSettings settings_;
    std::vector<std::int64_t> cuts_;
    std::optional<Last> last_;
    SequenceSummary summary_;
    double squares_ = 0.0;  ///< sum of squared differences
    std::size_t values_ = 0;
    ThresholdSum threshold_;
    FlickerSum flicker_;
    bool own_threshold_ = true;
};

}  // namespace aleph
