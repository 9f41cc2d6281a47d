#include "render/cli/write_frames.h"

#include <fmt/format.h>

#include <iostream>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "render/cli/output_path.h"
#include "render/cli/progress.h"
#include "render/frame_files.h"
#include "render/measure.h"

namespace aleph {

namespace {

/// The pattern's ending decides: .png is PNG, everything else EXR.
bool is_png(const std::filesystem::path& path) {
    return path.extension() == ".png";
}

/// Thresholds of vision are in cd/m2. In a scene of another unit every pixel is above or below all of them.
void warn_of_units(const FrameStatistics& frame) {
    const double median = frame.median_luminance;
    if (median == 0.0 || (median >= 1e-3 && median <= 1e4)) return;
    std::cerr << fmt::format(
        "aleph: warning: frame {}: the median luminance is {:.3g} cd/m2, outside 1e-3 to 1e4: check \"exposure\" and "
        "\"display_white\" of the scene\n",
        frame.frame, median);
}

/// Writes one frame, and adds the time for it to the frame's statistics.
void write_frame(const std::filesystem::path& path, const FrameJob& job, FrameOutput& output, bool maps) {
    StageClock clock;
    if (is_png(path)) {
        write_png(path, output.shaded.color);
    } else {
        write_exr(path, make_frame_image(output, maps, job.scene, job.settings, job.exposure));
    }
    StageSeconds& seconds = output.statistics.seconds;
    clock.add_to(seconds.write);
    seconds.total += seconds.write;
}

}  // namespace

void prepare_frames_output(const PreparedScene& prepared, const SceneOptions& options, bool maps) {
    prepare_output(options.output, prepared.name, prepared.frames.size());
    if (maps && is_png(output_path(options.output, prepared.name, prepared.frames.front()))) {
        throw InputError("--output", printable(options.output), "PNG cannot hold the channels of maps; write .exr");
    }
}

void write_frames(const FrameJob& job, const SceneOptions& options, const FrameRequest& request) {
    std::vector<FrameStatistics> statistics;
    Progress progress(request.frame ? "render" : "maps", static_cast<double>(job.frames.size()),
                      progress_look(options.quiet));
    for (const int frame : job.frames) {
        const auto done = static_cast<double>(statistics.size());
        FrameRequest with_progress = request;
        with_progress.progress = [&](double fraction, const char* stage) {
            progress.update(done + fraction, fmt::format("frame {}: {}", frame, stage));
        };
        FrameOutput output = job.make(frame, with_progress);
        write_frame(output_path(options.output, job.name, frame), job, output, request.maps);
        if (statistics.empty() && !options.quiet) warn_of_units(output.statistics);
        statistics.push_back(output.statistics);
        progress.update(done + 1.0, fmt::format("frame {}", frame));
    }
    if (!options.stats.empty()) {
        write_file(options.stats, format_statistics(statistics, job.scene, job.settings, job.exposure));
    }
}

void render_frames(PreparedScene prepared, const SceneOptions& options, const FrameRequest& request) {
    prepare_frames_output(prepared, options, request.maps);
    const ThreadLimit limit(options.threads);
    Sequence sequence(std::move(prepared.scene), prepared.settings, options.camera);
    const auto make = [&](int frame, const FrameRequest& asked) { return sequence.render(frame, asked); };
    write_frames({sequence.scene(), prepared.settings, sequence.exposure(), prepared.frames, prepared.name, make},
                 options, request);
}

}  // namespace aleph
