#include "perception/band_response.h"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"

namespace aleph {

namespace {
constexpr std::size_t rows_per_band = 32;
}

BandLevels take_band_levels(std::vector<Image<float>>& a, float grey) {
    BandLevels out;
    out.sizes = pyramid_sizes(a.front().width, a.front().height, band_count + 1);
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
    out.coarsest = a[band_count];
    out.finest = std::move(a[0]);
    out.second = std::move(a[1]);
    return out;
}

BandRows::BandRows(const BandLevels& levels)
    : levels_(levels),
      expanders_(band_count + 1, RowExpander(levels.sizes)),
      noise_(static_cast<std::size_t>(levels.sizes.front().width)) {
    for (std::vector<float>& row : rows_) row.resize(noise_.size());
}

void BandRows::load(int begin, int end) {
    expanders_[0].load(levels_.second, 1, begin, end);
    for (int i = 1; i < band_count; ++i) {
        const auto index = static_cast<std::size_t>(i);
        expanders_[index].load(levels_.differences[index], i, begin, end);
    }
    expanders_[band_count].load(levels_.coarsest, band_count, begin, end);
}

void BandRows::expand_row(int y) {
    for (std::size_t i = 0; i < rows_.size(); ++i) expanders_[i].expand_row(y, rows_[i].data());
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

std::array<Image<float>, band_count> compute_band_response(const Image<float>& achromatic) {
    const float grey = mean_grey(achromatic);
    Image<float> shifted = achromatic;
    for (float& v : shifted.pixels) v -= grey;
    std::vector<Image<float>> pyramid = make_gaussian_pyramid(std::move(shifted), band_count + 1);
    const BandLevels levels = take_band_levels(pyramid, grey);

    std::array<Image<float>, band_count> out;
    for (Image<float>& image : out) image = Image<float>(achromatic.width, achromatic.height);
    parallel_for(static_cast<std::size_t>(achromatic.height), rows_per_band, [&](std::size_t begin, std::size_t end) {
        BandRows rows(levels);
        rows.load(static_cast<int>(begin), static_cast<int>(end));
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
            rows.expand_row(y);
            for (int x = 0; x < achromatic.width; ++x) {
                double sum = 0.0;
                for (int i = 0; i < band_count; ++i) sum += std::abs(rows.band(i)[x]);
                const bool noise = !(sum > rows.noise()[x]);
                for (int i = 0; i < band_count; ++i) {
                    const double flat = i == band_count - 1 ? 1.0 : 0.0;
                    out[static_cast<std::size_t>(i)](x, y) =
                        static_cast<float>(noise ? flat : std::abs(rows.band(i)[x]) / sum);
                }
            }
        }
    });
    return out;
}

float mean_grey(const Image<float>& image) {
    const auto height = static_cast<std::size_t>(image.height);
    std::vector<double> sums(height);
    parallel_for(height, rows_per_band, [&](std::size_t begin, std::size_t end) {
        constexpr std::size_t lanes = 8;  // independent sums, so that additions overlap
        for (std::size_t y = begin; y < end; ++y) {
            const float* const row = image.row(static_cast<int>(y));
            double partial[lanes] = {};
            const auto width = static_cast<std::size_t>(image.width);
            std::size_t x = 0;
            for (; x + lanes <= width; x += lanes) {
                for (std::size_t lane = 0; lane < lanes; ++lane) partial[lane] += row[x + lane];
            }
            for (; x < width; ++x) partial[0] += row[x];
            for (const double p : partial) sums[y] += p;
        }
    });
    double sum = 0.0;
    for (const double s : sums) sum += s;
    return static_cast<float>(sum / static_cast<double>(image.size()));
}

}  // namespace aleph
