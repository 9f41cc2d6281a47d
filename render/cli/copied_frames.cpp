#include <fmt/format.h>

#include <algorithm>
#include <ranges>

#include "render/cli/frame_writer.h"

namespace aleph {

namespace {

constexpr std::size_t most_lines = 4;

/// Frames that copy one other frame, in a row.
struct CopiedRun {
    std::int64_t of = 0, first = 0, last = 0;
    std::size_t count = 0;
};

std::vector<CopiedRun> list_runs(const std::vector<FinishedFrame>& frames) {
    std::vector<CopiedRun> runs;
    for (const FinishedFrame& f : frames) {
        if (!f.copy_of) continue;
        if (runs.empty() || runs.back().of != *f.copy_of) runs.push_back({*f.copy_of, f.frame, f.frame, 0});
        CopiedRun& run = runs.back();
        run.first = std::min(run.first, f.frame);
        run.last = std::max(run.last, f.frame);
        ++run.count;
    }
    return runs;
}

std::string describe(const CopiedRun& run) {
    if (run.count == 1) {
        return fmt::format("aleph: frame {} is a copy of frame {}: nothing changes\n", run.first, run.of);
    }
    return fmt::format("aleph: frames {}-{} are copies of frame {}: nothing changes\n", run.first, run.last, run.of);
}

}  // namespace

std::string describe_copies(const std::vector<FinishedFrame>& frames) {
    const std::vector<CopiedRun> runs = list_runs(frames);
    std::string text;
    std::size_t left = 0;
    for (const CopiedRun& run : runs | std::views::take(most_lines)) text += describe(run);
    for (const CopiedRun& run : runs | std::views::drop(most_lines)) left += run.count;
    if (left > 0) text += fmt::format("aleph: {} more frames are copies of others\n", left);
    return text;
}

}  // namespace aleph
