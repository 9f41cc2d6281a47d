#include "perception/saliency.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/parallel.h"
#include "perception/normalize.h"
#include "perception/sensitivity.h"

namespace aleph {

namespace {

constexpr std::size_t rows_per_band = 32;
constexpr double feature_floor = 1e-6;  // of max |A| (MODEL 5.3)
constexpr double motion_floor = 1e-3;   // deg/s (MODEL 5.3)
constexpr double summed_floor = 1e-6;   // of sums of maps in [0,1]

/// A feature map and what N(.) multiplies its absolute value with.
struct WeightedMap {
    const FeatureMap* map;
    Normalization normalization;
};

std::vector<WeightedMap> weigh_maps(const std::vector<FeatureMap>& maps, const std::vector<LevelSize>& sizes,
                                    double largest_a, SaliencyGrid grid) {
    std::vector<WeightedMap> weighted(maps.size());
    parallel_for(maps.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const double floor = maps[i].channel == Channel::motion ? motion_floor : feature_floor * largest_a;
            const FeatureMap& map = maps[i];
            weighted[i] = {&map, grid == SaliencyGrid::full
                                     ? compute_normalization({&map.difference, map.level, &sizes}, floor)
                                     : compute_normalization(map.difference, floor)};
        }
    });
    // A map that N(.) made 0 adds nothing; dropping it here saves its second expansion.
    std::erase_if(weighted, [](const WeightedMap& w) { return w.normalization.scale() == 0.0; });
    return weighted;
}

/// sum += scale * (|row| - minimum)
void add_normalized(const float* row, std::size_t count, const Normalization& n, float* sum) {
    const auto scale = static_cast<float>(n.scale());
    const auto offset = static_cast<float>(n.scale() * n.minimum);
    for (std::size_t x = 0; x < count; ++x) sum[x] += std::abs(row[x]) * scale - offset;
}

/// Sums at full size, in bands of rows: every map is expanded again instead of being kept.
void sum_full(const std::vector<WeightedMap>& maps, const std::vector<LevelSize>& sizes, Saliency& out) {
    const LevelSize size = sizes.front();
    parallel_for(static_cast<std::size_t>(size.height), rows_per_band, [&](std::size_t begin, std::size_t end) {
        RowExpander expander(sizes);
        const int first = static_cast<int>(begin), last = static_cast<int>(end);
        const std::size_t count = (end - begin) * static_cast<std::size_t>(size.width);
        for (const WeightedMap& w : maps) {
            float* const sum = out.conspicuity[static_cast<std::size_t>(w.map->channel)].row(first);
            add_normalized(expander.expand_rows(w.map->difference, w.map->level, first, last), count, w.normalization,
                           sum);
        }
    });
}

/// Sums per centre level on its own grid, coarse to fine, then one expansion per channel.
void sum_center(const std::vector<WeightedMap>& maps, const std::vector<LevelSize>& sizes, Saliency& out) {
    parallel_for(out.conspicuity.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t channel = begin; channel < end; ++channel) {
            Image<float> sum(sizes.back().width, sizes.back().height);
            for (int level = saliency_levels - 2; level >= 0; --level) {
                const LevelSize size = sizes[static_cast<std::size_t>(level)];
                sum = expand(sum, size);
                for (const WeightedMap& w : maps) {
                    if (w.map->level != level || static_cast<std::size_t>(w.map->channel) != channel) continue;
                    add_normalized(w.map->difference.row(0), sum.size(), w.normalization, sum.row(0));
                }
            }
            out.conspicuity[channel] = std::move(sum);
        }
    });
}

struct Range {
    float minimum = std::numeric_limits<float>::infinity();
    float maximum = -std::numeric_limits<float>::infinity();
};

/// raw = sum of N(conspicuity); its range.
void sum_channels(Saliency& out) {
    std::array<Normalization, channel_count> normalization;
    parallel_for(normalization.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            normalization[c] = compute_normalization(out.conspicuity[c], summed_floor);
        }
    });
    const auto height = static_cast<std::size_t>(out.raw.height);
    std::vector<Range> ranges((height + rows_per_band - 1) / rows_per_band);
    parallel_for(height, rows_per_band, [&](std::size_t begin, std::size_t end) {
        const std::size_t count = (end - begin) * static_cast<std::size_t>(out.raw.width);
        float* const raw = out.raw.row(static_cast<int>(begin));
        for (std::size_t c = 0; c < normalization.size(); ++c) {
            if (normalization[c].scale() == 0.0) continue;
            add_normalized(out.conspicuity[c].row(static_cast<int>(begin)), count, normalization[c], raw);
        }
        Range& range = ranges[begin / rows_per_band];
        const auto [low, high] = std::minmax_element(raw, raw + count);
        range = {*low, *high};
    });
    Range total;
    for (const Range& r : ranges) total = {std::min(total.minimum, r.minimum), std::max(total.maximum, r.maximum)};
    out.minimum = total.minimum;
    out.maximum = total.maximum;
    out.fallback = !(total.maximum - total.minimum > static_cast<float>(summed_floor));
}

}  // namespace

float Saliency::scaled(float value) const {
    if (fallback) return static_cast<float>(tracking_efficiency);
    const float s = (value - minimum) / (maximum - minimum);
    return s > 0.0f ? (s < 1.0f ? s : 1.0f) : 0.0f;
}

Saliency compute_saliency(const ChannelPyramids& pyramids, double largest_a, SaliencyGrid grid) {
    const Image<float>& base = pyramids.a.front();
    const std::vector<LevelSize> sizes = pyramid_sizes(base.width, base.height, saliency_levels);
    const std::vector<FeatureMap> maps = make_feature_maps(pyramids);
    const std::vector<WeightedMap> weighted = weigh_maps(maps, sizes, largest_a, grid);

    Saliency out;
    out.raw = Image<float>(base.width, base.height);
    if (grid == SaliencyGrid::full) {
        for (Image<float>& c : out.conspicuity) c = Image<float>(base.width, base.height);
        sum_full(weighted, sizes, out);
    } else {
        sum_center(weighted, sizes, out);
    }
    sum_channels(out);
    return out;
}

}  // namespace aleph
