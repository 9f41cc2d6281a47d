#include "render/cli/compare/compare_frames_print.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "render/cli/compare/compare_print.h"

namespace aleph {

namespace {

const char* flicker_unit(const FlickerFigures& flicker) {
    return flicker.own_threshold ? "threshold.flicker" : "threshold.Y";
}

nlohmann::ordered_json flicker_json(const std::optional<FlickerFigures>& flicker) {
    if (!flicker) return nullptr;
    return {{"threshold", flicker_unit(*flicker)},
            {"percent", flicker->percent_beyond()},
            {"rest", figures_json(flicker->rest)},
            {"moving", figures_json(flicker->moving)},
            {"left_out", flicker->left_out}};
}

/// Three columns: percent beyond, 99th percentile, worst. Dashes if there are no pixels.
std::string figure_columns(const ThresholdFigures* figures) {
    if (!figures || figures->pixels == 0) return fmt::format(" {:>9} {:>8} {:>8}", "-", "-", "-");
    return fmt::format(" {:>9.4g} {:>8.3g} {:>8.3g}", figures->percent_beyond(), figures->percentile_99,
                       figures->worst);
}

std::string flicker_columns(const std::optional<FlickerFigures>& flicker) {
    return figure_columns(flicker ? &flicker->rest : nullptr) + figure_columns(flicker ? &flicker->moving : nullptr);
}

void print_head(bool with_threshold) {
    if (with_threshold) {
        fmt::print("  {:>6} {:>10} {:>10} {:>27} {:>27} {:>27}\n", "", "", "", "error, thresholds", "flicker at rest",
                   "flicker moving");
    }
    fmt::print("  {:>6} {:>10} {:>10}", "frame", "max", "RMS");
    if (with_threshold) {
        for (int i = 0; i < 3; ++i) fmt::print(" {:>9} {:>8} {:>8}", "beyond, %", "99 %", "worst");
    } else {
        fmt::print(" {:>9}", "beyond, %");
    }
    fmt::print("\n");
}

void print_frame(const FrameComparison& frame) {
    const CompareResult& result = frame.result;
    fmt::print("  {:>6} {:>10.4g} {:>10.4g}", frame.frame, result.all.max_abs, result.all.rms);
    if (result.threshold) {
        fmt::print("{}{}", figure_columns(&*result.threshold), flicker_columns(frame.flicker));
    } else {
        fmt::print(" {:>9.4g}", result.percent(result.beyond));
    }
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
    if (!summary.threshold) {
        fmt::print(" {:>9.4g}\n", summary.percent(summary.beyond));
    } else {
        fmt::print("{}{}\n", figure_columns(&*summary.threshold), flicker_columns(summary.flicker));
        fmt::print("  white is {:g} cd/m2\n", summary.threshold->display_white);
        print_less_noise("beyond, less noise", *summary.threshold);
    }
    if (const auto& flicker = summary.flicker) {
        print_less_noise("flicker at rest", flicker->rest);
        print_less_noise("flicker moving", flicker->moving);
    }
    if (summary.threshold) print_noise(*summary.threshold);
    if (const auto& flicker = summary.flicker) {
        fmt::print("  flicker: {} pairs of frames, in units of {}; {} pixels left out\n", summary.flicker_pairs,
                   flicker_unit(*flicker), flicker->left_out);
    } else if (summary.threshold) {
        fmt::print("  flicker: no pair of consecutive frames with forward.u, forward.v and motion.valid\n");
    }
    fmt::print("  {} of {} frames differ; the largest difference is in frame {}\n", summary.different, summary.frames,
               summary.worst_frame);
}

}  // namespace

void print_sequence(const CompareOptions& options, const std::vector<FrameComparison>& frames,
                    const SequenceSummary& summary) {
    fmt::print("{} against {}: {} frames, {}x{}\n", options.first, options.second, frames.size(),
               frames.front().result.width, frames.front().result.height);
    print_head(summary.threshold.has_value());
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
        entry["flicker"] = flicker_json(frame.flicker);
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
           {"flicker_pairs", summary.flicker_pairs},
           {"flicker", flicker_json(summary.flicker)}};
    if (summary.threshold) {
        all["threshold"] = figures_json(*summary.threshold);
        all["threshold"]["display_white"] = summary.threshold->display_white;
    }
    fmt::print("{}\n", json.dump(2));
}

}  // namespace aleph
