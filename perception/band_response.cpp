#include "perception/band_response.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/parallel.h"

namespace aleph {

BandLevels make_band_levels(std::vector<Image<float>>& a, float grey) {
    BandLevels out;
    out.sizes = pyramid_sizes(a[0].width, a[0].height, band_count + 1);
    out.grey = grey;
    parallel_each(band_count - 1, 1, [&](std::size_t below) {
        const std::size_t i = below + 1;
        out.differences[i] = difference(a[i], expand(a[i + 1], out.sizes[i]));
    });
    out.finest = std::move(a[0]);
    out.second = a[1];
    out.coarsest = a[band_count];
    return out;
}

BandRows::BandRows(const BandLevels& levels)
    : levels_(levels), expanders_(band_count + 1, RowExpander(levels.sizes)), noise_(levels.sizes.front().width) {
    for (std::vector<float>& row : rows_) row.resize(noise_.size());
}

void BandRows::load(int begin, int end) {
    expanders_[0].load(levels_.second, 1, begin, end);
    for (int i = 1; i < band_count; ++i) {
        expanders_[i].load(levels_.differences[i], i, begin, end);
    }
    expanders_[band_count].load(levels_.coarsest, band_count, begin, end);
}

void BandRows::expand_row(int y) {
    for (int i = 0; i < band_count; ++i) expanders_[i].expand_row(y, rows_[i].data());
    expanders_[band_count].expand_row(y, noise_.data());
    const float* const finest = levels_.finest.row(y);
    float* const band_0 = rows_[0].data();
    float* const noise = noise_.data();
    const float grey = levels_.grey;
    for (std::size_t x = 0; x < noise_.size(); ++x) {
        band_0[x] = finest[x] - band_0[x];
        const float fine = std::abs(finest[x] + grey);
        const float coarse = std::abs(noise[x] + grey);
        noise[x] = band_noise * (fine > coarse ? fine : coarse);
    }
}

ChannelSummary summarize(const Image<float>& channel) {
    std::vector<double> sums(channel.height);
    std::vector<float> maxima(channel.height);
    parallel_rows(channel.height, rows_per_band, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            const float* const values = channel.row(y);
            double sum = 0.0;
            float highest = values[0];
#pragma omp simd reduction(+ : sum) reduction(max : highest)
            for (int x = 0; x < channel.width; ++x) {
                sum += values[x];
                highest = values[x] > highest ? values[x] : highest;
            }
            sums[y] = sum;
            maxima[y] = highest;
        }
    });
    const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
    return {static_cast<float>(sum / static_cast<double>(channel.size())),
            *std::max_element(maxima.begin(), maxima.end())};
}

}  // namespace aleph
