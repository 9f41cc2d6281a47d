#include "perception/normalize.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace aleph {

namespace {

constexpr int rows_per_band = 32;
constexpr double quantisation_steps = 65535.0;
constexpr double lowest_maximum = 0.1;  // local maxima below it are dropped (MODEL 5.3)

/// A pixel not lower than its neighbours.
struct Candidate {
    int x, y;
    float value;
    float highest_neighbour;  // -1: it has none
};

/// Rows of |map|, with a border of -1 all around: lower than any value, so that border pixels need no special case.
class PaddedRows {
  public:
    PaddedRows(int width, int rows)
        : stride_(width + 2), values_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(rows + 2)) {}

    /// Pixel x of row y, both from -1.
    float* row(int y) {
        return values_.data() + static_cast<std::ptrdiff_t>(y + 1) * static_cast<std::ptrdiff_t>(stride_) + 1;
    }
    void clear_row(int y) { std::fill_n(row(y) - 1, stride_, -1.0f); }
    int stride() const { return stride_; }

  private:
    int stride_;
    std::vector<float> values_;
};

/// Lowest and highest value, per column while rows pass: element by element, as compilers vectorise it.
class ColumnRanges {
  public:
    explicit ColumnRanges(int width)
        : low_(static_cast<std::size_t>(width), std::numeric_limits<float>::infinity()),
          high_(static_cast<std::size_t>(width), 0.0f) {}

    /// |source| into a padded row; widens the ranges.
    void take_row(const float* source, float* out) {
        const int width = static_cast<int>(low_.size());
        float* const low = low_.data();
        float* const high = high_.data();
        for (int x = 0; x < width; ++x) {
            const float v = std::abs(source[x]);
            out[x] = v;
            low[x] = v < low[x] ? v : low[x];
            high[x] = v > high[x] ? v : high[x];
        }
        out[-1] = -1.0f;
        out[width] = -1.0f;
    }

    float minimum() const { return *std::min_element(low_.begin(), low_.end()); }
    float maximum() const { return *std::max_element(high_.begin(), high_.end()); }

  private:
    std::vector<float> low_, high_;
};

/// Highest of three neighbours along a row.
void max_along_row(const float* row, int width, float* out) {
    for (int x = 0; x < width; ++x) {
        const float sides = row[x - 1] > row[x + 1] ? row[x - 1] : row[x + 1];
        out[x] = sides > row[x] ? sides : row[x];
    }
}

float highest_neighbour(const float* above, const float* row, const float* below, int x) {
    return std::max(
        {above[x - 1], above[x], above[x + 1], row[x - 1], row[x + 1], below[x - 1], below[x], below[x + 1]});
}

/// Walks a map in bands of rows and keeps what may be a local maximum.
class CandidateScan {
  public:
    CandidateScan(const Image<float>& image, int level, const std::vector<LevelSize>& sizes)
        : image_(image),
          level_(level),
          size_(sizes.front()),
          expander_(sizes),
          ranges_(size_.width),
          rows_(size_.width, rows_per_band + 2),
          row_maxima_(static_cast<std::size_t>(size_.width) * (rows_per_band + 2)) {
        for (int begin = 0; begin < size_.height; begin += rows_per_band) {
            scan_band(begin, std::min(begin + rows_per_band, size_.height));
        }
    }

    float minimum() const { return ranges_.minimum(); }
    float maximum() const { return maximum_; }
    const std::vector<Candidate>& candidates() const { return candidates_; }

  private:
    void scan_band(int begin, int end) {
        // One row more on both sides: the neighbours of the band's first and last row.
        const int first = std::max(0, begin - 1);
        const int last = std::min(size_.height, end + 1);
        const float* source = expander_.expand_rows(image_, level_, first, last);
        if (begin == 0) rows_.clear_row(-1);
        const int offset = begin == 0 ? 0 : -1;  // the band's first row is row 0 of `rows_`
        for (int y = first; y < last; ++y, source += size_.width) {
            float* const row = rows_.row(y - first + offset);
            ranges_.take_row(source, row);
        }
        if (end == size_.height) rows_.clear_row(end - begin);
        maximum_ = ranges_.maximum();
        for (int r = -1; r <= end - begin; ++r) max_along_row(rows_.row(r), size_.width, maxima(r));
        for (int y = begin; y < end; ++y) scan_row(y, y - begin);
    }

    float* maxima(int r) {
        return row_maxima_.data() + static_cast<std::ptrdiff_t>(r + 1) * static_cast<std::ptrdiff_t>(size_.width);
    }

