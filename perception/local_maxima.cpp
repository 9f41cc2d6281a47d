#include "perception/local_maxima.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace aleph {

namespace {

constexpr int reach = Candidate::reach;
constexpr float outside = -1.0f;  // lower than any value of a map
constexpr double quantisation_steps = 65535.0;
constexpr double lowest_maximum = 0.1;  // local maxima below it are dropped (MODEL 5.3)

/// The last few rows of |map|, in a ring, with a rim of `outside` that is `reach` wide: no pixel is a special case.
class RowRing {
  public:
    static constexpr int rows = 8;  // at least Candidate::side, a power of two

    explicit RowRing(int width)
        : width_(width), stride_(width + 2 * reach), values_(static_cast<std::size_t>(stride_ * rows), outside) {}

    /// Pixel 0 of row y >= -rows.
    float* row(int y) { return values_.data() + ((y + rows) % rows) * stride_ + reach; }
    void clear_row(int y) { std::fill_n(row(y), width_, outside); }

  private:
    int width_;
    std::ptrdiff_t stride_;
    std::vector<float> values_;
};

/// Makes a row absolute; widens the range.
void take_row(float* row, int width, float& minimum, float& maximum) {
    float low = minimum, high = maximum;
#pragma omp simd reduction(min : low) reduction(max : high)
    for (int x = 0; x < width; ++x) {
        const float v = std::abs(row[x]);
        row[x] = v;
        low = v < low ? v : low;
        high = v > high ? v : high;
    }
    minimum = low;
    maximum = high;
}

/// Highest of three neighbours along a row.
void max_along_row(const float* row, int width, float* out) {
    for (int x = 0; x < width; ++x) {
        const float sides = row[x - 1] > row[x + 1] ? row[x - 1] : row[x + 1];
        out[x] = sides > row[x] ? sides : row[x];
    }
}

/// Walks a map row by row and keeps what may be a local maximum.
class MapScanner {
  public:
    explicit MapScanner(const ExpandedMap& map)
        : width_(map.size().width),
          height_(map.size().height),
          expander_(*map.sizes),
          rows_(width_),
          row_maxima_(static_cast<std::size_t>(width_) * RowRing::rows, outside) {
        expander_.load(*map.image, map.level, 0, height_);
    }

    MapScan run() {
        scan_.minimum = std::numeric_limits<float>::infinity();
        // Row y is looked at when the `reach` rows below it are there.
        for (int y = 0; y < height_ + reach; ++y) {
            add_row(y);
            if (y >= reach) scan_row(y - reach);
        }
        return std::move(scan_);
    }

  private:
    void add_row(int y) {
        float* const row = rows_.row(y);
        if (y < height_) {
            expander_.expand_row(y, row);
            take_row(row, width_, scan_.minimum, scan_.maximum);
        } else {
            rows_.clear_row(y);
        }
        max_along_row(row, width_, maxima(y));
    }

    float* maxima(int y) {
        return row_maxima_.data() +
               static_cast<std::ptrdiff_t>((y + RowRing::rows) % RowRing::rows) * static_cast<std::ptrdiff_t>(width_);
    }

    void scan_row(int y) {
        constexpr int block = 64;
        const float* const row = rows_.row(y);
        const float* const above = maxima(y - 1);
        const float* const here = maxima(y);
        const float* const below = maxima(y + 1);
        const auto highest = [&](int x) {
            const float higher = above[x] > below[x] ? above[x] : below[x];
            return higher > here[x] ? higher : here[x];
        };
        // What is under .1 of the maximum so far is under .1 of the range in the end; a little less for rounding.
        const float threshold = 0.999f * static_cast<float>(lowest_maximum) * scan_.maximum;
        for (int x0 = 0; x0 < width_; x0 += block) {
            const int x1 = std::min(x0 + block, width_);
            int found = 0;
            for (int x = x0; x < x1; ++x) {
                found |= static_cast<int>(row[x] >= highest(x)) & static_cast<int>(row[x] > threshold);
            }
            if (found == 0) continue;
            for (int x = x0; x < x1; ++x) {
                if (row[x] > threshold && row[x] >= highest(x)) add_candidate(x, y);
            }
        }
    }

    void add_candidate(int x, int y) {
        Candidate& c = scan_.candidates.emplace_back();
        c.x = x, c.y = y;
        auto out = c.values.begin();
        for (int dy = -reach; dy <= reach; ++dy) {
            out = std::copy_n(rows_.row(y + dy) + (x - reach), Candidate::side, out);
        }
    }

    int width_, height_;
    RowExpander expander_;
    RowRing rows_;
    std::vector<float> row_maxima_;
    MapScan scan_;
};

struct Quantiser {
    double minimum, range;

