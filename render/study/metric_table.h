#pragma once
// Metrics: values that a study measures of a frame.

#include <map>
#include <string>
#include <vector>

#include "render/study/study.h"

namespace aleph {

struct Metric {
    std::string name;   ///< in files: "share_beyond", and of other viewers than the first "share_beyond.castle"
    std::string title;  ///< in tables and charts
    std::string unit;   ///< empty: none
    bool cost = false;  ///< of time or work; else of error
    int viewer = -1;    ///< index of the viewer whose thresholds it is in; -1: of none
};

/// Values of a frame by Metric::name.
using MetricValues = std::map<std::string, double>;

/// All metrics of a study, or those that it names, of every viewer; of two seeds only where it has them. The first cost
/// and the first error are what charts show first: processor_seconds and share_seen.
/// @throws InputError for a name in `Study::metrics` that is unknown
std::vector<Metric> list_metrics(const Study& study);

}  // namespace aleph
