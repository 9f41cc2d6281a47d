#include "render/cli/study_output.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "render/cli/support/command.h"
#include "render/study/pages/pages.h"
#include "render/study/search_study.h"

namespace aleph {

namespace {

/// Returns whether the table shows a metric: those that the study names, or the usual ones. The files have all of them.
bool is_shown(const Metric& metric, const Study& study) {
    if (!study.metrics.empty()) return true;
    constexpr const char* hidden[] = {"wall_seconds", "share_certain",         "records",
                                      "gather_rays",  "relative_mse_indirect", "bias"};
    return std::ranges::none_of(hidden, [&](std::string_view name) { return metric.name.starts_with(name); });
}

/// Heads of columns: shorter than titles.
std::string head_of(const Metric& metric) {
    std::string head = metric.name;
    std::ranges::replace(head, '_', ' ');
    if (head.starts_with("processor seconds")) return "seconds";
    if (head.starts_with("share beyond")) head.replace(0, 12, "beyond %");
    if (head == "rays") return "M rays";
    if (head == "gather rays") return "M gather rays";
    return head;
}

std::string cell(const MeasuredValue& value) {
    std::string text = brief(value.value, 3);
    if (value.error) text += " +- " + brief(*value.error, 1);
    return text;
}

std::string cell(const VariantResult& variant, const Metric& metric) {
    const auto found = variant.metrics.find(metric.name);
    return found == variant.metrics.end() ? "-" : cell(found->second);
}

void print_row(const TableRow& row, const std::vector<std::size_t>& widths, bool markdown, std::ostream& out) {
    TableRow cells;
    for (std::size_t i = 0; i < row.size(); ++i)
        cells.push_back(i == 0 ? fmt::format("{:<{}}", row[i], widths[i]) : fmt::format("{:>{}}", row[i], widths[i]));
    if (markdown) return fmt::print(out, "| {} |\n", fmt::join(cells, " | "));
    fmt::print(out, "{}\n", fmt::join(cells, "  "));
}

void print_table(const PreparedStudy& prepared, const std::vector<VariantResult>& variants, bool markdown,
                 std::ostream& out) {
    std::vector<TableRow> rows{{"variant"}};
    for (const Metric& metric : prepared.metrics) {
        if (is_shown(metric, prepared.study)) rows.front().push_back(head_of(metric));
    }
    for (const VariantResult& variant : variants) {
        TableRow& row = rows.emplace_back();
        row.push_back(printable(variant.name, 80) + (variant.on_front ? " *" : ""));
        for (const Metric& metric : prepared.metrics) {
            if (is_shown(metric, prepared.study)) row.push_back(cell(variant, metric));
        }
    }
    print_rows(rows, markdown, out);
}

void print_head(const PreparedStudy& prepared, const StudyResults& results, std::ostream& out) {
    fmt::print(out, "{}\nReference: {}.\n", printable(prepared.study.title, 400),
               describe_reference(prepared, results));
}

constexpr std::array shares_seen = {1.0, 5.0};  // percent, for which the best settings are told

/// Without what all candidates have.
std::string describe_settings(const PreparedStudy& prepared, SettingMap settings) {
    settings.erase("sampling");
    settings.erase("error");
    return name_settings(settings, prepared.study.search->settings);
}

void print_best(const PreparedStudy& prepared, const SceneSearch& scene, std::ostream& out) {
    std::vector<CostPoint> points;
    for (const SearchedPoint& point : scene.front) points.push_back(point.point);
    fmt::print(out, "Best fixed settings of {}, of {} candidates:\n", printable(scene.scene),
               prepared.candidates.size());
    for (const double share : shares_seen) {
        if (const auto best = find_cheapest(points, share)) {
            const SearchedPoint& found = scene.front[*best];
            fmt::print(out, "  at most {:.0f} % seen: {} s, {} % seen: {}: {}\n", share, brief(found.point.cost, 3),
                       brief(found.point.error, 2), found.variant,
                       printable(describe_settings(prepared, found.settings), 400));
        } else {
            fmt::print(out, "  at most {:.0f} % seen: none; the best is {}: {} s, {} % seen: {}\n", share,
                       scene.front.back().variant, brief(points.back().cost, 3), brief(points.back().error, 2),
                       printable(describe_settings(prepared, scene.front.back().settings), 400));
        }
    }
}

void print_against(const AgainstFixed& against, std::ostream& out) {
    const CostPoint& own = against.own.point;
    const double times = against.fixed.cost / std::max(own.cost, 1e-9);
    const std::string seconds = brief(against.fixed.cost, 3);
    fmt::print(out, "  {}: {} s, {} % seen; ", printable(against.own.variant, 80), brief(own.cost, 3),
               brief(own.error, 2));
    switch (against.fixed.bound) {
        case FrontCost::Bound::between:
            fmt::print(out, "fixed settings take {} s for as much: {:.2f} times as long\n", seconds, times);
            break;
        case FrontCost::Bound::at_most:
            fmt::print(out, "all fixed settings that were kept show less: at most {} s, {:.2f} times as long\n",
                       seconds, times);
            break;
        case FrontCost::Bound::more:
            fmt::print(out, "no fixed settings that were kept show as little: more than {} s, {:.2f} times as long\n",
                       seconds, times);
            break;
    }
}

}  // namespace

void print_rows(const std::vector<TableRow>& rows, bool markdown, std::ostream& out) {
    std::vector<std::size_t> widths(rows.front().size(), 0);
    for (const TableRow& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        print_row(rows[i], widths, markdown, out);
        if (i > 0 || !markdown) continue;
        TableRow rule;
        for (std::size_t c = 0; c < widths.size(); ++c)
            rule.push_back(std::string(widths[c] - 1, '-') + (c == 0 ? "-" : ":"));
        print_row(rule, widths, true, out);
    }
}

std::filesystem::path study_folder(const std::filesystem::path& file) {
    return name_scene(file) + "-study";
}

std::vector<OutputFile> study_files(const std::filesystem::path& folder) {
    std::vector<OutputFile> files;
    for (const char* name : {"study.json", "study.csv", "report.html", "viewer-test.html", "errors.jpg"})
        files.push_back({folder / name, "--output"});
    return files;
}

std::string study_command_line() {
    std::ifstream words("/proc/self/cmdline", std::ios::binary);  // each ends with 0; the file tells no size
    std::string line(std::istreambuf_iterator<char>(words), {});
    line.erase(0, line.rfind('/', line.find('\0')) + 1);
    if (line.ends_with('\0')) line.pop_back();
    std::ranges::replace(line, '\0', ' ');
    return line;
}

void print_study(const PreparedStudy& prepared, const StudyResults& results, bool markdown, std::ostream& out) {
    print_head(prepared, results, out);
    fmt::print(out, "Means over {}; * no other variant is faster and better.\n\n",
               count_text(results.frames.size(), "frame"));
    print_table(prepared, results.variants, markdown, out);
}

void print_search(const PreparedStudy& prepared, const StudyResults& results, bool markdown, std::ostream& out) {
    print_head(prepared, results, out);
    fmt::print(out, "Means over the frames of a scene; * no other variant is faster and better in this scene.\n");
    for (const SceneSearch& scene : summarize_search(prepared, results)) {
        fmt::print(out, "\n{}\n\n", printable(scene.scene));
        print_table(prepared, variants_of_scene(results, scene.scene), markdown, out);
        out << "\n";
        print_best(prepared, scene, out);
        if (!scene.against.empty()) out << "The study's variants beside them:\n";
        for (const AgainstFixed& against : scene.against) print_against(against, out);
    }
}

void print_ledger(const std::vector<SceneLedger>& ledgers, bool markdown, std::ostream& out) {
    for (const SceneLedger& ledger : ledgers) {
        fmt::print(out, "\n{}: {} seconds a frame with all effects, {} % seen to err. Without each:\n\n",
                   printable(ledger.scene), cell(ledger.seconds), cell(ledger.seen));
        std::vector<TableRow> rows{{"effect", "plan", "seconds saved", "seen %", "left out at most"}};
        for (const LedgerEntry& entry : ledger.entries) {
            rows.push_back({entry.effect, entry.decision, entry.seconds ? cell(*entry.seconds) : "-",
                            entry.seen ? cell(*entry.seen) : "-",
                            std::isfinite(entry.bound)
                                ? entry.bound == 0.0 ? "0" : brief(entry.bound, 2) + " thresholds"
                                : "not known"});
        }
        print_rows(rows, markdown, out);
    }
}

void write_study(const PreparedStudy& prepared, const StudyResults& results, const StudyContext& context,
                 const StudyExtras& extras, bool quiet) {
    const std::filesystem::path& folder = context.folder;
    const nlohmann::ordered_json json = study_json(prepared, results, context);
    write_file(folder / "study.json",
               json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    write_file(folder / "study.csv", study_csv(prepared, results));
    std::string files = "study.json, study.csv";
    if (!report_template().empty()) {
        write_file(folder / "report.html", make_report(report_template(), json, results));
        files += ", report.html";
    }
    if (extras.viewer_test && !viewer_template().empty()) {
        write_file(folder / "viewer-test.html", make_viewer_test(viewer_template(), prepared, results, context));
        files += ", viewer-test.html";
    }
    std::vector<std::string> errors = extras.errors;
    if (errors.empty() && prepared.study.effects) {
        for (const StudyVariant& variant : prepared.variants) errors.push_back(variant.name);
    }
    if (!errors.empty()) {
        write_error_sheet(folder / "errors.jpg", prepared, results, errors);
        files += ", errors.jpg";
    }
    if (quiet) return;
    std::cerr << fmt::format("aleph: {} runs made, {} found finished; wrote {} in {}\n", results.made, results.found,
                             files, printable(folder.string(), 400));
    if (report_template().empty()) {
        std::cerr << "aleph: no page was written: this program was built without it; install node and npm (Debian: "
                     "nodejs npm), and build in a new folder\n";
    }
}

}  // namespace aleph
