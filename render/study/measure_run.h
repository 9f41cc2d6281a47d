#pragma once
// The errors of a picture, by the metrics of a study.

#include <map>
#include <string>
#include <vector>

#include "engine/image/image_file.h"
#include "render/study/metric_table.h"

namespace aleph {

/// Reference and thresholds that the pictures of one frame are judged by.
struct FrameTruth {
    ChannelImage reference;                ///< R, G, B, variance.Y, and indirect.R/G/B where it has them
    std::vector<Image<float>> thresholds;  ///< cd/m2, of each viewer
};

using MetricValues = std::map<std::string, double>;

/// The metrics of errors; those that do not apply (indirect light of a traced picture) are absent.
/// @param picture  R, G, B, and indirect.R/G/B where it has them
/// @throws InputError if sizes differ
MetricValues measure_errors(const ChannelImage& picture, const FrameTruth& truth, const std::vector<Metric>& metrics);

/// How noisy the reference itself is: the share that noise alone makes beyond the threshold, percent, and the 99th
/// percentile of its standard error in thresholds, both of the first viewer.
struct ReferenceQuality {
    double share_by_noise = 0.0, percentile_99 = 0.0;
};
ReferenceQuality measure_reference(const FrameTruth& truth);

}  // namespace aleph
