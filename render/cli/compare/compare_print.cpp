#include "render/cli/compare/compare_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/image/image_file.h"
#include "render/output/sheet.h"

namespace aleph {

namespace {

nlohmann::ordered_json pixels_json(const CompareResult& result, std::size_t count) {
    return {{"pixels", count}, {"percent", result.percent(count)}};
}

nlohmann::ordered_json luminance_json(const LuminanceDifference& luminance, const CompareResult& result) {
    return {{"bias_percent", 100.0 * luminance.bias}, {"bias_error_percent", 100.0 * luminance.bias_error},
            {"relative_mse", luminance.relative_mse}, {"noise_mse", luminance.noise_mse},
            {"has_variance", luminance.has_variance}, {"far", pixels_json(result, luminance.far)}};
}

void print_row(const std::string& name, const Difference& d, const std::string& place, const std::string& beyond) {
    fmt::print("  {:<24} {:>12.6g} {:>12} {:>12.6g} {:>12.6g} {:>12}\n", printable(name, 24), d.max_abs, place, d.rms,
               d.relative_mse, beyond);
}

void print_pixels(const std::string& what, const CompareResult& result, std::size_t count,
                  const std::string& note = {}) {
    fmt::print("  {:<24} {} of {} pixels ({:.4g} %){}\n", what, count, result.pixels(), result.percent(count), note);
}

void print_luminance(const CompareOptions& options, const CompareResult& result) {
    const LuminanceDifference& luminance = *result.luminance;
    const CompareSettings& settings = options.settings;
    const bool limited = settings.max_bias < unlimited || settings.max_relative_mse < unlimited;
    if (!luminance.has_variance && !limited) return;
    fmt::print("  {:<24} bias {:.4g} % (standard error {:.2g} %), relative MSE {:.4g}, of it noise {:.4g}\n",
               "luminance", 100.0 * luminance.bias, 100.0 * luminance.bias_error, luminance.relative_mse,
               luminance.noise_mse);
    if (!luminance.has_variance) return;
    const double deviations = settings.standard_errors.value_or(3.0);
    const bool tolerant = settings.tolerance > 0.0 || settings.relative > 0.0;
    print_pixels(fmt::format("beyond {:g} standard errors", deviations), result, luminance.far,
                 tolerant ? " and the tolerance"
                          : fmt::format(", by chance {:.2g} %", 100.0 * std::erfc(deviations / std::numbers::sqrt2)));
}

nlohmann::ordered_json difference_json(const Difference& d) {
    return {{"max", d.max_abs}, {"rms", d.rms}, {"relative_mse", d.relative_mse}};  // infinity becomes null
}

nlohmann::ordered_json threshold_json(const std::optional<ThresholdDifference>& figures) {
    if (!figures) return nullptr;
    nlohmann::ordered_json noise_json;
    if (const auto& noise = figures->noise) {
        noise_json = {{"median", noise->median},
                      {"percentile_99", noise->percentile_99},
                      {"beyond_percent", figures->percent(static_cast<double>(noise->beyond))},
                      {"expected_percent", figures->percent(noise->expected)},
                      {"certain_percent", figures->percent(static_cast<double>(noise->certain))}};
    }
    return {{"counted", figures->pixels},
            {"pixels", figures->beyond},
            {"percent", figures->percent_beyond()},
            {"percentile_99", figures->percentile_99},
            {"worst", figures->worst},
            {"noise", noise_json},
            {"display_white", figures->display_white}};
}

nlohmann::ordered_json shares_json(const std::optional<VisibleShares>& shares) {
    if (!shares) return nullptr;
    nlohmann::ordered_json json{{"seen", shares->seen}, {"flicker", shares->flicker}, {"lasting", shares->lasting}};
    json["noticed"] = shares->noticed ? nlohmann::ordered_json(*shares->noticed) : nlohmann::ordered_json();
    return json;
}

nlohmann::ordered_json comparison_json(const FrameComparison& comparison) {
    const CompareResult& result = comparison.result;
    nlohmann::ordered_json json{
        {"same", comparison.same}, {"size", {result.width, result.height}}, {"all", difference_json(result.all)}};
    json["colour"] = result.colour ? difference_json(*result.colour) : nlohmann::ordered_json();
    json["nan"] = {result.a.nan, result.b.nan};
    json["inf"] = {result.a.inf, result.b.inf};
    json["beyond"] = pixels_json(result, result.beyond);
    json["luminance"] = result.luminance ? luminance_json(*result.luminance, result) : nlohmann::ordered_json();
    json["threshold"] = threshold_json(result.threshold);
    json["exceeded"] = result.exceeded;
    json["channels"] = nlohmann::ordered_json::array();
    for (const ChannelDifference& channel : result.channels) {
        nlohmann::ordered_json entry{{"name", channel.name}};
        entry.update(difference_json(channel.difference));
        entry["at"] = {channel.x, channel.y};
        entry["beyond"] = channel.beyond;
        json["channels"].push_back(entry);
    }
    json["visible"] = shares_json(comparison.visible);
    return json;
}

nlohmann::ordered_json sequence_json(const std::vector<FrameComparison>& frames, const SequenceSummary& summary) {
    nlohmann::ordered_json json{{"same", summary.same()}, {"frames", nlohmann::ordered_json::array()}};
    for (const FrameComparison& frame : frames) {
        nlohmann::ordered_json entry{{"frame", frame.frame}};
        entry.update(comparison_json(frame));
        json["frames"].push_back(std::move(entry));
    }
    json["all"] = {{"frames", summary.frames},
                   {"different", summary.different},
                   {"worst_frame", summary.worst_frame},
                   {"max", summary.max_abs},
                   {"rms", summary.rms},
                   {"nan", {summary.a.nan, summary.b.nan}},
                   {"inf", {summary.a.inf, summary.b.inf}},
                   {"beyond", {{"pixels", summary.beyond}, {"percent", summary.percent(summary.beyond)}}},
                   {"threshold", threshold_json(summary.threshold)},
                   {"visible", shares_json(summary.visible)}};
    return json;
}

/// The reference's noise, and what it adds.
void print_noise(const ThresholdFigures& figures) {
    if (!figures.noise) return;
    const ReferenceNoise& noise = *figures.noise;
    fmt::print("  {:<24} {:.4g} % by more than 3 standard errors; by noise alone {:.4g} %\n", "beyond, less noise",
               figures.percent(static_cast<double>(noise.certain)), figures.percent(noise.expected));
    fmt::print("  {:<24} median {:.3g} thresholds, 99th percentile {:.3g}, beyond 1 {:.4g} %\n", "reference's noise",
               noise.median, noise.percentile_99, figures.percent(static_cast<double>(noise.beyond)));
}

std::string describe_not_finite(const CompareResult& result) {
    return fmt::format("NaN: {} and {}, infinite: {} and {}", result.a.nan, result.b.nan, result.a.inf, result.b.inf);
}

/// Three columns: percent beyond, 99th percentile, worst. Dashes if there are no pixels.
std::string figure_columns(const ThresholdFigures& figures) {
    if (figures.pixels == 0) return fmt::format(" {:>9} {:>8} {:>8}", "-", "-", "-");
    return fmt::format(" {:>9.4g} {:>8.3g} {:>8.3g}", figures.percent_beyond(), figures.percentile_99, figures.worst);
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
void print_columns(const std::optional<ThresholdDifference>& threshold, const std::optional<VisibleShares>& visible,
                   double beyond) {
    if (threshold) fmt::print("{}", figure_columns(*threshold));
    if (visible) fmt::print("{}", visible_columns(*visible));
    if (!threshold && !visible) fmt::print(" {:>9.4g}", beyond);
}

void print_frame(const FrameComparison& frame) {
    const CompareResult& result = frame.result;
    fmt::print("  {:>6} {:>10.4g} {:>10.4g}", frame.frame, result.all.max_abs, result.all.rms);
    print_columns(result.threshold, frame.visible, result.percent(result.counted));
    std::string note = frame.same ? "" : "different";
    if (const std::string limits = exceeded_options(result); !limits.empty()) note += " (" + limits + ")";
    if (result.a.any() || result.b.any()) note += ", " + describe_not_finite(result);
    fmt::print("{}{}\n", note.empty() ? "" : "  ", note);
}

void print_summary(const SequenceSummary& summary) {
    fmt::print("  {:>6} {:>10.4g} {:>10.4g}", "all", summary.max_abs, summary.rms);
    print_columns(summary.threshold, summary.visible, summary.percent(summary.beyond));
    fmt::print("\n");
    if (summary.threshold) {
        fmt::print("  white is {:g} cd/m2\n", summary.threshold->display_white);
        print_noise(*summary.threshold);
    }
    fmt::print("  {} of {} frames differ", summary.different, summary.frames);
    if (summary.max_abs != 0.0) fmt::print("; the largest difference is in frame {}", summary.worst_frame);
    fmt::print("\n");
}

}  // namespace

std::string exceeded_options(const CompareResult& result) {
    std::string options;
    for (std::string name : result.exceeded) {
        if (name == "share") continue;
        std::ranges::replace(name, '_', '-');
        options += (options.empty() ? "--" : ", --") + name;
    }
    return options;
}

void print_comparison(const CompareOptions& options, const FrameComparison& comparison) {
    if (options.json) return fmt::print("{}\n", comparison_json(comparison).dump(2));
    const auto& [frame, result, visible, same] = comparison;
    fmt::print("{} against {}: {}x{}\n", options.first, options.second, result.width, result.height);
    fmt::print("  {:<24} {:>12} {:>12} {:>12} {:>12} {:>12}\n", "channel", "max", "at x,y", "RMS", "relative MSE",
               "beyond");
    for (const ChannelDifference& channel : result.channels) {
        print_row(channel.name, channel.difference, fmt::format("{},{}", channel.x, channel.y),
                  fmt::format("{}", channel.beyond));
    }
    if (result.colour) print_row("R, G and B", *result.colour, "", "");
    if (result.a.any() || result.b.any()) fmt::print("  {}\n", describe_not_finite(result));
    if (!visible && !result.threshold) print_pixels("beyond the tolerance", result, result.beyond);
    if (result.luminance) print_luminance(options, result);
    if (const auto& threshold = result.threshold) {
        print_pixels("beyond the Aleph map", result, threshold->beyond,
                     fmt::format(", at worst {:.4g} thresholds; white is {:g} cd/m2", threshold->worst,
                                 threshold->display_white));
        print_noise(*threshold);
    }
    if (visible) {
        fmt::print("  {:<24} {:.4g} % of the pixels{}\n", "a difference is seen in", visible->seen,
                   visible->noticed ? fmt::format(", {:.4g} % weighed by saliency", *visible->noticed) : "");
    }
    if (const std::string limits = exceeded_options(result); !limits.empty()) {
        fmt::print("  {:<24} {}\n", "above its limit", limits);
    }
    fmt::print("{}\n", same ? "same" : "different");
}

void print_sequence(const CompareOptions& options, const std::vector<FrameComparison>& frames,
                    const SequenceSummary& summary) {
    if (options.json) return fmt::print("{}\n", sequence_json(frames, summary).dump(2));
    fmt::print("{} against {}: {} frames, {}x{}\n", options.first, options.second, frames.size(),
               frames.front().result.width, frames.front().result.height);
    print_head(summary);
    for (const FrameComparison& frame : frames) print_frame(frame);
    print_summary(summary);
    fmt::print("{}\n", summary.same() ? "same" : "different");
}

void write_seen(const std::filesystem::path& path, const VisibleMaps& maps) {
    if (lower_extension(path) == ".exr") {
        write_exr(path, {{{"seen.Y", maps.seen}, {"flicker.Y", maps.flicker}, {"lasting.Y", maps.lasting}}, {}});
        return;
    }
    const MapRange range{0.1, 10.0, true};
    write_sheet(path,
                {map_panel("seen, visible differences", maps.seen, range), map_panel("flicker", maps.flicker, range),
                 map_panel("lasting", maps.lasting, range)},
                3, maps.seen.width);
}

}  // namespace aleph
