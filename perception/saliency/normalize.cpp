#include "perception/saliency/normalize.h"

#include <numeric>

namespace aleph {

Normalization compute_normalization(const ExpandedMap& map, double floor) {
    const LocalMaxima maxima = find_local_maxima(map, floor);
    Normalization result{maxima.minimum, maxima.maximum, 0.0, true};
    if (!(result.maximum - result.minimum > floor)) return result;
    result.empty = false;
    // Leaves out one global maximum, whose height is 1.
    const auto others = static_cast<double>(maxima.heights.size()) - 1.0;
    const double sum = std::accumulate(maxima.heights.begin(), maxima.heights.end(), 0.0);
    const double mean = others > 0.0 ? (sum - 1.0) / others : 0.0;
    result.weight = (1.0 - mean) * (1.0 - mean);
    return result;
}

Normalization compute_normalization(const Image<float>& map, double floor) {
    const std::vector<LevelSize> sizes = {{map.width, map.height}};
    return compute_normalization(ExpandedMap{&map, 0, &sizes}, floor);
}

}  // namespace aleph
