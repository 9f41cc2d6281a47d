#include "perception/saliency/saliency.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/index.h"
#include "engine/base/parallel.h"
#include "perception/saliency/normalize.h"
#include "perception/vision/retinal_velocity.h"

namespace aleph {

namespace {

constexpr double feature_floor = 1e-6;  // of max |A|
constexpr double motion_floor = 1e-3;   // deg/s
constexpr double summed_floor = 1e-6;   // of sums of maps in [0,1]

/// A feature map and its N(.).
struct WeightedMap {
    const FeatureMap* map;
    Normalization normalization;
};

std::vector<WeightedMap> weigh_maps(const std::vector<FeatureMap>& maps, const std::vector<LevelSize>& sizes,
                                    double max_a, SaliencyGrid grid) {
    std::vector<WeightedMap> weighted(maps.size());
    parallel_each(maps.size(), 1, [&](std::size_t i) {
        const FeatureMap& map = maps[i];
        const double floor = map.channel == FeatureChannel::motion ? motion_floor : feature_floor * max_a;
        weighted[i] = {&map, grid == SaliencyGrid::full
                                 ? compute_normalization({&map.difference, map.level, &sizes}, floor)
                                 : compute_normalization(map.difference, floor)};
    });
    // Maps that N(.) makes 0 are dropped: they need no second expansion.
    std::erase_if(weighted, [](const WeightedMap& w) { return w.normalization.scale() == 0.0; });
    return weighted;
}

/// sum += scale * (|row| - minimum)
void add_normalized(const float* row, std::size_t count, const Normalization& n, float* sum) {
    const auto scale = static_cast<float>(n.scale());
    const auto offset = static_cast<float>(n.scale() * n.minimum);
    for (std::size_t x = 0; x < count; ++x) sum[x] += std::abs(row[x]) * scale - offset;
}

/// Sums at full size, in bands of rows. Every map is expanded again, which needs less memory than storing 48 of them.
void sum_full(const std::vector<WeightedMap>& maps, const std::vector<LevelSize>& sizes, Saliency& out) {
    const LevelSize size = sizes.front();
    for (Image<float>& c : out.conspicuity) c = Image<float>(size.width, size.height);
    parallel_rows(size.height, rows_per_band, [&](int begin, int end) {
        RowExpander expander(sizes);
        std::vector<float> row(size.width);
        for (const WeightedMap& w : maps) {
            Image<float>& sum = out.conspicuity[index_of(w.map->channel)];
            expander.load(w.map->difference, w.map->level, begin, end);
            for (int y = begin; y < end; ++y) {
                expander.expand_row(y, row.data());
                add_normalized(row.data(), row.size(), w.normalization, sum.row(y));
            }
        }
    });
}

/// Sums per centre level on its own grid, from the coarsest centre to the finest.
void sum_center(const std::vector<WeightedMap>& maps, const std::vector<LevelSize>& sizes, Saliency& out) {
    parallel_each(out.conspicuity.size(), 1, [&](std::size_t channel) {
        Image<float>& sum = out.conspicuity[channel];
        for (int level = coarsest_center; level >= finest_center; --level) {
            const LevelSize size = sizes[level];
            sum = sum.empty() ? Image<float>(size.width, size.height) : expand(sum, size);
            for (const WeightedMap& w : maps) {
                if (w.map->level != level || index_of(w.map->channel) != channel) continue;
                add_normalized(w.map->difference.row(0), sum.size(), w.normalization, sum.row(0));
            }
        }
    });
}

struct Range {
    float minimum = std::numeric_limits<float>::infinity();
    float maximum = -std::numeric_limits<float>::infinity();
};

Range find_range(const float* values, std::size_t count) {
    float low = values[0], high = values[0];
#pragma omp simd reduction(min : low) reduction(max : high)
    for (std::size_t i = 0; i < count; ++i) {
        low = values[i] < low ? values[i] : low;
        high = values[i] > high ? values[i] : high;
    }
    return {low, high};
}

/// sum = sum of N(conspicuity); returns its range.
Range sum_channels(const Saliency& saliency, Image<float>& sum) {
    std::array<Normalization, channel_count> normalization;
    parallel_each(normalization.size(), 1, [&](std::size_t c) {
        normalization[c] = compute_normalization(
            {&saliency.conspicuity[c], saliency.conspicuity_level, &saliency.sizes}, summed_floor);
    });
    std::vector<Range> ranges((sum.height + rows_per_band - 1) / rows_per_band);
    parallel_rows(sum.height, rows_per_band, [&](int begin, int end) {
        RowExpander expander(saliency.sizes);
        std::vector<float> row(sum.width);
        for (int c = 0; c < channel_count; ++c) {
            if (normalization[c].scale() == 0.0) continue;
            expander.load(saliency.conspicuity[c], saliency.conspicuity_level, begin, end);
            for (int y = begin; y < end; ++y) {
                expander.expand_row(y, row.data());
                add_normalized(row.data(), row.size(), normalization[c], sum.row(y));
            }
        }
        ranges[begin / rows_per_band] = find_range(sum.row(begin), (end - begin) * row.size());
    });
    Range total;
    for (const Range& r : ranges) total = {std::min(total.minimum, r.minimum), std::max(total.maximum, r.maximum)};
    return total;
}

/// Min-max to exactly [0,1], in place.
void scale_to_unit_range(Image<float>& image, Range range) {
    const float minimum = range.minimum;
    const float width = range.maximum - range.minimum;
    parallel_rows(image.height, rows_per_band, [&](int begin, int end) {
        float* const values = image.row(begin);
        const std::size_t count = image.index(0, end) - image.index(0, begin);
        for (std::size_t i = 0; i < count; ++i) {
            const float s = (values[i] - minimum) / width;
            const float positive = s > 0.0f ? s : 0.0f;
            values[i] = positive < 1.0f ? positive : 1.0f;
        }
    });
}

}  // namespace

Image<float> full_conspicuity(const Saliency& saliency, FeatureChannel channel) {
    return expand_to_level(saliency.conspicuity[index_of(channel)], saliency.sizes, saliency.conspicuity_level, 0);
}

Saliency compute_saliency(const ChannelPyramids& pyramids, double max_a, SaliencyGrid grid) {
    Saliency out;
    out.sizes = pyramid_sizes(pyramids.size.width, pyramids.size.height, saliency_levels);
    const std::vector<FeatureMap> maps = make_feature_maps(pyramids);
    const std::vector<WeightedMap> weighted = weigh_maps(maps, out.sizes, max_a, grid);
    if (grid == SaliencyGrid::full) {
        sum_full(weighted, out.sizes, out);
    } else {
        sum_center(weighted, out.sizes, out);
        out.conspicuity_level = finest_center;
    }
    Image<float> sum(pyramids.size.width, pyramids.size.height);
    const Range range = sum_channels(out, sum);
    out.fallback = !(range.maximum - range.minimum > static_cast<float>(summed_floor));
    if (out.fallback) {
        std::fill(sum.pixels.begin(), sum.pixels.end(), static_cast<float>(tracking_efficiency));
    } else {
        scale_to_unit_range(sum, range);
    }
    out.map = std::move(sum);
    return out;
}

}  // namespace aleph
