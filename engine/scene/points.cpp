#include "engine/scene/points.h"

namespace aleph {

std::vector<glm::dvec3> sample_points(const PointCache& cache, double seconds) {
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

}  // namespace aleph
