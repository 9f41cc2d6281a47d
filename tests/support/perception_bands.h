#pragma once
// R_i of (5.3) as images. The library does not store them: it uses them row by row.

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/image.h"
#include "engine/base/pyramid.h"
#include "perception/band_response.h"

namespace aleph {

/// R_i of an achromatic image, at full size; they sum to 1 everywhere.
inline std::array<Image<float>, band_count> compute_band_response(const Image<float>& achromatic) {
    const LevelSize size{achromatic.width, achromatic.height};
    const float grey =
        summarize(size, [&](int y, float* row) { std::copy_n(achromatic.row(y), size.width, row); }).mean;
    const RowSource shifted = [&](int y, float* row) {
        for (int x = 0; x < size.width; ++x) row[x] = achromatic(x, y) - grey;
    };
    const BandLevels levels =
        make_band_levels(size, shifted, make_gaussian_pyramid(size, shifted, band_count + 1), grey);

    std::array<Image<float>, band_count> out;
    out.fill(Image<float>(size.width, size.height));
    BandRows rows(levels);
    rows.load(0, size.height);
    for (int y = 0; y < size.height; ++y) {
        rows.expand_row(y);
        for (int x = 0; x < size.width; ++x) {
            double sum = 0.0;
            for (int i = 0; i < band_count; ++i) sum += std::abs(rows.band(i)[x]);
            const bool noise = !(sum > rows.noise()[x]);
            for (int i = 0; i < band_count; ++i) {
                const double flat = i == band_count - 1 ? 1.0 : 0.0;
                out[i](x, y) = static_cast<float>(noise ? flat : std::abs(rows.band(i)[x]) / sum);
            }
        }
    }
    return out;
}

}  // namespace aleph
