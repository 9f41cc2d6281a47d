#include "render/cli/write_frames.h"
#include "render/guide/error_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <iostream>
#include <map>
#include <numeric>
#include <thread>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "render/cli/budget.h"
#include "render/cli/copied_frames.h"
#include "render/cli/output_conflicts.h"
#include "render/cli/output_path.h"
#include "render/cli/progress.h"
#include "render/cli/statistics_file.h"
#include "render/cli/stop_signals.h"
#include "render/cli/verify.h"
#include "render/output/flow_file.h"
#include "render/output/frame_files.h"
#include "render/output/map_preview.h"
#include "render/settings/fingerprint.h"
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

ChannelImage with_texts(ChannelImage image, const PictureTexts& texts) {
    for (const auto& [key, text] : texts) image.metadata[key] = text;
    return image;
}

/// EXR: the channel Y. PNG: grey, its bytes in proportion to the values.
void write_importance(const std::filesystem::path& path, const FrameOutput& output, const PictureTexts& texts) {
    const Image<float> importance = make_importance(output.perception.aleph);
    if (output_format(path) == OutputFormat::exr) {
        ChannelImage file;
        file.channels.push_back({"Y", importance});
        write_exr(path, with_texts(std::move(file), texts));
        return;
    }
    Image<Rgb> grey(importance.width, importance.height);
    for (std::size_t i = 0; i < grey.size(); ++i) grey.pixels[i] = Rgb(srgb_to_linear(importance.pixels[i]));
    write_png(path, grey, texts);
}

