#include "render/study/metric_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/json/close_names.h"

namespace aleph {

namespace {

struct Row {
    const char *name, *title, *unit;
    bool cost, of_viewer;
};

constexpr Row rows[] = {
    {"processor_seconds", "processor seconds", "s", true, false},
    {"share_seen", "pixels whose error a viewer sees", "%", false, false},
    {"share_flicker", "pixels whose error is seen to flicker", "%", false, false},
    {"share_lasting", "pixels whose error is seen and lasts", "%", false, false},
    {"share_noticed", "pixels whose error is seen, weighed by where viewers look", "%", false, false},
    {"share_beyond", "pixels beyond one visible threshold", "%", false, true},
    {"share_certain", "pixels certainly beyond it, whatever the noise of the reference", "%", false, true},
    {"mean_error", "mean error", "visible thresholds", false, true},
    {"p99_error", "99th percentile of the error", "visible thresholds", false, true},
    {"relative_mse", "relative MSE of luminance, less the noise of the reference", "", false, false},
    {"relative_mse_indirect", "relative MSE of indirect light", "", false, false},
    {"bias", "bias of the mean luminance", "%", false, false},
    {"seed_seen", "pixels in which two seeds are seen to differ", "%", false, false},
    {"seed_flicker", "pixels in which their difference is seen to flicker", "%", false, false},
    {"rays", "rays", "million", true, false},
    {"gather_rays", "rays for irradiance values", "million", true, false},
    {"samples", "samples per pixel", "", true, false},
    {"ideal_samples", "samples per pixel if each took what its error asks for", "", true, false},
    {"records", "irradiance values computed", "", true, false},
    {"wall_seconds", "seconds of a clock", "s", true, false},
};

std::vector<Metric> make_all(const Study& study) {
    std::vector<Metric> all;
    for (const Row& row : rows) {
        const std::size_t viewers = row.of_viewer ? study.viewers.size() : 1;
        for (std::size_t i = 0; i < viewers; ++i) {
            all.push_back({row.name, row.title, row.unit, row.cost, row.of_viewer ? static_cast<int>(i) : -1});
            if (i == 0) continue;
            all.back().name += "." + study.viewers[i].name;
            all.back().title += fmt::format(" ({})", study.viewers[i].name);
        }
    }
    return all;
}

bool needs_two_seeds(std::string_view metric) {
    return metric.starts_with("seed_");
}

}  // namespace

std::vector<Metric> list_metrics(const Study& study) {
    std::vector<Metric> all = make_all(study);
    const bool one_seed = study.runs.seeds.size() < 2;
    if (one_seed) std::erase_if(all, [](const Metric& metric) { return needs_two_seeds(metric.name); });
    if (study.metrics.empty()) return all;
    std::vector<std::string> known;
    for (const Row& row : rows) known.emplace_back(row.name);
    for (const std::string& name : study.metrics) {
        if (one_seed && needs_two_seeds(name))
            throw InputError(study.file, "metrics", fmt::format("{} needs two seeds", printable(name)));
        if (std::ranges::find(known, name) != known.end()) continue;
        throw InputError(study.file, "metrics",
                         fmt::format("there is no metric {}{}; known are {}", printable(name),
                                     close_suggestion(name, known), fmt::join(known, ", ")));
    }
    // Those that charts show first are always measured.
    std::erase_if(all, [&](const Metric& metric) {
        const std::string row = metric.name.substr(0, metric.name.find('.'));
        return row != "processor_seconds" && row != "share_seen" &&
               std::ranges::find(study.metrics, row) == study.metrics.end();
    });
    return all;
}

}  // namespace aleph
