#include "engine/scene/points.h"

#include <algorithm>

namespace aleph {

SampleSpan look_up(const TimeSampling& sampling, std::size_t count, double seconds, Lookup lookup) {
    const SampleSpan span = find_samples(sampling, count, seconds);
    switch (lookup) {
        case Lookup::floor:
            return {span.floor, span.floor, 0.0};
        case Lookup::ceil:
            return {span.ceil, span.ceil, 0.0};
        case Lookup::near: {
            const std::size_t nearest = nearest_sample(sampling, count, seconds);
            return {nearest, nearest, 0.0};
        }
        case Lookup::interpolated:
            break;
    }
    return span;
}

std::vector<glm::dvec3> sample_points(const PointCache& cache, double seconds, Lookup lookup) {
    if (cache.positions.empty()) return {};
    const SampleSpan span = look_up(cache.sampling, cache.positions.size(), seconds, lookup);
    const std::vector<glm::vec3>& a = cache.positions[span.floor];
    const std::vector<glm::vec3>& b = cache.positions[span.ceil];
    std::vector<glm::dvec3> points(a.begin(), a.end());
    if (span.floor == span.ceil) return points;
    // Written so that equal samples give exactly their value.
    for (std::size_t i = 0; i < points.size(); ++i) points[i] += (glm::dvec3(b[i]) - points[i]) * span.fraction;
    return points;
}

bool is_animated(const PointCache& cache) {
    return std::ranges::any_of(cache.positions, [&](const auto& sample) { return sample != cache.positions.front(); });
}

}  // namespace aleph
