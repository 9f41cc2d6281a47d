#include "render/study/study_results.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace aleph {

namespace {

double total(const std::vector<std::pair<std::string, double>>& parts) {
    return std::accumulate(parts.begin(), parts.end(), 0.0,
                           [](double sum, const auto& part) { return sum + part.second; });
}

double part(const std::vector<std::pair<std::string, double>>& parts, const char* name) {
    const auto found = std::ranges::find(parts, name, [](const auto& entry) { return entry.first; });
    return found == parts.end() ? 0.0 : found->second;
}

/// Mean of each part over the runs; all have the same parts.
std::vector<std::pair<std::string, double>> mean_parts(const std::vector<MeasuredRun>& runs, std::size_t frame,
                                                       std::vector<std::pair<std::string, double>> FrameRun::*parts) {
    std::vector<std::pair<std::string, double>> mean = runs.front().frames.at(frame).*parts;
    for (auto& [name, value] : mean) value = 0.0;
    for (const MeasuredRun& run : runs) {
        for (std::size_t i = 0; i < mean.size(); ++i)
            mean[i].second += (run.frames.at(frame).*parts).at(i).second / static_cast<double>(runs.size());
    }
    return mean;
}

FrameResult summarize_frame(const std::string& scene, const std::vector<MeasuredRun>& runs, std::size_t i) {
    FrameResult result;
    const FrameRun& first = runs.front().frames.at(i);
    result.scene = scene;
    result.frame = first.frame;
    result.plan = first.plan;
    if (!runs.front().pictures.empty()) result.picture = runs.front().pictures.at(i);
    std::map<std::string, std::vector<double>> values;
    for (const MeasuredRun& run : runs) {
        const FrameRun& frame = run.frames.at(i);
        if (frame.timed) {
            values["processor_seconds"].push_back(frame.processor_seconds);
            values["wall_seconds"].push_back(frame.wall_seconds);
        }
        if (run.errors.empty()) continue;  // a repeat counts the same
        if (frame.timed) {
            values["rays"].push_back(1e-6 * total(frame.rays));
            values["gather_rays"].push_back(1e-6 * (part(frame.rays, "gather") + part(frame.rays, "multi_bounce")));
            values["samples"].push_back(frame.samples);
            values["records"].push_back(frame.records);
        }
        for (const auto& [name, value] : run.errors.at(i)) values[name].push_back(value);
    }
    for (const auto& [name, list] : values) result.metrics[name] = mean_of(list);
    result.stages = mean_parts(runs, i, &FrameRun::stages);
    result.rays = mean_parts(runs, i, &FrameRun::rays);
    return result;
}

}  // namespace

MeasuredValue mean_of(const std::vector<double>& values) {
    const auto count = static_cast<double>(values.size());
    MeasuredValue mean;
    mean.value = std::accumulate(values.begin(), values.end(), 0.0) / count;
    if (values.size() < 2) return mean;
    double squares = 0.0;
    for (const double value : values) squares += (value - mean.value) * (value - mean.value);
    mean.error = std::sqrt(squares / (count - 1.0) / count);
    return mean;
}

std::vector<FrameResult> summarize_runs(const std::string& scene, const std::vector<MeasuredRun>& runs) {
    std::vector<FrameResult> results;
    for (std::size_t i = 0; i < runs.front().frames.size(); ++i) results.push_back(summarize_frame(scene, runs, i));
    return results;
}

void average_frames(VariantResult& variant) {
    variant.metrics.clear();
    if (variant.frames.empty()) return;
    const auto count = static_cast<double>(variant.frames.size());
    for (const auto& [name, first] : variant.frames.front().metrics) {
        if (!std::ranges::all_of(variant.frames, [&](const FrameResult& f) { return f.metrics.contains(name); }))
            continue;
        double sum = 0.0, squares = 0.0;
        bool with_error = true;
        for (const FrameResult& frame : variant.frames) {
            const MeasuredValue& value = frame.metrics.at(name);
            sum += value.value;
            with_error = with_error && value.error.has_value();
            squares += std::pow(value.error.value_or(0.0), 2);
        }
        MeasuredValue& mean = variant.metrics[name];
        mean.value = sum / count;
        if (with_error) mean.error = std::sqrt(squares) / count;
    }
}

std::optional<CostPoint> find_point(const VariantResult& variant) {
    const auto cost = variant.metrics.find("processor_seconds"), error = variant.metrics.find("share_seen");
    if (cost == variant.metrics.end() || error == variant.metrics.end()) return std::nullopt;
    return CostPoint{cost->second.value, error->second.value};
}

void find_front(std::vector<VariantResult>& variants) {
    for (VariantResult& variant : variants) {
        const std::optional<CostPoint> own = find_point(variant);
        variant.on_front = own && std::ranges::none_of(variants, [&](const VariantResult& other) {
                               const std::optional<CostPoint> point = find_point(other);
                               return point && dominates(*point, *own);
                           });
    }
}

}  // namespace aleph
