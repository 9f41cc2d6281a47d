#include "render/cli/write_frames.h"
#include "render/guide/error_report.h"

#include <fmt/format.h>

#include <iostream>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "render/cli/budget.h"
#include "render/cli/copied_frames.h"
#include "render/cli/output_conflicts.h"
#include "render/cli/output_path.h"
#include "render/cli/progress.h"
#include "render/cli/statistics_file.h"
#include "render/cli/verify.h"
#include "render/output/flow_file.h"
#include "render/output/frame_files.h"
#include "render/output/map_preview.h"
#include "render/settings/measure.h"

namespace aleph {

namespace {

void warn_of_changed_values(std::size_t count) {
    if (count == 0) return;
    std::cerr << fmt::format(
        "aleph: warning: {} values were below 0, NaN or too large for .hdr files, and were changed; write .exr to keep "
        "them\n",
        count);
}

/// Thresholds of vision are in cd/m2. In a scene of another unit every pixel is above or below all of them.
void warn_of_units(const FrameStatistics& frame) {
    const double median = frame.estimate.median_luminance;
    if (median == 0.0 || (median >= 1e-3 && median <= 1e4)) return;
    std::cerr << fmt::format(
        "aleph: warning: frame {}: the median luminance is {:.3g} cd/m2, outside 1e-3 to 1e4: check \"exposure\" and "
        "\"display_white\" of the scene\n",
        frame.frame, median);
}

/// Prints the share of the pixels that is estimated to err by more than was asked for, and why.
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

/// EXR: the channel Y. PNG: grey, its bytes in proportion to the values.
void write_importance(const std::filesystem::path& path, const FrameOutput& output) {
    const Image<float> importance = make_importance(output.perception.aleph);
    if (output_format(path) == OutputFormat::exr) {
        ChannelImage file;
        file.channels.push_back({"Y", importance});
        write_exr(path, file);
        return;
    }
    Image<Rgb> grey(importance.width, importance.height);
    for (std::size_t i = 0; i < grey.size(); ++i) grey.pixels[i] = Rgb(srgb_to_linear(importance.pixels[i]));
    write_png(path, grey);
}

/// Writes one frame, and adds the time for it to the frame's statistics.
/// @return how many values the format could not hold
std::size_t write_frame(const std::filesystem::path& path, const FrameJob& job, FrameOutput& output, bool maps,
                        bool importance) {
    StageClock clock;
    std::size_t changed = 0;
    switch (output_format(path)) {
        case OutputFormat::flow:
            write_flow(path, output.motion);
            break;
        case OutputFormat::png:
            if (importance) {
                write_importance(path, output);
            } else if (output.shaded.color.empty()) {
                write_map_preview(path, output);
            } else {
                write_png(path, output.shaded.color);
            }
            break;
        case OutputFormat::hdr:
            changed = write_hdr(path, output.shaded.color);
            break;
        case OutputFormat::exr:
            if (importance) {
                write_importance(path, output);
            } else {
                write_exr(path, make_frame_image(output, maps, job.scene, job.settings, job.exposure));
            }
            break;
    }
    StageSeconds& seconds = output.statistics.seconds;
    clock.add_to(seconds.write);
    seconds.total += seconds.write;
    return changed;
}

/// Share of the pixels of all frames that are estimated to err by more than was asked for, as far as frames tell.
class MeanEstimate {
  public:
    void add(const FrameStatistics& frame) {
        if (!frame.error) return;
        sum_ += frame.error->beyond;
        ++frames_;
    }
    std::optional<double> mean() const { return frames_ > 0 ? std::optional(sum_ / frames_) : std::nullopt; }

