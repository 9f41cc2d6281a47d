#include "perception/saliency/normalize.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace aleph {

namespace {

constexpr float outside = -1.0f;  // lower than any value of a map
constexpr double quantization_steps = 65535.0;
constexpr double min_height = 0.1;  // local maxima below it are dropped: noise and ringing

/// A pixel that is higher than its neighbours before it in raster order and not lower than those after it. Every
/// plateau that is a local maximum has one; of a flat map only the first pixel is one.
struct Candidate {
    int x, y;
    float value;
    float neighbor;  ///< the highest of the eight
};

struct MapScan {
    float minimum = std::numeric_limits<float>::infinity(), maximum = 0.0f;
    std::vector<Candidate> candidates;  ///< in raster order; those below min_height may be missing
};

/// Takes the absolute value of a row; extends the range to hold it.
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

/// Reads a map row by row and collects the candidates.
class MapScanner {
  public:
    MapScanner(LevelSize size, RowExpander& expander, double floor)
        : size_(size),
          expander_(expander),
          stride_(size.width + 2),
          floor_(static_cast<float>(floor)),
          rows_(stride_ * ring, outside),
          row_maxima_(rows_.size(), outside) {}

    MapScan run() {
        for (int y = 0; y <= size_.height; ++y) {
            add_row(y);
            if (y > 0) scan_row(y - 1);
        }
        return std::move(scan_);
    }

  private:
    static constexpr int ring = 4;  // rows that are kept: at least the three around a pixel

    /// Pixel 0 of row y >= -1; the pixels left and right of the row are `outside`.
    float* row(int y) { return rows_.data() + (y + ring) % ring * stride_ + 1; }
    float* maxima(int y) { return row_maxima_.data() + (y + ring) % ring * stride_ + 1; }

    void add_row(int y) {
        if (y < size_.height) {
            expander_.expand_row(y, row(y));
            take_row(row(y), size_.width, scan_.minimum, scan_.maximum);
        } else {
            std::fill_n(row(y), size_.width, outside);
        }
        max_along_row(row(y), size_.width, maxima(y));
    }

    void scan_row(int y) {
        constexpr int block = 64;
        const float* const here = row(y);
        const float* const above = maxima(y - 1);
        const float* const below = maxima(y + 1);
        // A value below .1 of the maximum so far, or of the floor, is below .1 of the final range if that is above the
        // floor. The factor .999 allows for rounding.
        const float threshold = 0.999f * static_cast<float>(min_height) * std::max(scan_.maximum, floor_);
        const auto is_candidate = [&](int x) {
            // & instead of &&: without branches the loop over a block vectorises.
            const float v = here[x];
            return int{v > threshold} & int{v > above[x]} & int{v > here[x - 1]} & int{v >= here[x + 1]} &
                   int{v >= below[x]};
        };
        for (int x0 = 0; x0 < size_.width; x0 += block) {
            const int x1 = std::min(x0 + block, size_.width);
            int found = 0;
            for (int x = x0; x < x1; ++x) found |= is_candidate(x);
            if (found == 0) continue;
            for (int x = x0; x < x1; ++x) {
                if (is_candidate(x) == 0) continue;
                const float sides = std::max(here[x - 1], here[x + 1]);
                scan_.candidates.push_back({x, y, here[x], std::max({sides, above[x], below[x]})});
            }
        }
    }

    LevelSize size_;
    RowExpander& expander_;
    std::ptrdiff_t stride_;
    float floor_;
    std::vector<float> rows_, row_maxima_;
    MapScan scan_;
};

struct Quantizer {
    double minimum, range;

    int operator()(float value) const {
        return static_cast<int>(std::floor((value - minimum) / range * quantization_steps + 0.5));
    }
};

/// The map after quantisation, for plateaus of more than one pixel. Rows are made when they are first read.
class QuantizedMap {
  public:
    QuantizedMap(LevelSize size, RowExpander& expander, const Quantizer& quantize)
        : size_(size), expander_(expander), quantize_(quantize), values_(size.width), rows_(size.height) {}

    struct Plateau {
        bool is_maximum = true;  ///< higher than all around it, and not found before
        std::int64_t first = std::numeric_limits<std::int64_t>::max();  ///< raster index of its first pixel
    };

