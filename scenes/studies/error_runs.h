#pragma once
// Renderings of one frame with several settings, each judged by a path-traced reference.

#include <functional>
#include <optional>

#include "render/study/picture_error.h"
#include "render/study/reference_picture.h"
#include "scenes/studies/timed_frame.h"

namespace aleph {

/// A rendering and what is wrong with it.
struct ErrorRun {
    std::string name;  ///< its settings, in words
    FrameCost cost;
    PictureError error;
    std::optional<ClaimCheck> claim;  ///< of what the program says of its error
    std::string statistics;           ///< JSON (TimedFrame)

    /// Percent of the pixels beyond so many thresholds, one of JudgedFrame::multiples.
    double percent_beyond(double thresholds) const;
};

/// A frame with what judges its renderings.
struct JudgedFrame {
    const Scene& scene;
    RenderSettings settings;  ///< of every rendering, but for what a run changes
    std::int64_t number = 0;
    std::string name;  ///< scene and number
    ChannelImage reference{};
    Image<float> threshold{};          ///< cd/m2
    double map_seconds = 0.0;          ///< of a processor, for the maps of the threshold
    std::vector<double> multiples{1};  ///< of the threshold, with which errors are compared
    int repeats = 1;                   ///< of every rendering
};

/// @param asked  thresholds, with which the program's own estimate is checked
ErrorRun judge(const JudgedFrame& frame, const std::string& name, const RenderSettings& settings, double asked = 1.0);
/// The same of a frame that is rendered already.
ErrorRun judge(const JudgedFrame& frame, const std::string& name, TimedFrame timed, double asked = 1.0);

/// Fixed settings: uniform sampling without a guide.
struct Ladder {
    std::vector<double> spps, light_samples, accuracies;
    double most_seconds = 300.0;  ///< of a processor, of one run: dearer ones are not tried
};

/// A share of pixels that fixed settings are to reach.
struct ShareGoal {
    double thresholds = 1.0, percent = 0.5;
};

/// Runs for one accuracy and one number of light samples, in order of their samples per pixel.
struct LadderSide {
    std::string name;
    std::vector<ErrorRun> runs;
};

/// Climbs every side until it reaches all goals, is dearer than another side that reached them, or is dearer than
/// allowed.
/// @param after  called with every new run
std::vector<LadderSide> climb(const JudgedFrame& frame, const Ladder& ladder, const std::vector<ShareGoal>& goals,
                              const std::function<void(const ErrorRun&)>& after);

/// What the best fixed settings need for a goal.
struct FixedCost {
    std::string name;                           ///< of the side
    double seconds = 0.0, frame_seconds = 0.0;  ///< with and without key moments
    bool at_most = false;                       ///< the cheapest run of the side already reaches the goal
};

/// The cheapest side, between its runs as cost_at has it. Nothing if no side reaches the goal.
std::optional<FixedCost> find_best_fixed(const std::vector<LadderSide>& sides, const ShareGoal& goal);

}  // namespace aleph