    int operator()(float value) const {
        return static_cast<int>(std::floor((value - minimum) / range * quantisation_steps + 0.5));
    }
};

/// A plateau that is higher than all around it is known by the raster index of its first pixel.
struct Plateau {
    bool highest = true;
    std::int64_t first = std::numeric_limits<std::int64_t>::max();
};

/// Flood fill from (x, y) over pixels of one quantised value. Quits where `value_at` has no answer.
/// @param value_at  (x, y) -> optional<int>; visit(x, y) marks a pixel and says whether it is new
template <class ValueAt, class Visit>
std::optional<Plateau> fill_plateau(int x, int y, int width, const ValueAt& value_at, const Visit& visit) {
    struct Position {
        int x, y;
    };
    Plateau plateau;
    const int level = *value_at(x, y);
    visit(x, y);
    std::vector<Position> stack = {{x, y}};
    while (!stack.empty()) {
        const Position at = stack.back();
        stack.pop_back();
        plateau.first = std::min(plateau.first, static_cast<std::int64_t>(at.y) * width + at.x);
        for (int ny = at.y - 1; ny <= at.y + 1; ++ny) {
            for (int nx = at.x - 1; nx <= at.x + 1; ++nx) {
                const std::optional<int> value = value_at(nx, ny);
                if (!value) return std::nullopt;
                if (*value > level) plateau.highest = false;
                if (*value == level && visit(nx, ny)) stack.push_back({nx, ny});
            }
        }
    }
    return plateau;
}

/// The candidate's plateau, if it ends within what was kept around it.
std::optional<Plateau> find_small_plateau(const Candidate& c, int width, const Quantiser& quantise) {
    std::array<bool, Candidate::side * Candidate::side> visited{};
    const auto index = [&](int x, int y) {
        return static_cast<std::size_t>((y - c.y + reach) * Candidate::side + (x - c.x + reach));
    };
    const auto value_at = [&](int x, int y) -> std::optional<int> {
        if (std::abs(x - c.x) > reach || std::abs(y - c.y) > reach) return std::nullopt;
        return quantise(c.values[index(x, y)]);
    };
    const auto visit = [&](int x, int y) { return !std::exchange(visited[index(x, y)], true); };
    return fill_plateau(c.x, c.y, width, value_at, visit);
}

/// Plateaus of any size; expands the whole map.
class LargePlateaus {
  public:
    LargePlateaus(const ExpandedMap& map, const Quantiser& quantise)
        : size_(map.size()),
          quantise_(quantise),
          values_(static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height)),
          visited_(values_.size()) {
        RowExpander expander(*map.sizes);
        expander.load(*map.image, map.level, 0, size_.height);
        for (int y = 0; y < size_.height; ++y) expander.expand_row(y, values_.data() + index(0, y));
    }

    /// Nothing if the plateau was found before.
    std::optional<Plateau> find(const Candidate& c) {
        if (visited_[index(c.x, c.y)] != 0) return std::nullopt;
        const auto value_at = [&](int x, int y) -> std::optional<int> {
            if (x < 0 || y < 0 || x >= size_.width || y >= size_.height) return -1;
            return quantise_(std::abs(values_[index(x, y)]));
        };
        const auto visit = [&](int x, int y) { return std::exchange(visited_[index(x, y)], 1) == 0; };
        return fill_plateau(c.x, c.y, size_.width, value_at, visit);
    }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) + static_cast<std::size_t>(x);
    }

    LevelSize size_;
    Quantiser quantise_;
    std::vector<float> values_;
    std::vector<std::uint8_t> visited_;
};

}  // namespace

MapScan scan_map(const ExpandedMap& map) {
    return MapScanner(map).run();
}

std::vector<double> find_local_maxima(const ExpandedMap& map, const MapScan& scan) {
    const Quantiser quantise{scan.minimum, static_cast<double>(scan.maximum) - scan.minimum};
    struct Maximum {
        std::int64_t first;
        int height;
    };
    std::vector<Maximum> maxima;
    std::optional<LargePlateaus> large;
    for (const Candidate& c : scan.candidates) {
        const int height = quantise(c.value());
        if (height < lowest_maximum * quantisation_steps) continue;
        std::optional<Plateau> plateau = find_small_plateau(c, map.size().width, quantise);
        if (!plateau) {
            if (!large) large.emplace(map, quantise);
            plateau = large->find(c);
        }
        if (plateau && plateau->highest) maxima.push_back({plateau->first, height});
    }
    // A plateau with several candidates was found from each of them.
    const auto by_first = [](const Maximum& a, const Maximum& b) { return a.first < b.first; };
    const auto same_first = [](const Maximum& a, const Maximum& b) { return a.first == b.first; };
    std::sort(maxima.begin(), maxima.end(), by_first);
    maxima.erase(std::unique(maxima.begin(), maxima.end(), same_first), maxima.end());
    std::vector<double> heights;
    for (const Maximum& m : maxima) heights.push_back(m.height / quantisation_steps);
    return heights;
}

}  // namespace aleph
