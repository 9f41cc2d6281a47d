#include "render/cli/frame_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <numeric>
#include <thread>
#include <utility>

#include "engine/base/errors.h"
#include "render/cli/film.h"
#include "render/cli/frame_file.h"
#include "render/cli/support/progress.h"
#include "render/cli/support/render_signals.h"
#include "render/cli/support/statistics_file.h"
#include "render/cli/watch.h"
#include "render/cli/write_frames.h"
#include "render/guide/error_report.h"
#include "render/settings/frame_list.h"

namespace aleph {

namespace {

/// Thresholds of vision are in cd/m2. In a scene of another unit every pixel is above or below all of them.
void warn_of_units(const FrameStatistics& frame) {
    const double median = frame.estimate.median_luminance;
    if (median == 0.0 || (median >= 1e-3 && median <= 1e4)) return;
    std::cerr << fmt::format(
        "aleph: warning: frame {}: the median luminance is {:.3g} cd/m2, outside 1e-3 to 1e4: check \"exposure\" and "
        "\"display_white\" of the scene\n",
        frame.frame, median);
}

bool is_black(const Image<Rgb>& picture) {
    return !picture.empty() && std::ranges::all_of(picture.pixels, [](const Rgb& pixel) { return pixel == Rgb(0.0f); });
}

/// Prints the share of the pixels that is estimated to err by more than was asked for, and why.
void print_error(const FrameStatistics& frame) {
    if (!frame.error) return;
    const ErrorShares& shares = *frame.error;
    std::string causes;
    for (std::size_t i = 0; i < cause_count && shares.beyond > most_beyond; ++i) {
        if (shares.by_cause[i] < 0.1 * most_beyond) continue;
        causes += fmt::format("{}{} {} %", causes.empty() ? "; alone: " : ", ", cause_names()[i],
                              format_percent(shares.by_cause[i]));
    }
    std::cerr << fmt::format("aleph: frame {}: {} of the pixels err by more than {:g} visible threshold{}{}\n",
                             frame.frame, describe_estimate(shares.beyond), shares.asked,
                             shares.asked == 1.0 ? "" : "s", causes);
}

class FrameWriter {
  public:
    FrameWriter(const FrameJob& job, const SceneOptions& options, const FrameRequest& request, RenderSignals& signals)
        : job_(job),
          output_(job.claims.output()),
          options_(options),
          request_(request),
          statistics_(options.stats, job.scene, job.settings, job.exposure,
                      job.budget ? std::optional(job.budget->statistics) : std::nullopt),
          signals_(signals) {
        if (options.resume && !options.stats.empty()) rows_ = statistics_.take_over();
    }

    /// @throws Stopped
    void make_all() {
        const char* const title = request_.frame ? "render" : "maps";
        Progress progress(job_.title != nullptr ? job_.title : title, static_cast<double>(output_.frames.size()),
                          progress_look(options_.quiet, options_.progress));
        std::vector<std::size_t> left(output_.frames.size());
        std::iota(left.begin(), left.end(), 0);
        while (!left.empty()) {
            const std::size_t before = left.size();
            std::erase_if(left, [&](std::size_t place) { return !is_busy(place, progress); });
            if (left.size() < before || left.empty()) continue;
            stop_if_asked();
            progress.update(done_, fmt::format("frame {}: another process makes it", output_.frames[left.front()]));
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
        }
    }

    void finish() {
        keep_rows();
        statistics_.finish();
        if (options_.quiet) return;
        if (black_ == output_.frames.size())
            std::cerr << "aleph: warning: every pixel is black: no light reaches what the camera sees\n";
        std::cerr << describe_copies(made_);
        print_files();
    }

    StatisticsFile& statistics() { return statistics_; }

    /// Share of the pixels of all frames that are estimated to err by more than was asked for, as far as frames tell.
    std::optional<double> estimate() const {
        if (estimates_.empty()) return std::nullopt;
        return std::accumulate(estimates_.begin(), estimates_.end(), 0.0) / static_cast<double>(estimates_.size());
    }

    /// The frames whose error is not known, or whose share of pixels beyond is larger than most_beyond, in words;
    /// empty: there are none.
    std::string describe_missed() const {
        if (missed_.empty()) return "";
        return fmt::format(
            "in {} of {} frames more than {:g} % of the pixels err by more than was asked for, or it is not known: {}",
            missed_.size(), output_.frames.size(), 100.0 * most_beyond, printable(format_frame_list(missed_), 200));
    }

