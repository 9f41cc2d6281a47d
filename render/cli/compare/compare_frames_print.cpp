#include "render/cli/compare/compare_frames_print.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "render/cli/compare/compare_print.h"

namespace aleph {

namespace {

/// Three columns: percent beyond, 99th percentile, worst. Dashes if there are no pixels.
std::string figure_columns(const ThresholdFigures* figures) {
    if (figures->pixels == 0) return fmt::format(" {:>9} {:>8} {:>8}", "-", "-", "-");
    return fmt::format(" {:>9.4g} {:>8.3g} {:>8.3g}", figures->percent_beyond(), figures->percentile_99,
                       figures->worst);
}

/// Four columns: seen, flicker, lasting, noticed, percent.
std::string visible_columns(const VisibleShares& shares) {
    return fmt::format(" {:>9.3g} {:>9.3g} {:>9.3g} {:>9}", shares.seen, shares.flicker, shares.lasting,
                       shares.noticed ? fmt::format("{:.3g}", *shares.noticed) : "-");
}

void print_head(const SequenceSummary& summary) {
    fmt::print("  {:>6} {:>10} {:>10}", "", "", "");
    if (summary.threshold) fmt::print(" {:>27}", "error, thresholds");
    if (summary.visible) fmt::print(" {:>39}", "visible differences, % of the pixels");
    fmt::print("\n  {:>6} {:>10} {:>10}", "frame", "max", "RMS");
    if (summary.threshold) fmt::print(" {:>9} {:>8} {:>8}", "beyond, %", "99 %", "worst");
    if (summary.visible) fmt::print(" {:>9} {:>9} {:>9} {:>9}", "seen", "flicker", "lasting", "noticed");
    if (!summary.threshold && !summary.visible) fmt::print(" {:>9}", "beyond, %");
    fmt::print("\n");
}

/// The columns after max and RMS.
void print_columns(const ThresholdFigures* threshold, const std::optional<VisibleShares>& visible, double beyond) {
    if (threshold) fmt::print("{}", figure_columns(threshold));
    if (visible) fmt::print("{}", visible_columns(*visible));
    if (!threshold && !visible) fmt::print(" {:>9.4g}", beyond);
}

void print_frame(const FrameComparison& frame) {
    const CompareResult& result = frame.result;
    fmt::print("  {:>6} {:>10.4g} {:>10.4g}", frame.frame, result.all.max_abs, result.all.rms);
    print_columns(result.threshold ? &*result.threshold : nullptr, frame.visible, result.percent(result.beyond));
    std::string note = frame.same ? "" : "different";
    if (const std::string limits = exceeded_options(result); !limits.empty()) note += " (" + limits + ")";
    if (result.a.any() || result.b.any()) {
        note += fmt::format(", NaN: {} and {}, infinite: {} and {}", result.a.nan, result.b.nan, result.a.inf,
                            result.b.inf);
    }
    fmt::print("{}{}\n", note.empty() ? "" : "  ", note);
}

void print_summary(const SequenceSummary& summary) {
    fmt::print("  {:>6} {:>10.4g} {:>10.4g}", "all", summary.max_abs, summary.rms);
    print_columns(summary.threshold ? &*summary.threshold : nullptr, summary.visible, summary.percent(summary.beyond));
    fmt::print("\n");
    if (summary.threshold) {
        fmt::print("  white is {:g} cd/m2\n", summary.threshold->display_white);
        print_less_noise("beyond, less noise", *summary.threshold);
        print_noise(*summary.threshold);
    }
    fmt::print("  {} of {} frames differ; the largest difference is in frame {}\n", summary.different, summary.frames,
               summary.worst_frame);
}

}  // namespace

void print_sequence(const CompareOptions& options, const std::vector<FrameComparison>& frames,
                    const SequenceSummary& summary) {
    fmt::print("{} against {}: {} frames, {}x{}\n", options.first, options.second, frames.size(),
               frames.front().result.width, frames.front().result.height);
    print_head(summary);
    for (const FrameComparison& frame : frames) print_frame(frame);
    print_summary(summary);
    fmt::print("{}\n", summary.same() ? "same" : "different");
}

void print_sequence_json(const std::vector<FrameComparison>& frames, const SequenceSummary& summary) {
    nlohmann::ordered_json json{{"same", summary.same()}, {"frames", nlohmann::ordered_json::array()}};
    for (const FrameComparison& frame : frames) {
        nlohmann::ordered_json entry{{"frame", frame.frame}};
        entry.update(comparison_json(frame.result));
        entry["same"] = frame.same;
        entry["visible"] = shares_json(frame.visible);
        json["frames"].push_back(std::move(entry));
    }
    nlohmann::ordered_json& all = json["all"];
    all = {{"frames", summary.frames},
           {"different", summary.different},
           {"worst_frame", summary.worst_frame},
           {"max", summary.max_abs},
           {"rms", summary.rms},
           {"nan", {summary.a.nan, summary.b.nan}},
           {"inf", {summary.a.inf, summary.b.inf}},
           {"beyond", {{"pixels", summary.beyond}, {"percent", summary.percent(summary.beyond)}}},
           {"threshold", nullptr},
           {"visible", shares_json(summary.visible)}};
    if (summary.threshold) {
        all["threshold"] = figures_json(*summary.threshold);
        all["threshold"]["display_white"] = summary.threshold->display_white;
    }
    fmt::print("{}\n", json.dump(2));
}

}  // namespace aleph