    void scan_row(int y, int r) {
        constexpr int block = 64;
        const float* const row = rows_.row(r);
        const float* const above = maxima(r - 1);
        const float* const here = maxima(r);
        const float* const below = maxima(r + 1);
        // Nothing under .1 of the final range can be above .1 of what was seen so far; a little less for rounding.
        const float threshold = 0.999f * static_cast<float>(lowest_maximum) * maximum_;
        for (int x0 = 0; x0 < size_.width; x0 += block) {
            const int x1 = std::min(x0 + block, size_.width);
            int found = 0;
            for (int x = x0; x < x1; ++x) {
                const float higher = above[x] > below[x] ? above[x] : below[x];
                const float highest = higher > here[x] ? higher : here[x];
                found |= static_cast<int>(row[x] >= highest) & static_cast<int>(row[x] > threshold);
            }
            if (found == 0) continue;
            for (int x = x0; x < x1; ++x) {
                if (!(row[x] > threshold)) continue;
                const float neighbour = highest_neighbour(rows_.row(r - 1), row, rows_.row(r + 1), x);
                if (row[x] >= neighbour) candidates_.push_back({x, y, row[x], neighbour});
            }
        }
    }

    const Image<float>& image_;
    int level_;
    LevelSize size_;
    RowExpander expander_;
    ColumnRanges ranges_;
    PaddedRows rows_;
    std::vector<float> row_maxima_;
    float maximum_ = 0.0f;
    std::vector<Candidate> candidates_;
};

/// Flood fill over plateaus of the quantised map.
class PlateauFill {
  public:
    PlateauFill(const float* map, LevelSize size, double minimum, double range)
        : map_(map),
          size_(size),
          minimum_(minimum),
          range_(range),
          visited_(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height)) {}

    static int quantise(double value, double minimum, double range) {
        return static_cast<int>(std::floor((value - minimum) / range * quantisation_steps + 0.5));
    }

    /// Whether the pixel's plateau is higher than all around it; false if this plateau was asked for before.
    bool is_new_maximum(int x, int y) {
        if (visited_[index(x, y)] != 0) return false;
        const int level = quantised(x, y);
        bool highest = true;
        visited_[index(x, y)] = 1;
        stack_.push_back({x, y});
        while (!stack_.empty()) {
            const auto [cx, cy] = stack_.back();
            stack_.pop_back();
            for (int ny = std::max(0, cy - 1); ny <= std::min(size_.height - 1, cy + 1); ++ny) {
                for (int nx = std::max(0, cx - 1); nx <= std::min(size_.width - 1, cx + 1); ++nx) {
                    const int other = quantised(nx, ny);
                    if (other > level) highest = false;
                    if (other != level || visited_[index(nx, ny)] != 0) continue;
                    visited_[index(nx, ny)] = 1;
                    stack_.push_back({nx, ny});
                }
            }
        }
        return highest;
    }

  private:
    struct Position {
        int x, y;
    };
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) + static_cast<std::size_t>(x);
    }
    int quantised(int x, int y) const { return quantise(std::abs(map_[index(x, y)]), minimum_, range_); }

    const float* map_;
    LevelSize size_;
    double minimum_, range_;
    std::vector<std::uint8_t> visited_;
    std::vector<Position> stack_;
};

}  // namespace

Normalization compute_normalization(const Image<float>& level_image, int level, const std::vector<LevelSize>& sizes,
                                    double floor) {
    const CandidateScan scan(level_image, level, sizes);
    Normalization result{scan.minimum(), scan.maximum(), 0.0, true};
    const double range = result.maximum - result.minimum;
    if (!(range > floor)) return result;
    result.empty = false;

    const auto quantise = [&](float value) { return PlateauFill::quantise(value, result.minimum, range); };
    double sum = 0.0;
    int count = 0;
    const auto add_maximum = [&](int quantised) {
        sum += quantised / quantisation_steps;
        ++count;
    };
    std::vector<Candidate> ties;
    for (const Candidate& c : scan.candidates()) {
        const int quantised = quantise(c.value);
        if (quantised < lowest_maximum * quantisation_steps) continue;
        if (c.highest_neighbour >= 0.0f && quantise(c.highest_neighbour) == quantised) {
            ties.push_back(c);
        } else {
            add_maximum(quantised);
        }
    }
    if (!ties.empty()) {
        RowExpander expander(sizes);
        PlateauFill fill(expander.expand_rows(level_image, level, 0, sizes.front().height), sizes.front(),
                         result.minimum, range);
        for (const Candidate& c : ties) {
            if (fill.is_new_maximum(c.x, c.y)) add_maximum(quantise(c.value));
        }
    }
    const double mean_of_others = count > 1 ? (sum - 1.0) / (count - 1) : 0.0;  // the global maximum is 1
    result.weight = (1.0 - mean_of_others) * (1.0 - mean_of_others);
    return result;
}

Normalization compute_normalization(const Image<float>& map, double floor) {
    return compute_normalization(map, 0, {LevelSize{map.width, map.height}}, floor);
}

}  // namespace aleph