  private:
    /// Makes the frame unless it is finished. Returns whether another process makes it.
    bool is_busy(std::size_t place, Progress& progress) {
        const int frame = output_.frames[place];
        const Claim claim = job_.claims.claim(frame);
        if (claim == Claim::busy) return true;
        if (claim == Claim::ours) {
            make(place, progress);
            job_.claims.release(frame);
        } else {
            kept_.push_back(place);
            keep_row(place);
        }
        progress.update(++done_, fmt::format("frame {}", frame));
        return false;
    }

    void make(std::size_t place, Progress& progress) {
        const int frame = output_.frames[place];
        const std::filesystem::path file = output_.file(frame);
        const std::string fingerprint = output_.fingerprint(frame);
        std::optional<FrameCheckpoint> checkpoint;
        StageClock since;
        double waited = 0.0;
        bool is_lost = false;
        const auto is_due = [&] {
            since.add_to(waited);
            if (!std::exchange(has_begun_, true)) signals_.leave_time();
            const bool is_time = options_.checkpoint > 0.0 && waited >= options_.checkpoint;
            is_kept_ = is_time || (signals_.received() != 0 && !is_lost);
            if (is_kept_) waited = 0.0;
            return is_kept_;
        };
        const auto warn_once = [&](const OutputError& e) {  // the frame itself goes on
            is_kept_ = false;
            if (!std::exchange(is_lost, true)) std::cerr << "aleph: warning: " << e.what() << "\n";
        };
        if (options_.checkpoint > 0.0 || options_.time_limit > 0.0 ||
            (options_.resume && std::filesystem::exists(checkpoint_file(file))))
            checkpoint.emplace(checkpoint_file(file), fingerprint, is_due, warn_once);
        bool wants_picture = false;
        FrameRequest watched = request_;
        watched.progress = [&](double fraction, const char* stage) {
            stop_if_kept();
            if (signals_.take_status_request()) {
                wants_picture = true;
                std::cerr << fmt::format("aleph: {} of {} frames are finished; frame {}: {}, {:.0f} %\n",
                                         kept_.size() + made_.size(), output_.frames.size(), frame, stage,
                                         100.0 * fraction);
            }
            progress.update(done_ + fraction, fmt::format("frame {}: {}", frame, stage));
        };
        watched.checkpoint = checkpoint ? &*checkpoint : nullptr;
        watched.partial.is_wanted = [&] { return std::exchange(wants_picture, false); };
        watched.partial.show = [&](const Image<Rgb>& color) {
            try {
                write_partial(file, color, request_.window, fingerprint);
            } catch (const OutputError& e) {  // the frame itself goes on
                std::cerr << "aleph: warning: " << e.what() << "\n";
            }
        };
        stop_if_kept();
        finish(place, job_.make(frame, watched));
        is_kept_ = true;
    }

    /// Writes the frame after its light and statistics, which no later run makes once the frame is there. The frame is
    /// written where they cannot be.
    /// @throws OutputError
    void finish(std::size_t place, FrameOutput output) {
        const int frame = output_.frames[place];
        const std::filesystem::path file = output_.file(frame);
        const std::string fingerprint = output_.fingerprint(frame);
        std::exception_ptr lost;
        const auto keep = [&](const auto& write) {
            try {
                write();
            } catch (const OutputError&) {
                lost = std::current_exception();
            }
        };
        if (job_.keep_light) keep(job_.keep_light);
        keep([&] { statistics_.note(output.statistics, fingerprint); });
        write_frame(file, job_, output, request_.maps, options_.importance, fingerprint);
        remove_unfinished(file);
        if (options_.watch != nullptr && options_.film.empty()) options_.watch->show(file);
        statistics_.add(place, output.statistics, fingerprint);
        if (made_.empty() && !options_.quiet) warn_of_units(output.statistics);
        if (output.statistics.error) estimates_.push_back(output.statistics.error->beyond);
        if (!output.statistics.error || output.statistics.error->beyond > most_beyond) missed_.push_back(frame);
        made_.push_back({frame, output.statistics.copy_of});
        if (is_black(output.shaded.color)) ++black_;
        if (!options_.quiet && job_.settings.error > 0.0) print_error(output.statistics);
        if (lost) std::rethrow_exception(lost);
    }