    /// The plateau of pixel (x, y).
    Plateau fill(int x, int y) {
        Plateau plateau;
        const int level = level_at(x, y);
        if (!visit(x, y)) return {.is_maximum = false};
        std::vector<Position> stack = {{x, y}};
        while (!stack.empty()) {
            const Position at = stack.back();
            stack.pop_back();
            plateau.first = std::min(plateau.first, static_cast<std::int64_t>(at.y) * size_.width + at.x);
            for (int ny = at.y - 1; ny <= at.y + 1; ++ny) {
                for (int nx = at.x - 1; nx <= at.x + 1; ++nx) {
                    const int neighbor = level_at(nx, ny);
                    if (neighbor > level) plateau.is_maximum = false;
                    if (neighbor == level && visit(nx, ny)) stack.push_back({nx, ny});
                }
            }
        }
        return plateau;
    }

  private:
    struct Position {
        int x, y;
    };
    struct Row {
        std::vector<std::uint16_t> levels;
        std::vector<bool> visited;
    };

    int level_at(int x, int y) {
        if (x < 0 || y < 0 || x >= size_.width || y >= size_.height) return -1;
        Row& row = rows_[y];
        if (row.levels.empty()) {
            expander_.expand_row(y, values_.data());
            for (const float v : values_) row.levels.push_back(static_cast<std::uint16_t>(quantize_(std::abs(v))));
            row.visited.resize(values_.size());
        }
        return row.levels[x];
    }

    /// Marks a pixel as visited; true if it was not.
    bool visit(int x, int y) {
        const bool is_new = !rows_[y].visited[x];
        rows_[y].visited[x] = true;
        return is_new;
    }

    LevelSize size_;
    RowExpander& expander_;
    Quantizer quantize_;
    std::vector<float> values_;
    std::vector<Row> rows_;
};

/// Heights in [.1, 1], after min-max of the map to [0,1], of the local maxima that N(.) averages: 8-connected plateaus
/// of the map quantised to 16 bits that are higher than all their neighbours; lower ones are left out. In raster order.
/// The map is streamed row by row, never stored: what is kept is one position per possible maximum and the rows of
/// plateaus of more than one pixel.
std::vector<double> find_heights(const MapScan& scan, LevelSize size, RowExpander& expander) {
    struct Maximum {
        std::int64_t first;  ///< raster index
        int level;
    };
    const Quantizer quantize{scan.minimum, static_cast<double>(scan.maximum) - scan.minimum};
    std::vector<Maximum> maxima;
    QuantizedMap quantized(size, expander, quantize);
    for (const Candidate& c : scan.candidates) {
        const int level = quantize(c.value);
        if (level < min_height * quantization_steps) continue;
        if (quantize(c.neighbor) < level) {  // a plateau of one pixel
            maxima.push_back({static_cast<std::int64_t>(c.y) * size.width + c.x, level});
            continue;
        }
        const QuantizedMap::Plateau plateau = quantized.fill(c.x, c.y);
        if (plateau.is_maximum) maxima.push_back({plateau.first, level});
    }
    std::ranges::sort(maxima, {}, &Maximum::first);
    std::vector<double> heights;
    for (const Maximum& m : maxima) heights.push_back(m.level / quantization_steps);
    return heights;
}

}  // namespace

Normalization compute_normalization(const ExpandedMap& map, double floor) {
    RowExpander expander(*map.sizes);
    expander.load(*map.image, map.level, 0, map.size().height);
    const MapScan scan = MapScanner(map.size(), expander, floor).run();
    Normalization result{scan.minimum, scan.maximum, 0.0, true};
    if (!(result.maximum - result.minimum > floor)) return result;
    result.empty = false;
    const std::vector<double> heights = find_heights(scan, map.size(), expander);
    // Leaves out one global maximum, whose height is 1.
    const auto others = static_cast<double>(heights.size()) - 1.0;
    const double sum = std::accumulate(heights.begin(), heights.end(), 0.0);
    const double mean = others > 0.0 ? (sum - 1.0) / others : 0.0;
    result.weight = (1.0 - mean) * (1.0 - mean);
    return result;
}

Normalization compute_normalization(const Image<float>& map, double floor) {
    const std::vector<LevelSize> sizes = {{map.width, map.height}};
    return compute_normalization(ExpandedMap{&map, 0, &sizes}, floor);
}

}  // namespace aleph
