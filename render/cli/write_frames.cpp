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

/// The pattern's ending decides: .png is PNG, .hdr is Radiance, everything else EXR.
bool is_png(const std::filesystem::path& path) {
    return path.extension() == ".png";
}
bool is_hdr(const std::filesystem::path& path) {
    return path.extension() == ".hdr";
}

void warn_of_changed_values(std::size_t count) {
    if (count == 0) return;
    std::cerr << fmt::format(
        "aleph: warning: {} values were below 0, NaN or too large for .hdr files, and were changed; write .exr to keep "
        "them\n",
        count);
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

/// What share of the pixels is estimated to err by more than was asked for, and why.
void print_error(const FrameStatistics& frame) {
    if (!frame.error) return;
    const ErrorShares& shares = *frame.error;
    std::string causes;
    for (std::size_t i = 0; i < cause_count; ++i) {
        if (shares.by_cause[i] < 1e-5) continue;
        causes += fmt::format("{}{} {:.2g} %", causes.empty() ? "; alone: " : ", ", cause_names()[i],
                              100.0 * shares.by_cause[i]);
    }
    std::cerr << fmt::format(
        "aleph: frame {}: about {:.2g} % of the pixels err by more than {:g} visible threshold{}{}\n", frame.frame,
        100.0 * shares.beyond, shares.asked, shares.asked == 1.0 ? "" : "s", causes);
}

/// Writes one frame, and adds the time for it to the frame's statistics.
/// @return how many values the format could not hold
std::size_t write_frame(const std::filesystem::path& path, const FrameJob& job, FrameOutput& output, bool maps) {
    StageClock clock;
    std::size_t changed = 0;
    if (is_png(path)) {
        write_png(path, output.shaded.color);
    } else if (is_hdr(path)) {
        changed = write_hdr(path, output.shaded.color);
    } else {
        write_exr(path, make_frame_image(output, maps, job.scene, job.settings, job.exposure));
    }
    StageSeconds& seconds = output.statistics.seconds;
    clock.add_to(seconds.write);
    seconds.total += seconds.write;
    return changed;
}

}  // namespace

void prepare_frames_output(const PreparedScene& prepared, const SceneOptions& options, bool maps) {
    prepare_output(options.output, prepared.name, prepared.frames.size());
    if (!maps) return;
    const std::filesystem::path path = output_path(options.output, prepared.name, prepared.frames.front());
    if (is_png(path) || is_hdr(path)) {
        throw InputError("--output", printable(options.output),
                         "PNG and HDR cannot hold the channels of maps; write .exr");
    }
}

void write_frames(const FrameJob& job, const SceneOptions& options, const FrameRequest& request) {
    std::vector<FrameStatistics> statistics;
    std::size_t changed = 0;
    Progress progress(request.frame ? "render" : "maps", static_cast<double>(job.frames.size()),
                      progress_look(options.quiet));
    for (const int frame : job.frames) {
        const auto done = static_cast<double>(statistics.size());
        FrameRequest with_progress = request;
        with_progress.progress = [&](double fraction, const char* stage) {
            progress.update(done + fraction, fmt::format("frame {}: {}", frame, stage));
        };
        FrameOutput output = job.make(frame, with_progress);
        changed += write_frame(output_path(options.output, job.name, frame), job, output, request.maps);
        if (statistics.empty() && !options.quiet) warn_of_units(output.statistics);
        statistics.push_back(output.statistics);
        if (!options.quiet && job.settings.error > 0.0) print_error(output.statistics);
        progress.update(done + 1.0, fmt::format("frame {}", frame));
    }
    if (!options.quiet) warn_of_changed_values(changed);
    if (!options.stats.empty()) {
        write_file(options.stats, format_statistics(statistics, job.scene, job.settings, job.exposure));
    }
}

void render_frames(PreparedScene prepared, const SceneOptions& options, const FrameRequest& request,
                   const std::string& cache) {
    prepare_frames_output(prepared, options, request.maps);
    const ThreadLimit limit(options.threads);
    Sequence sequence(std::move(prepared.scene), prepared.settings, options.camera);
    if (!cache.empty()) sequence.load_light(cache);
    const auto make = [&](int frame, const FrameRequest& asked) { return sequence.render(frame, asked); };
    write_frames({sequence.scene(), prepared.settings, sequence.exposure(), prepared.frames, prepared.name, make},
                 options, request);
    if (!cache.empty()) sequence.save_light(cache);
}

}  // namespace aleph
