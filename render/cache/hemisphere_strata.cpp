#include "render/cache/hemisphere_strata.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace aleph {

HemisphereStrata choose_strata(int samples) {
    HemisphereStrata best{1, std::max(1, samples)};
    double best_cost = 1e30;
    for (int rows = 1; rows * rows <= samples; ++rows) {
        const int columns = samples / rows;
        // With columns = pi rows, cells near the horizon are as wide as high. All samples asked for should be used, so
        // cells may be up to 1.6 times too wide or too narrow before a sample is dropped.
        const double skew = std::abs(std::log(columns / (std::numbers::pi * rows)));
        const double lost = static_cast<double>(samples - rows * columns) / samples;
        const double cost = skew + (lost > 0.0 ? 0.5 + 10.0 * lost : 0.0);
        if (cost < best_cost) {
            best_cost = cost;
            best = {rows, columns};
        }
    }
    return best;
}

}  // namespace aleph
