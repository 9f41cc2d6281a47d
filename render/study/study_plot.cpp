#include "render/study/study_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/base/atomic_file.h"
#include "render/study/other_program.h"

namespace aleph {

namespace {

constexpr const char *cost_name = "processor_seconds", *error_name = "share_beyond";

struct Point {
    double cost = 0.0, error = 0.0;
    double cost_bar = 0.0, error_bar = 0.0;
};

/// For double quotes of gnuplot, whose enhanced text takes some characters as markup.
std::string quote(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        if (c == '_' || c == '^' || c == '@' || c == '{' || c == '}' || c == '&' || c == '~') out += "\\\\";
        out += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
    return out + "\"";
}

/// What a variant's colour stands for: the value of the last axis, or the name of a variant of its own.
std::string group_of(const VariantResult& variant, const Study& study) {
    if (study.sweep.empty()) return variant.name;
    const std::string& key = study.sweep.back().setting;
    const auto found = variant.settings.find(key);
    return found == variant.settings.end() ? variant.name : key + " " + setting_text(found->second);
}

std::string block(const std::string& name, const std::vector<Point>& points) {
    std::string text = "$" + name + " << END\n";
    for (const Point& p : points) text += fmt::format("{} {} {} {}\n", p.cost, p.error, p.cost_bar, p.error_bar);
    return text + "END\n";
}

struct Chart {
    std::vector<std::pair<std::string, std::vector<Point>>> groups;
    std::vector<Point> front;
    double least = 0.0;  ///< where an error of 0 stands
};

/// Half of the smallest error above 0.
double least_error(const StudyResults& results) {
    double least = 0.0;
    for (const VariantResult& variant : results.variants) {
        const double error = variant.metrics.contains(error_name) ? variant.metrics.at(error_name).value : 0.0;
        if (error > 0.0 && (least == 0.0 || error < least)) least = error;
    }
    return least == 0.0 ? 1e-3 : 0.5 * least;
}

Chart make_chart(const PreparedStudy& prepared, const StudyResults& results) {
    Chart chart;
    chart.least = least_error(results);
    for (const VariantResult& variant : results.variants) {
        if (!variant.metrics.contains(cost_name) || !variant.metrics.contains(error_name)) continue;
        const MeasuredValue cost = variant.metrics.at(cost_name), error = variant.metrics.at(error_name);
        const Point point{cost.value, std::max(error.value, chart.least), cost.error.value_or(0.0),
                          error.error.value_or(0.0)};
        const std::string group = group_of(variant, prepared.study);
        auto found = std::ranges::find(chart.groups, group, [](const auto& entry) { return entry.first; });
        if (found == chart.groups.end()) found = chart.groups.insert(found, {group, {}});
        found->second.push_back(point);
        if (variant.on_front) chart.front.push_back(point);
    }
    std::ranges::sort(chart.front, {}, &Point::cost);
    return chart;
}

}  // namespace

std::string plot_program(const PreparedStudy& prepared, const StudyResults& results) {
    const Chart chart = make_chart(prepared, results);
    std::string text = fmt::format(
        "set terminal pngcairo size 900,620 font \"DejaVu Sans,11\"\nset output \"plot.png\"\nset encoding utf8\n"
        "set title {}\nset xlabel \"processor seconds per frame\"\n"
        "set ylabel \"pixels beyond one visible threshold, %\"\nset logscale xy\nset grid\nset key outside below\n"
        "set yrange [{}:*]\n",
        quote(prepared.study.title), 0.9 * chart.least);
    for (std::size_t i = 0; i < chart.groups.size(); ++i)
        text += block(fmt::format("group{}", i), chart.groups[i].second);
    text += block("front", chart.front);
    text += "plot $front using 1:2 with lines lw 2 lc rgb \"#888888\" title \"no other is faster and better\"";
    for (std::size_t i = 0; i < chart.groups.size(); ++i) {
        text += fmt::format(", $group{0} using 1:2:3:4 with xyerrorbars pt 7 ps 1.2 lc {1} title {2}", i, i + 1,
                            quote(chart.groups[i].first));
    }
    return text + "\n";
}

bool draw_with_gnuplot(const std::filesystem::path& png, const std::string& program) {
    if (!find_program("gnuplot")) return false;
    const TemporaryFolder folder;
    if (run_program_in(folder.path(), {"gnuplot", "-"}, program).code != 0) return false;
    const std::filesystem::path drawn = folder.path() / "plot.png";
    if (!std::filesystem::is_regular_file(drawn)) return false;
    write_atomically(png, [&](const std::filesystem::path& temporary) {
        std::filesystem::copy_file(drawn, temporary, std::filesystem::copy_options::overwrite_existing);
    });
    return true;
}

}  // namespace aleph
