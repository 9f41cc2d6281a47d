#include "scenes/studies/seed_means.h"

#include <cmath>

namespace aleph {

PictureSums sum_picture(const Image<double>& luminance, const Image<float>& weights) {
    PictureSums sums;
    sums.blocks.assign(static_cast<std::size_t>(block_columns) * block_columns, 0.0);
    for (int y = 0; y < luminance.height; ++y) {
        for (int x = 0; x < luminance.width; ++x) {
            const std::size_t i = luminance.index(x, y);
            const double weight = weights.empty() ? 1.0 : weights.pixels[i];
            const double value = weight * luminance.pixels[i] / static_cast<double>(luminance.size());
            const int column = x * block_columns / luminance.width, row = y * block_columns / luminance.height;
            sums.whole += value;
            sums.blocks[static_cast<std::size_t>(row) * block_columns + static_cast<std::size_t>(column)] += value;
        }
    }
    return sums;
}

SeedMean mean_of_seeds(const std::vector<double>& values) {
    const double count = static_cast<double>(values.size());
    double mean = 0.0, squares = 0.0;
    for (const double value : values) mean += value / count;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return {mean, std::sqrt(squares / (count * (count - 1.0)))};
}

double deviation_between(const SeedMean& a, const SeedMean& b) {
    if (a.mean == b.mean) return 0.0;
    return (a.mean - b.mean) / std::hypot(a.error, b.error);
}

}  // namespace aleph
