#pragma once
// The points of a point cache at a time.

#include <algorithm>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// A cache's points, m, linear between samples. On a sample they are exactly the sample's; between samples that agree,
/// exactly theirs.
inline std::vector<glm::dvec3> sample_points(const PointCache& cache, double seconds) {
    if (cache.positions.empty()) return {};
    const SampleSpan span = find_samples(cache.sampling, cache.positions.size(), seconds);
    const std::vector<glm::vec3>& a = cache.positions[span.floor];
    const std::vector<glm::vec3>& b = cache.positions[span.ceil];
    std::vector<glm::dvec3> points(a.begin(), a.end());
    if (span.floor == span.ceil) return points;
    // Written so that equal samples give exactly their value.
    for (std::size_t i = 0; i < points.size(); ++i) points[i] += (glm::dvec3(b[i]) - points[i]) * span.fraction;
    return points;
}

/// Samples of points or normals: some differ from the first.
inline bool do_samples_differ(const std::vector<std::vector<glm::vec3>>& samples) {
    return std::ranges::any_of(samples, [&](const auto& sample) { return sample != samples.front(); });
}

/// False only where sample_points gives the same points at every time.
inline bool is_animated(const PointCache& cache) {
    return do_samples_differ(cache.positions);
}

}  // namespace aleph
