#include "perception/aleph_map.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "engine/base/parallel.h"

namespace aleph {

namespace {

constexpr auto max_aleph = static_cast<float>(highest_aleph);

/// Buffers for one row.
struct RowBuffers {
    explicit RowBuffers(int width) : velocity(width), tracked(width), flat(width), sum(width), above(width) {}
    std::vector<float> velocity;  ///< v_R, deg/s
    std::vector<float> tracked;   ///< deg/s
    std::vector<float> flat;      ///< f_6
    std::vector<float> sum;       ///< sum of L_i
    std::vector<float> above;     ///< sum of L_i (f_i - 1)
};

/// Adds one band to the sums. f - 1 is summed, so that rounding cannot bring aleph below 1.
void add_band(const float* band, const float* elevation, std::size_t width, float* sum, float* above) {
    for (std::size_t x = 0; x < width; ++x) {
        const float l = std::abs(band[x]);
        sum[x] += l;
        above[x] += l * (elevation[x] - 1.0f);
    }
}

/// Sums all bands of one row, and keeps f_6.
void sum_bands(const BandRows& bands, const ElevationRow& elevation, RowBuffers& b) {
    const std::size_t width = b.sum.size();
    for (int i = 0; i < band_count; ++i) {
        elevation.elevations(i, b.flat.data());
        add_band(bands.band(i), b.flat.data(), width, b.sum.data(), b.above.data());
    }
}

/// (5.11) from the sums; a pixel without contrast gets f_6.
void divide_sums(const RowBuffers& b, const float* noise, float* out) {
    const float* const sum = b.sum.data();
    const float* const above = b.above.data();
    const float* const flat = b.flat.data();
    const std::size_t width = b.sum.size();
    for (std::size_t x = 0; x < width; ++x) {
        const bool has_contrast = sum[x] > noise[x];
        const float divisor = has_contrast ? sum[x] : 1.0f;
        const float aleph = 1.0f + above[x] / divisor;
        out[x] = has_contrast ? aleph : flat[x];
    }
}

/// R_i = L_i / sum of L_i; a pixel without contrast has R_6 = 1 (5.3).
void keep_responses(const BandRows& bands, const std::vector<float>& sum, int y, std::vector<Image<float>>& out) {
    for (int i = 0; i < band_count; ++i) {
        float* const row = out[static_cast<std::size_t>(i)].row(y);
        const float alone = i == band_count - 1 ? 1.0f : 0.0f;
        for (std::size_t x = 0; x < sum.size(); ++x) {
            const bool has_contrast = sum[x] > bands.noise()[x];
            row[x] = has_contrast ? std::abs(bands.band(i)[x]) / sum[x] : alone;
        }
    }
}

std::uint64_t clamp_row(float* row, std::size_t width) {
    int outside = 0;
    for (std::size_t x = 0; x < width; ++x) {
        outside += static_cast<int>(!(row[x] >= 1.0f)) | static_cast<int>(!(row[x] <= max_aleph));
    }
    if (outside == 0) return 0;
    for (std::size_t x = 0; x < width; ++x) row[x] = row[x] >= 1.0f ? std::min(row[x], max_aleph) : 1.0f;
    return static_cast<std::uint64_t>(outside);
}

/// Computes rows [begin, end) of the Aleph map.
/// @return the number of values that had to be clamped
std::uint64_t compute_rows(const AlephPass& pass, const ElevationRowMaker& make_row, int begin, int end,
                           PerceptionMaps& out) {
    const int width = out.aleph.width;
    BandRows bands(pass.bands);
    bands.load(begin, end);
    const std::unique_ptr<ElevationRow> elevation = make_row(width);
    RowBuffers b(width);
    const std::vector<float> full_tracking(width, static_cast<float>(tracking_efficiency));
    std::fill(b.velocity.begin(), b.velocity.end(), static_cast<float>(drift_velocity));
    std::uint64_t clamped = 0;
    for (int y = begin; y < end; ++y) {
        if (pass.velocity != nullptr) {
            const float* const saliency = pass.saliency != nullptr ? pass.saliency->row(y) : full_tracking.data();
            retinal_velocity_row(pass.velocity->row(y), saliency, width, b.velocity.data());
            tracked_velocity_row(pass.velocity->row(y), saliency, width, b.tracked.data());
        }
        if (!out.retinal_velocity.empty()) {
            std::copy(b.velocity.begin(), b.velocity.end(), out.retinal_velocity.row(y));
        }
        bands.expand_row(y);
        elevation->load({.retinal = b.velocity.data(),
                         .tracked = b.tracked.data(),
                         .luminance = pass.luminance == nullptr ? nullptr : pass.luminance->row(y)});
        std::fill(b.sum.begin(), b.sum.end(), 0.0f);
        std::fill(b.above.begin(), b.above.end(), 0.0f);
        sum_bands(bands, *elevation, b);
        if (!out.responses.empty()) keep_responses(bands, b.sum, y, out.responses);
        for (std::size_t i = 0; i < out.elevations.size(); ++i) {
            elevation->elevations(static_cast<int>(i), out.elevations[i].row(y));
        }
        divide_sums(b, bands.noise(), out.aleph.row(y));
        clamped += clamp_row(out.aleph.row(y), width);
    }
    return clamped;
}

}  // namespace

void compute_aleph(const AlephPass& pass, const PerceptionOutputs& outputs, PerceptionMaps& maps) {
    const LevelSize size = pass.bands.sizes.front();
    maps.aleph = Image<float>(size.width, size.height);
    if (outputs.retinal_velocity) maps.retinal_velocity = maps.aleph;
    if (outputs.bands) {
        maps.responses.assign(band_count, maps.aleph);
        maps.elevations = maps.responses;
    }
    const ElevationRowMaker make_row = pass.vision.make_rows(pass.rho, pass.shown);
    std::vector<std::uint64_t> clamped((size.height + rows_per_band - 1) / rows_per_band);
    parallel_rows(size.height, rows_per_band, [&](int begin, int end) {
        clamped[begin / rows_per_band] = compute_rows(pass, make_row, begin, end, maps);
    });
    maps.clamped = std::accumulate(clamped.begin(), clamped.end(), std::uint64_t{0});
}

}  // namespace aleph