  private:
    double sum_ = 0.0;
    int frames_ = 0;
};

/// Says at the end which files there are now.
void print_files(const FrameJob& job, const SceneOptions& options) {
    const auto file = [&](int frame) { return printable(output_path(options.output, job.name, frame).string(), 400); };
    std::string text = fmt::format("aleph: wrote {}", file(job.frames.front()));
    if (job.frames.size() > 1) text += fmt::format(" to {} ({} frames)", file(job.frames.back()), job.frames.size());
    if (!options.stats.empty()) text += fmt::format(", statistics in {}", printable(options.stats, 400));
    std::cerr << text << "\n";
}

}  // namespace

void prepare_frames_output(const PreparedScene& prepared, const SceneOptions& options, const FrameRequest& request,
                           const std::string& cache) {
    const std::filesystem::path path = output_path(options.output, prepared.name, prepared.frames.front());
    const OutputFormat format = output_format(path);
    if (format == OutputFormat::flow && (request.frame || options.importance)) {
        throw InputError("--output", printable(options.output), "only `aleph maps` writes motion as .flo, by itself");
    }
    const bool instead = (format == OutputFormat::png || format == OutputFormat::flow) && !request.frame;
    if (request.maps && format != OutputFormat::exr && !instead) {
        throw InputError("--output", printable(options.output),
                         fmt::format("{} cannot hold the channels of maps; write .exr{}",
                                     format == OutputFormat::png ? "PNG" : "HDR",
                                     request.frame ? "" : ", or .png to look at them, or .flo for motion alone"));
    }
    std::vector<OutputFile> outputs;
    if (!options.stats.empty()) outputs.push_back({options.stats, "--stats"});
    if (!cache.empty()) outputs.push_back({cache, "--cache"});
    for (const int frame : prepared.frames)
        outputs.push_back({output_path(options.output, prepared.name, frame), "--output"});
    refuse_overwriting(prepared.read, outputs);
    prepare_output(options.output, prepared.name, prepared.frames);
    if (!options.stats.empty()) try_output(options.stats);
    if (!cache.empty()) try_output(cache);
}

void write_frames(const FrameJob& job, const SceneOptions& options, const FrameRequest& request) {
    std::optional<BudgetStatistics> budget;
    if (job.budget) budget = job.budget->statistics;
    StatisticsFile statistics(options.stats, job.scene, job.settings, job.exposure, budget);
    std::vector<FinishedFrame> finished;
    std::size_t changed = 0;
    MeanEstimate estimate;
    {
        Progress progress(request.frame ? "render" : "maps", static_cast<double>(job.frames.size()),
                          progress_look(options.quiet));
        for (const int frame : job.frames) {
            const auto done = static_cast<double>(finished.size());
            FrameRequest with_progress = request;
            with_progress.progress = [&](double fraction, const char* stage) {
                progress.update(done + fraction, fmt::format("frame {}: {}", frame, stage));
            };
            FrameOutput output = job.make(frame, with_progress);
            changed += write_frame(output_path(options.output, job.name, frame), job, output, request.maps,
                                   options.importance);
            if (finished.empty() && !options.quiet) warn_of_units(output.statistics);
            statistics.add(output.statistics);
            estimate.add(output.statistics);
            finished.push_back({frame, output.statistics.copy_of});
            if (!options.quiet && job.settings.error > 0.0) print_error(output.statistics);
            progress.update(done + 1.0, fmt::format("frame {}", frame));
        }
    }
    if (budget) {
        StageClock clock = job.budget->clock;
        clock.add_to(budget->took);
        statistics.set_budget(*budget);
    }
    statistics.finish();
    if (!options.quiet) {
        warn_of_changed_values(changed);
        std::cerr << describe_copies(finished);
        print_files(job, options);
        if (budget) std::cerr << describe_budget(*budget);
    }
    if (!job.verify) return;
    const VerifiedStatistics verified = job.verify(estimate.mean());
    std::cout << describe_verified(verified);
    statistics.set_verified(verified);
    statistics.finish();
}

void render_frames(PreparedScene prepared, const SceneOptions& options, const FrameRequest& request,
                   const std::string& cache, const std::optional<Budget>& budget, double verify) {
    prepare_frames_output(prepared, options, request, cache);
    const ThreadLimit limit(options.threads);
    std::optional<Scene> judged;
    if (verify > 0.0) judged = prepared.scene;  // with what --forbid leaves out
    Sequence sequence(std::move(prepared.scene), prepared.settings, options.camera);
    if (!cache.empty()) sequence.load_light(cache);
    PictureKeeper pictures = keep_pictures(sequence);
    const auto make = [&](int frame, const FrameRequest& asked) {
        FrameOutput output = sequence.render(frame, asked);
        if (judged) pictures.keep(frame, output.shaded.color);
        return output;
    };
    FrameJob job{
        sequence.scene(), prepared.settings, sequence.exposure(), prepared.frames, prepared.name, make, budget};
    if (judged) {
        judged->film.exposure = sequence.exposure();
        job.verify = [&](std::optional<double> estimated) {
            return verify_frames({std::move(*judged), prepared.settings, options.camera, prepared.frames, verify},
                                 pictures, estimated, progress_look(options.quiet));
        };
    }
    write_frames(job, options, request);
    if (!cache.empty()) sequence.save_light(cache);
}

}  // namespace aleph