    /// A limit of time waits until something new is kept, and until that took as long as what came before, which every
    /// process does again: so a chain of processes ends, and takes little more than twice as long as one.
    void stop_if_kept() const {
        if (is_kept_ || signals_.received() != SIGALRM) stop_if_asked();
    }

    void stop_if_asked() const {
        if (options_.watch != nullptr && options_.watch->is_changed()) throw SceneChanged();
        if (signals_.received() == 0) return;
        const char* const advice = !options_.has_resume ? ""
                                   : options_.resume    ? "; the same command goes on with the others"
                                                        : "; the same command with --resume makes the others";
        signals_.stop_if_asked(
            fmt::format(": {} of {} frames are finished{}", kept_.size() + made_.size(), output_.frames.size(), advice),
            options_.resume);
    }

    /// Keeps the statistics of a frame that was finished before. Returns whether there are any.
    bool keep_row(std::size_t place) {
        if (options_.stats.empty()) return true;
        const auto row = rows_.find(output_.fingerprint(output_.frames[place]));
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

    void print_files() const {
        const auto file = [&](int frame) { return printable(output_.file(frame).string(), 400); };
        std::string text = fmt::format("aleph: wrote {}", file(output_.frames.front()));
        if (!options_.film.empty()) {
            text = fmt::format("aleph: {} frames of {}", output_.frames.size(), printable(options_.film, 400));
        } else if (output_.frames.size() > 1)
            text += fmt::format(" to {} ({} frames)", file(output_.frames.back()), output_.frames.size());
        if (!kept_.empty()) text += fmt::format(", {} of them finished before or by other processes", kept_.size());
        if (!options_.stats.empty()) text += fmt::format(", statistics in {}", printable(options_.stats, 400));
        std::cerr << text << "\n";
        if (job_.claims.replaced() == 0) return;
        std::cerr << fmt::format(
            "aleph: replaced {}: damaged, or of another scene, other settings or another program\n",
            count_text(static_cast<std::size_t>(job_.claims.replaced()), "file"));
    }

    const FrameJob& job_;
    const ClaimedOutput& output_;
    const SceneOptions& options_;
    const FrameRequest& request_;
    StatisticsFile statistics_;
    RenderSignals& signals_;
    std::map<std::string, std::string> rows_;  ///< of an earlier run, by fingerprint
    std::vector<FinishedFrame> made_;
    std::vector<std::size_t> kept_;  ///< places of frames that others made
    bool has_begun_ = false;         ///< what no process before has made
    bool is_kept_ = false;           ///< all that this process has made, and it is not nothing
    double done_ = 0.0;              ///< frames
    std::size_t black_ = 0;          ///< frames
    std::vector<double> estimates_;  ///< of the frames that tell
    std::vector<int> missed_;        ///< frames of describe_missed
};

}  // namespace

std::string describe_estimate(double share) {
    return share > most_beyond ? fmt::format("about {} %", format_percent(share))
                               : fmt::format("about {:g} % or less", 100.0 * most_beyond);
}

void write_frames(const FrameJob& job, const SceneOptions& options, const FrameRequest& request) {
    RenderSignals signals;
    FrameWriter writer(job, options, request, signals);
    writer.make_all();
    std::optional<BudgetStatistics> budget;
    if (job.budget) {
        budget = job.budget->statistics;
        StageClock clock = job.budget->clock;
        clock.add_to(budget->took);
        writer.statistics().set_budget(*budget);
    }
    writer.finish();
    if (!options.film.empty()) finish_film(job, options);
    if (!options.quiet && budget) std::cerr << describe_budget(*budget);
    std::string missed = options.strict ? writer.describe_missed() : "";
    if (job.verify) {
        const VerifiedStatistics verified = job.verify(writer.estimate());
        std::cout << describe_verified(verified) << std::flush;
        writer.statistics().set_verified(verified);
        writer.statistics().finish();
        signals.stop_if_asked(": all frames are written, and checked as far as said");
        if (options.strict && verified.beyond.share > most_beyond)
            missed += fmt::format("{}measured over all frames: {} %", missed.empty() ? "" : "; ",
                                  format_percent(verified.beyond.share));
    }
    if (!missed.empty()) throw Stopped("--strict: " + missed, exit_beyond);
}

}  // namespace aleph
