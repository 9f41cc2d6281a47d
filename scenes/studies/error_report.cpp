#include "scenes/studies/error_report.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/base/atomic_file.h"

namespace aleph {

namespace {

using Json = nlohmann::ordered_json;

Json statistics_of(const ErrorRun& run) {
    return Json::parse(run.statistics).at("frames").at(0);
}

Json error_json(const PictureError& error) {
    Json beyond = Json::array();
    for (const BeyondShare& share : error.beyond) {
        beyond.push_back({{"thresholds", share.thresholds},
                          {"percent", share.percent},
                          {"certain", share.certain},
                          {"by_noise", share.by_noise}});
    }
    return {{"pixels", error.pixels},
            {"beyond", beyond},
            {"median", error.median},
            {"percentile_99_5", error.percentile_99_5},
            {"worst", error.worst},
            {"bias", error.bias},
            {"bias_error", error.bias_error},
            {"reference", {{"median", error.noise_median}, {"percentile_99", error.noise_percentile_99}}}};
}

Json cost_json(const FrameCost& cost) {
    Json stages = Json::object();
    for (const auto& [stage, seconds] : cost.stages) stages[stage] = seconds;
    return {{"seconds", cost.seconds()},
            {"frame_seconds", cost.frame_seconds},
            {"moment_seconds", cost.moment_seconds},
            {"clock_seconds", cost.clock_seconds},
            {"stages", stages},
            {"rays", cost.rays},
            {"mean_samples", cost.mean_samples},
            {"most_samples", cost.most_samples}};
}

Json run_json(const ErrorRun& run) {
    Json json{{"settings", run.name}, {"error", error_json(run.error)}, {"cost", cost_json(run.cost)}};
    if (run.claim) {
        json["claim"] = {{"median_ratio", run.claim->median_ratio},
                         {"understated", run.claim->understated},
                         {"dearest", run.claim->dearest},
                         {"beyond_by_cause", run.claim->beyond_by_cause},
                         {"samples_by_cause", run.claim->samples_by_cause}};
    }
    json["statistics"] = statistics_of(run);
    return json;
}

Json study_json(const ErrorStudy& study) {
    Json json{{"frame", study.frame.name},
              {"size", fmt::format("{}x{}", study.frame.settings.width, study.frame.settings.height)},
              {"reference",
               {{"passes", reference_passes(study.frame.reference)},
                {"seconds", reference_seconds(study.frame.reference)},
                {"noisy_percent", study.noise.noisy_percent}}},
              {"map_seconds", study.frame.map_seconds},
              {"runs", Json::array()},
              {"fixed", Json::array()},
              {"equal_share", Json::array()}};
    for (const ErrorRun& run : study.runs) json["runs"].push_back(run_json(run));
    for (const ErrorRun& run : study.fixed) json["fixed"].push_back(run_json(run));
    for (const EqualShare& share : study.shares) {
        Json entry{{"thresholds", share.goal.thresholds}, {"percent", share.goal.percent}, {"of", share.asked}};
        if (share.cost) entry["seconds"] = share.cost->seconds();
        if (share.fixed) {
            entry["fixed"] = {{"settings", share.fixed->name},
                              {"seconds", share.fixed->seconds},
                              {"frame_seconds", share.fixed->frame_seconds},
                              {"at_most", share.fixed->at_most}};
        }
        json["equal_share"].push_back(entry);
    }
    return json;
}

std::string ratio(double fixed, double seconds, bool at_most) {
    return fmt::format("{}{:.2f}", at_most ? "<= " : "", fixed / std::max(seconds, 1e-9));
}

}  // namespace

std::optional<double> claimed_percent(const ErrorRun& run) {
    const Json statistics = statistics_of(run);
    const auto found = statistics.find("error");
    if (found == statistics.end() || !found->contains("share_beyond")) return std::nullopt;
    return 100.0 * found->at("share_beyond").get<double>();
}

void print_references(const std::vector<ErrorStudy>& studies, bool markdown) {
    const StudyTable table(
        {"frame", "passes", "seconds", "noise: median", "99 %", "above .1 (%)", "maps (s)", "bias against paths (%)"},
        1, markdown);
    for (const ErrorStudy& study : studies) {
        const PictureError& noise = study.noise;
        table.add({study.frame.name, fmt::format("{:.0f}", reference_passes(study.frame.reference)),
                   fmt::format("{:.0f}", reference_seconds(study.frame.reference)),
                   fmt::format("{:.3f}", noise.noise_median), fmt::format("{:.3f}", noise.noise_percentile_99),
                   fmt::format("{:.1f}", noise.noisy_percent), fmt::format("{:.2f}", study.frame.map_seconds),
                   study.against_paths ? fmt::format("{:+.3f} +- {:.3f}", 100.0 * study.against_paths->bias,
                                                     100.0 * study.against_paths->bias_error)
                                       : std::string("-")});
    }
}

StudyTable start_run_table(const std::vector<double>& multiples, bool markdown) {
    std::vector<std::string> columns = {"frame", "settings"};
    for (const double multiple : multiples) {
        columns.push_back(fmt::format("beyond {:g} (%)", multiple));
        columns.push_back("certain");
        columns.push_back("by noise");
    }
    for (const char* column :
         {"median", "99.5 %", "bias (%)", "seconds", "moments", "rays (M)", "samples", "most", "claimed (%)"}) {
        columns.emplace_back(column);
    }
    return StudyTable(columns, 2, markdown);
}

void add_run(const StudyTable& table, const JudgedFrame& frame, const ErrorRun& run) {
    std::vector<std::string> cells = {frame.name, run.name};
    for (const BeyondShare& share : run.error.beyond) {
        for (const double percent : {share.percent, share.certain, share.by_noise})
            cells.push_back(fmt::format("{:.3f}", percent));
    }
    const auto claimed = claimed_percent(run);
    for (const std::string& cell :
         {fmt::format("{:.3f}", run.error.median), fmt::format("{:.2f}", run.error.percentile_99_5),
          fmt::format("{:+.2f}", 100.0 * run.error.bias), fmt::format("{:.2f}", run.cost.seconds()),
          fmt::format("{:.2f}", run.cost.moment_seconds), fmt::format("{:.2f}", 1e-6 * run.cost.rays),
          fmt::format("{:.1f}", run.cost.mean_samples), fmt::format("{:.0f}", run.cost.most_samples),
          claimed ? fmt::format("{:.3f}", *claimed) : std::string("-")}) {
        cells.push_back(cell);
    }
    table.add(cells);
}

void print_stages(const std::vector<ErrorStudy>& studies, bool markdown) {
    if (studies.front().runs.empty()) return;
    std::vector<std::string> columns = {"frame", "settings"};
    for (const auto& [stage, seconds] : studies.front().runs.front().cost.stages) columns.push_back(stage);
    for (const char* column : {"moments", "total", "by clock"}) columns.emplace_back(column);
    const StudyTable table(columns, 2, markdown);
    for (const ErrorStudy& study : studies) {
        for (const ErrorRun& run : study.runs) {
            std::vector<std::string> cells = {study.frame.name, run.name};
            for (const auto& [stage, seconds] : run.cost.stages) cells.push_back(fmt::format("{:.2f}", seconds));
            for (const double seconds : {run.cost.moment_seconds, run.cost.seconds(), run.cost.clock_seconds})
                cells.push_back(fmt::format("{:.2f}", seconds));
            table.add(cells);
        }
    }
}

void print_claims(const std::vector<ErrorStudy>& studies, bool markdown) {
    std::vector<std::string> columns = {"frame",         "settings",        "claimed (%)",
                                        "error / claim", "understated (%)", "samples of 1 %"};
    for (const std::string& cause : cause_names()) columns.push_back(cause + ": beyond");
    for (const std::string& cause : cause_names()) columns.push_back(cause + ": samples");
    const StudyTable table(columns, 2, markdown);
    for (const ErrorStudy& study : studies) {
        for (const ErrorRun& run : study.runs) {
            if (!run.claim) continue;
            std::vector<std::string> cells = {study.frame.name,
                                              run.name,
                                              fmt::format("{:.3f}", claimed_percent(run).value_or(0.0)),
                                              fmt::format("{:.2f}", run.claim->median_ratio),
                                              fmt::format("{:.2f}", run.claim->understated),
                                              fmt::format("{:.0f}", run.claim->dearest)};
            for (const double percent : run.claim->beyond_by_cause) cells.push_back(fmt::format("{:.3f}", percent));
            for (const double percent : run.claim->samples_by_cause) cells.push_back(fmt::format("{:.0f}", percent));
            table.add(cells);
        }
    }
}

void print_shares(const std::vector<ErrorStudy>& studies, bool markdown) {
    const StudyTable table({"frame", "thresholds", "share of", "beyond (%)", "seconds", "without moments",
                            "best fixed settings", "seconds", "without moments", "times faster", "without moments"},
                           3, markdown);
    std::map<std::string, std::vector<double>> ratios;
    for (const ErrorStudy& study : studies) {
        for (const EqualShare& share : study.shares) {
            std::vector<std::string> cells = {share.frame, fmt::format("{:g}", share.goal.thresholds), share.asked,
                                              fmt::format("{:.3f}", share.goal.percent)};
            cells.push_back(share.cost ? fmt::format("{:.2f}", share.cost->seconds()) : "-");
            cells.push_back(share.cost ? fmt::format("{:.2f}", share.cost->frame_seconds) : "-");
            cells.push_back(share.fixed ? share.fixed->name : "not reached");
            cells.push_back(share.fixed ? fmt::format("{:.2f}", share.fixed->seconds) : "-");
            cells.push_back(share.fixed ? fmt::format("{:.2f}", share.fixed->frame_seconds) : "-");
            const bool both = share.cost && share.fixed;
            cells.push_back(both ? ratio(share.fixed->seconds, share.cost->seconds(), share.fixed->at_most) : "-");
            cells.push_back(both ? ratio(share.fixed->frame_seconds, share.cost->frame_seconds, share.fixed->at_most)
                                 : "-");
            if (both) ratios[share.asked].push_back(share.fixed->seconds / share.cost->seconds());
            table.add(cells);
        }
    }
    for (const auto& [asked, values] : ratios) {
        double logarithms = 0.0;
        for (const double value : values) logarithms += std::log(value);
        fmt::print("\n{}: {:.2f} times faster, geometric mean of {} frames\n", asked,
                   std::exp(logarithms / static_cast<double>(values.size())), values.size());
    }
}

void write_report(const std::string& file, const std::vector<ErrorStudy>& studies) {
    Json json = Json::array();
    for (const ErrorStudy& study : studies) json.push_back(study_json(study));
    write_file(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace aleph