/// Writes one frame, and adds the time for it to the frame's statistics.
/// @return how many values the format could not hold
std::size_t write_frame(const std::filesystem::path& path, const FrameJob& job, FrameOutput& output, bool maps,
                        bool importance, const std::string& fingerprint) {
    StageClock clock;
    std::size_t changed = 0;
    const PictureTexts texts{{fingerprint_key, fingerprint}};
    switch (output_format(path)) {
        case OutputFormat::flow:
            write_flow(path, output.motion);
            break;
        case OutputFormat::png:
            if (importance) {
                write_importance(path, output, texts);
            } else if (output.shaded.color.empty()) {
                write_map_preview(path, output, texts);
            } else {
                write_png(path, output.shaded.color, texts);
            }
            break;
        case OutputFormat::hdr:
            changed = write_hdr(path, output.shaded.color, texts);
            break;
        case OutputFormat::exr:
            if (importance) {
                write_importance(path, output, texts);
            } else {
                write_exr(path,
                          with_texts(make_frame_image(output, maps, job.scene, job.settings, job.exposure), texts));
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

/// Makes and writes the frames of a job.
class FrameWriter {
  public:
    FrameWriter(const FrameJob& job, const SceneOptions& options, const FrameRequest& request,
                const std::optional<BudgetStatistics>& budget)
        : job_(job),
          options_(options),
          request_(request),
          statistics_(options.stats, job.scene, job.settings, job.exposure, budget) {
        if (options.resume && !options.stats.empty()) rows_ = read_statistics_rows(options.stats);
    }

    /// @throws Stopped
    void make_all() {
        const StopSignals signals;
        Progress progress(request_.frame ? "render" : "maps", static_cast<double>(job_.frames.size()),
                          progress_look(options_.quiet));
        std::vector<std::size_t> left(job_.frames.size());
        std::iota(left.begin(), left.end(), 0);
        while (!left.empty()) {
            const std::size_t before = left.size();
            std::erase_if(left, [&](std::size_t place) { return !is_busy(place, progress, signals); });
            if (left.size() < before || left.empty()) continue;
            stop_if_asked(signals);
            progress.update(done_, fmt::format("frame {}: another process makes it", job_.frames[left.front()]));
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
        }
    }

    void finish() {
        keep_rows();
        statistics_.finish();
        if (options_.quiet) return;
        warn_of_changed_values(changed_);
        std::cerr << describe_copies(made_);
        print_files();
    }

    StatisticsFile& statistics() { return statistics_; }
    std::optional<double> estimate() const { return estimate_.mean(); }

  private:
    /// Makes the frame unless it is finished. Returns whether another process makes it.
    bool is_busy(std::size_t place, Progress& progress, const StopSignals& signals) {
        const int frame = job_.frames[place];
        const Claim claim = job_.claims.claim(frame);
        if (claim == Claim::busy) return true;
        if (claim == Claim::ours) {
            make(place, progress, signals);
            job_.claims.release(frame);
        } else {
            kept_.push_back(place);
            keep_row(place);
        }
        progress.update(++done_, fmt::format("frame {}", frame));
        return false;
    }

    void make(std::size_t place, Progress& progress, const StopSignals& signals) {
        const int frame = job_.frames[place];
        FrameRequest with_progress = request_;
        with_progress.progress = [&](double fraction, const char* stage) {
            stop_if_asked(signals);
            progress.update(done_ + fraction, fmt::format("frame {}: {}", frame, stage));
        };
        stop_if_asked(signals);
        FrameOutput output = job_.make(frame, with_progress);
        const std::string fingerprint = job_.fingerprint(frame);
        if (job_.keep_light) job_.keep_light();
        statistics_.note(output.statistics, fingerprint);
        changed_ += write_frame(output_path(options_.output, job_.name, frame), job_, output, request_.maps,
                                options_.importance, fingerprint);
        statistics_.add(place, output.statistics, fingerprint);
        if (made_.empty() && !options_.quiet) warn_of_units(output.statistics);
        estimate_.add(output.statistics);
        made_.push_back({frame, output.statistics.copy_of});
        if (!options_.quiet && job_.settings.error > 0.0) print_error(output.statistics);
    }

    void stop_if_asked(const StopSignals& signals) const {
        if (signals.received() == 0) return;
        const std::size_t finished = kept_.size() + made_.size();
        throw Stopped(fmt::format("stopped by {}: {} of {} frames are finished; {}",
                                  signals.received() == SIGINT ? "SIGINT" : "SIGTERM", finished, job_.frames.size(),
                                  options_.resume ? "the same command goes on with the others"
                                                  : "the same command with --resume makes the others"),
                      options_.resume ? static_cast<int>(exit_again) : 128 + signals.received());
    }

    /// Keeps the statistics of a frame that was finished before. Returns whether there are any.
    bool keep_row(std::size_t place) {
        if (options_.stats.empty()) return true;
        const auto row = rows_.find(job_.fingerprint(job_.frames[place]));
        if (row != rows_.end()) statistics_.keep(place, row->second);
        return row != rows_.end();
    }

    /// The same for frames of other processes, which have written theirs meanwhile.
    void keep_rows() {
        if (options_.stats.empty() || kept_.empty()) return;
        rows_.merge(read_statistics_rows(options_.stats));
        const auto missing = std::ranges::count_if(kept_, [this](std::size_t place) { return !keep_row(place); });
        if (missing == 0 || options_.quiet) return;
        std::cerr << fmt::format("aleph: warning: there are no statistics of {} frame{} that {} finished before\n",
                                 missing, missing == 1 ? "" : "s", missing == 1 ? "was" : "were");
    }

    /// Says at the end which files there are now.
    void print_files() const {
        const auto file = [&](int frame) {
            return printable(output_path(options_.output, job_.name, frame).string(), 400);
        };
        std::string text = fmt::format("aleph: wrote {}", file(job_.frames.front()));
        if (job_.frames.size() > 1)
            text += fmt::format(" to {} ({} frames)", file(job_.frames.back()), job_.frames.size());
        if (!kept_.empty()) text += fmt::format(", {} of them finished before or by other processes", kept_.size());
        if (!options_.stats.empty()) text += fmt::format(", statistics in {}", printable(options_.stats, 400));
        std::cerr << text << "\n";
        if (job_.claims.replaced() == 0) return;
        std::cerr << fmt::format(
            "aleph: replaced {} file{}: cut, or of another scene, other settings or another program\n",
            job_.claims.replaced(), job_.claims.replaced() == 1 ? "" : "s");
    }

    const FrameJob& job_;
    const SceneOptions& options_;
    const FrameRequest& request_;
    StatisticsFile statistics_;
    std::map<std::string, std::string> rows_;  ///< of an earlier run, by fingerprint
    std::vector<FinishedFrame> made_;
    std::vector<std::size_t> kept_;  ///< places of frames that others made
    double done_ = 0.0;              ///< frames
    std::size_t changed_ = 0;
    MeanEstimate estimate_;
};

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
    const bool keeps_file =
        !cache.empty() && std::filesystem::path(cache).has_filename() && !std::filesystem::is_directory(cache);
    if (keeps_file) outputs.push_back({cache, "--cache"});
    for (const int frame : prepared.frames)
        outputs.push_back({output_path(options.output, prepared.name, frame), "--output"});
    refuse_overwriting(prepared.read, outputs);
    prepare_output(options.output, prepared.name, prepared.frames);
    if (!options.stats.empty()) try_output(options.stats);
    if (keeps_file) try_output(cache);
}

FrameClaims claim_frames(const PreparedScene& prepared, const SceneOptions& options, const FramePrints& prints) {
    const auto file = [pattern = options.output, name = prepared.name](int frame) {
        return output_path(pattern, name, frame);
    };
    return FrameClaims({prepared.frames, file, prints.of, prints.identity, options.resume});
}

void write_frames(const FrameJob& job, const SceneOptions& options, const FrameRequest& request) {
    std::optional<BudgetStatistics> budget;
    if (job.budget) budget = job.budget->statistics;
    FrameWriter writer(job, options, request, budget);
    writer.make_all();
    if (budget) {
        StageClock clock = job.budget->clock;
        clock.add_to(budget->took);
        writer.statistics().set_budget(*budget);
    }
    writer.finish();
    if (!options.quiet && budget) std::cerr << describe_budget(*budget);
    if (!job.verify) return;
    const VerifiedStatistics verified = job.verify(writer.estimate());
    std::cout << describe_verified(verified);
    writer.statistics().set_verified(verified);
    writer.statistics().finish();
}

void render_frames(PreparedScene prepared, const SceneOptions& options, const FrameRequest& request,
                   const std::string& cache, const std::optional<Budget>& budget, double verify) {
    prepare_frames_output(prepared, options, request, cache);
    const ThreadLimit limit(find_threads(options.threads));
    const FramePrints prints = fingerprint_frames(prepared, options, request);
    FrameClaims claims = claim_frames(prepared, options, prints);
    if (options.resume && options.stats.empty() &&
        std::ranges::all_of(prepared.frames, [&](int frame) { return claims.is_finished(frame); })) {
        if (!options.quiet)
            std::cerr << fmt::format("aleph: all {} frames were finished before\n", prepared.frames.size());
        return;
    }
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
    FrameJob job{sequence.scene(), prepared.settings, sequence.exposure(),
                 prepared.frames,  prepared.name,     make,
                 claims,           prints.of,         budget};
    if (!cache.empty()) job.keep_light = [&] { sequence.save_light(); };
    if (judged) {
        judged->film.exposure = sequence.exposure();
        job.verify = [&](std::optional<double> estimated) {
            return verify_frames({std::move(*judged), prepared.settings, options.camera, prepared.frames, verify},
                                 pictures, estimated, progress_look(options.quiet));
        };
    }
    write_frames(job, options, request);
}

}  // namespace aleph
