#pragma once
// Means of a picture over many renderings that differ in the seed alone: expected values with their standard errors.

#include <vector>

#include "engine/base/image.h"

namespace aleph {

/// Mean and standard error of a number that renderings give.
struct SeedMean {
    double mean = 0.0, error = 0.0;
};

/// Numbers of one picture: of its whole, and of each block of a grid of 4x4.
struct PictureSums {
    double whole = 0.0;
    std::vector<double> blocks;
};

constexpr int block_columns = 4;

/// Mean luminance times weight.
/// @param weights  of the pixels; empty: 1
PictureSums sum_picture(const Image<double>& luminance, const Image<float>& weights);

/// @param values  of at least two renderings
SeedMean mean_of_seeds(const std::vector<double>& values);

/// Difference of two means in standard errors of that difference; 0 if both are exact and equal.
double deviation_between(const SeedMean& a, const SeedMean& b);

}  // namespace aleph
