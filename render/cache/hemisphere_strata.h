#pragma once
// Division of a hemisphere into cells, and one direction in each.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <numbers>

#include "render/pixels/pixel_sequence.h"

namespace aleph {

/// Rows in elevation, columns in azimuth, about pi times as many columns as rows. Every cell has the same share of the
/// cosine-weighted hemisphere. Row 0 is next to the normal; cells are numbered row by row.
struct HemisphereStrata {
    int rows = 1;
    int columns = 1;
    int count() const { return rows * columns; }
    int cell(int row, int column) const { return row * columns + column; }
};

/// Strata with exactly `samples` cells if a pair of divisors is near the ideal ratio, otherwise with a few less: at
/// most 8 %, from 64 on 5 %, and .24 % in the mean.
inline HemisphereStrata choose_strata(int samples) {
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

/// Calls visit(cell, row, column) for every cell, so that any 16 in a row are neighbours: bands of about four rows, and
/// in each column by column.
template <class Visit>
void visit_blocks(const HemisphereStrata& strata, const Visit& visit) {
    const int bands = std::max(1, (strata.rows + 2) / 4);
    for (int band = 0; band < bands; ++band) {
        const int begin = band * strata.rows / bands, end = (band + 1) * strata.rows / bands;
        for (int column = 0; column < strata.columns; ++column) {
            for (int row = begin; row < end; ++row) visit(strata.cell(row, column), row, column);
        }
    }
}

/// Numbers in [0,1) for every cell: Kronecker sequences by row and column, each with a random shift. Neighbouring cells
/// see similar things, and their numbers are spread evenly, so that their errors partly cancel.
class CellNumbers {
  public:
    explicit CellNumbers(RandomStream& random) {
        for (float& shift : shifts_) shift = random.next();
    }

    /// Point of [0,1)^2 within a cell: elevation changes by column and azimuth by row, so that no two cells are sampled
    /// at the same place.
    glm::vec2 place(int row, int column) const {
        return {number(0, 0.0f, golden, row, column), number(1, root2, 0.0f, row, column)};
    }
    /// For a light at what the cell sees.
    float light(int row, int column) const { return number(2, plastic, plastic2, row, column); }
    /// For a point on that light.
    glm::vec2 light_point(int row, int column) const {
        return {number(3, 0.81917251f, 0.67104361f, row, column), number(4, root2, golden, row, column)};
    }

  private:
    static constexpr float golden = 0.61803399f, root2 = 0.41421356f;
    static constexpr float plastic = 0.75487767f, plastic2 = 0.56984029f;

    float number(std::size_t dimension, float by_row, float by_column, int row, int column) const {
        const float x = shifts_[dimension] + static_cast<float>(row) * by_row + static_cast<float>(column) * by_column;
        return std::min(glm::fract(x), below_one);
    }

    std::array<float, 5> shifts_;
};

}  // namespace aleph
