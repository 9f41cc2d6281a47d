#pragma once
// Results of a study: each variant's costs and errors, with their uncertainty.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/study/metric_table.h"
#include "render/study/pareto.h"
#include "render/study/timed_run.h"

namespace aleph {

/// A mean and its standard error, which several values tell.
struct MeasuredValue {
    double value = 0.0;
    std::optional<double> error;
};

/// Mean of the values with its standard error, if there are at least two.
MeasuredValue mean_of(const std::vector<double>& values);

/// One frame in one variant.
struct FrameResult {
    std::string scene;
    std::int64_t frame = 0;
    std::map<std::string, MeasuredValue> metrics;              ///< by Metric::name
    std::vector<std::pair<std::string, double>> stages, rays;  ///< means: seconds of a clock, counts
    std::string plan;                                          ///< of effects, JSON
    std::string picture;                                       ///< the file of the first seed's
};

/// A run with the errors of its pictures; frames are in the same order.
struct MeasuredRun {
    std::vector<FrameRun> frames;
    std::vector<MetricValues> errors;   ///< of the first repeat; else empty
    std::vector<std::string> pictures;  ///< files
};

/// Costs as means over all runs, errors as means over those with errors.
/// @param runs  of one variant and scene, at least one, in the order of seeds
std::vector<FrameResult> summarize_runs(const std::string& scene, const std::vector<MeasuredRun>& runs);

struct VariantResult {
    std::string name;
    SettingMap settings;
    std::vector<FrameResult> frames;
    std::map<std::string, MeasuredValue> metrics;  ///< means over the frames
    bool on_front = false;  ///< no other variant costs as little and errs as little, and less in one of the two
};

/// Fills the means over the frames of each variant. A metric that some frame lacks has none.
void average_frames(VariantResult& variant);

/// processor_seconds and share_seen; nothing for variants without them.
std::optional<CostPoint> find_point(const VariantResult& variant);

/// Fills VariantResult::on_front. Variants without a point are not on it.
void find_front(std::vector<VariantResult>& variants);

}  // namespace aleph
