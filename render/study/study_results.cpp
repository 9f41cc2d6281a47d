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
template <class Parts>
std::vector<std::pair<std::string, double>> mean_parts(const std::vector<MeasuredRun>& runs, std::size_t frame,
                                                       const Parts& parts_of) {
    std::vector<std::pair<std::string, double>> mean = parts_of(runs.front().frames.at(frame));
    for (auto& [name, value] : mean) value = 0.0;
    for (const MeasuredRun& run : runs) {
        const auto& parts = parts_of(run.frames.at(frame));
        for (std::size_t i = 0; i < mean.size(); ++i)
            mean[i].second += parts.at(i).second / static_cast<double>(runs.size());
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
    result.stages = mean_parts(runs, i, [](const FrameRun& run) { return run.stages; });
    result.rays = mean_parts(runs, i, [](const FrameRun& run) { return run.rays; });
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
        double sum = 0.0, squares = 0.0;
        bool everywhere = true, with_error = true;
        for (const FrameResult& frame : variant.frames) {
            const auto found = frame.metrics.find(name);
            if (found == frame.metrics.end()) {
                everywhere = false;
                break;
            }
            sum += found->second.value;
            with_error = with_error && found->second.error.has_value();
            squares += std::pow(found->second.error.value_or(0.0), 2);
        }
        if (!everywhere) continue;
        MeasuredValue& mean = variant.metrics[name];
        mean.value = sum / count;
        if (with_error) mean.error = std::sqrt(squares) / count;
    }
}

void find_front(std::vector<VariantResult>& variants, const std::string& cost, const std::string& error) {
    const auto has = [&](const VariantResult& v) { return v.metrics.contains(cost) && v.metrics.contains(error); };
    for (VariantResult& variant : variants) {
        variant.on_front = has(variant) && std::ranges::none_of(variants, [&](const VariantResult& other) {
                               if (!has(other)) return false;
                               const double dc = other.metrics.at(cost).value - variant.metrics.at(cost).value;
                               const double de = other.metrics.at(error).value - variant.metrics.at(error).value;
                               return dc <= 0.0 && de <= 0.0 && (dc < 0.0 || de < 0.0);
                           });
    }
}

}  // namespace aleph
