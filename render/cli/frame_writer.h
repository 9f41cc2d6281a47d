#pragma once
// Makes the frames that are not finished, writes each to its file, and says how far it is.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/cli/budget.h"
#include "render/cli/scene_options.h"
#include "render/cli/support/frame_claims.h"
#include "render/cli/support/progress.h"
#include "render/cli/support/render_signals.h"
#include "render/cli/support/statistics_file.h"
#include "render/frame/frame_output.h"
#include "render/output/frame_files.h"

namespace aleph {

/// Frames that are to be made, and what their files say of them.
struct FrameJob {
    const Scene& scene;  ///< its frame rate, viewing conditions and file
    const RenderSettings& settings;
    double exposure;  ///< factor on radiance
    std::function<FrameOutput(int frame, const FrameRequest& request)> make;
    FrameClaims& claims;  ///< the frames, their files, and which of them are to be made now
    std::optional<Budget> budget = std::nullopt;
    /// Checks the frames once they are written. @param estimated  share of the pixels that are beyond, where it is
    /// known
    std::function<VerifiedStatistics(std::optional<double> estimated)> verify = {};
    std::function<void()> keep_light = {};  ///< called before a frame's file is written
    const char* title = nullptr;            ///< of the progress; null: the picture's or that of maps
};

/// Share of the pixels that may err by more than was asked for where `--error` is kept (`--strict`).
inline constexpr double most_beyond = 0.01;

struct FinishedFrame {
    std::int64_t frame = 0;
    std::optional<std::int64_t> copy_of;
};

/// Lines such as "aleph: frames 12-30 are copies of frame 11: nothing changes", one for every frame that others copy,
/// in the order of `frames`; a last line counts those beyond the fourth. Empty if no frame is a copy.
std::string describe_copies(const std::vector<FinishedFrame>& frames);

class FrameWriter {
  public:
    FrameWriter(const FrameJob& job, const SceneOptions& options, const FrameRequest& request);
    /// @throws Stopped
    void make_all();
    void finish();

    StatisticsFile& statistics() { return statistics_; }
    /// Share of the pixels of all frames that are estimated to err by more than was asked for, as far as frames tell.
    std::optional<double> estimate() const;
    /// The frames whose error is not known, or whose share of pixels beyond is larger than most_beyond, in words;
    /// empty: there are none.
    std::string describe_missed() const;

  private:
    /// Makes the frame unless it is finished. Returns whether another process makes it.
    bool is_busy(std::size_t place, Progress& progress, RenderSignals& signals);
    void make(std::size_t place, Progress& progress, RenderSignals& signals);
    void print_status(int frame, const char* stage, double fraction) const;
    void stop_if_asked(const RenderSignals& signals) const;
    /// Keeps the statistics of a frame that was finished before. Returns whether there are any.
    bool keep_row(std::size_t place);
    /// The same for frames of other processes, which have written theirs meanwhile.
    void keep_rows();
    /// Says at the end which files there are now.
    void print_files() const;

    const FrameJob& job_;
    const ClaimedOutput& output_;
    const SceneOptions& options_;
    const FrameRequest& request_;
    StatisticsFile statistics_;
    std::map<std::string, std::string> rows_;  ///< of an earlier run, by fingerprint
    std::vector<FinishedFrame> made_;
    std::vector<std::size_t> kept_;  ///< places of frames that others made
    double done_ = 0.0;              ///< frames
    std::vector<double> estimates_;  ///< of the frames that tell
    std::vector<int> missed_;        ///< frames of describe_missed
};

}  // namespace aleph
