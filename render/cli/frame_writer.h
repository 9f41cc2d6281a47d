#pragma once
// Makes the frames that are not finished, writes each to its file, and says how far it is.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/cli/budget.h"
#include "render/cli/scene_options.h"
#include "render/cli/support/frame_claims.h"
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
    std::function<void()> keep_light = {};  ///< called before a frame's file is written, whatever it throws
    const char* title = nullptr;            ///< of the progress; null: the picture's or that of maps
};

/// Share of the pixels that may err by more than was asked for where `--error` is kept (`--strict`).
inline constexpr double most_beyond = 0.01;

/// An estimated share of the pixels, in words: "about 3.2 %", or "about 1 % or less". Estimates below most_beyond say
/// no more than that: rare bright samples and the error of cached light are hardly in them.
std::string describe_estimate(double share);

struct FinishedFrame {
    std::int64_t frame = 0;
    std::optional<std::int64_t> copy_of;
};

/// Lines such as "aleph: frames 12-30 are copies of frame 11: nothing changes", one for every frame that others copy,
/// in the order of `frames`; a last line counts those beyond the fourth. Empty if no frame is a copy.
std::string describe_copies(const std::vector<FinishedFrame>& frames);

/// Makes every frame that is not finished and writes it; waits for those that other processes make. The statistics
/// (--stats) of finished frames are written as they go along (StatisticsFile). Prints at the end, on standard error,
/// which files were written.
/// @throws Stopped after SIGTERM or SIGINT, and where frames err by more than --strict allows
void write_frames(const FrameJob& job, const SceneOptions& options, const FrameRequest& request);

}  // namespace aleph
