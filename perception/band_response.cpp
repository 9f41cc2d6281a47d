#include "perception/band_response.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/parallel.h"

namespace aleph {

BandLevels make_band_levels(LevelSize size, RowSource finest, const std::vector<Image<float>>& a, float grey) {
    BandLevels out;
    out.sizes = pyramid_sizes(size.width, size.height, band_count + 1);
    out.grey = grey;
    parallel_for(band_count - 1, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin + 1; i < end + 1; ++i) {
            Image<float> difference = expand(a[i + 1], out.sizes[i]);
            for (std::size_t p = 0; p < difference.size(); ++p) {
                difference.pixels[p] = a[i].pixels[p] - difference.pixels[p];
            }
            out.differences[i] = std::move(difference);
        }
    });
    out.finest = std::move(finest);
    out.second = a[1];
    out.coarsest = a[band_count];
    return out;
}

BandRows::BandRows(const BandLevels& levels)
    : levels_(levels),
      expanders_(band_count + 1, RowExpander(levels.sizes)),
      finest_(levels.sizes.front().width),
      noise_(finest_.size()) {
    for (std::vector<float>& row : rows_) row.resize(finest_.size());
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
    levels_.finest(y, finest_.data());
    const float* const finest = finest_.data();
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

ChannelSummary summarize(LevelSize size, const RowSource& source) {
    std::vector<double> sums(size.height);
    std::vector<float> maxima(size.height);
    parallel_rows(size.height, rows_per_band, [&](int begin, int end) {
        std::vector<float> row(size.width);
        for (int y = begin; y < end; ++y) {
            source(y, row.data());
            const float* const values = row.data();
            double sum = 0.0;
            float highest = values[0];
#pragma omp simd reduction(+ : sum) reduction(max : highest)
            for (int x = 0; x < size.width; ++x) {
                sum += values[x];
                highest = values[x] > highest ? values[x] : highest;
            }
            sums[y] = sum;
            maxima[y] = highest;
        }
    });
    const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
    return {static_cast<float>(sum / (static_cast<double>(size.width) * size.height)),
            *std::max_element(maxima.begin(), maxima.end())};
}

}  // namespace aleph
