#include "perception/aleph_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/base/parallel.h"
#include "perception/fast_math.h"

namespace aleph {

namespace {

constexpr int rows_per_band = 32;
constexpr float max_aleph = 250.76f;        // the supremum of CSF_max is 250.751
constexpr float max_velocity = 1e30f;       // deg/s
constexpr float max_model_velocity = 1e6f;  // deg/s; above 1.8e5 no contrast is visible and every f is 1
constexpr float log2_e = static_cast<float>(std::numbers::log2e);
constexpr float log10_2 = 0.30102999566398120f;

/// Buffers for one row.
struct RowBuffers {
    explicit RowBuffers(int width) : velocity(width), tracked(width), flat(width), sum(width), above(width) {}
    std::vector<float> velocity;  ///< v_R, deg/s
    std::vector<float> tracked;   ///< deg/s; for castle only
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

/// A band whose elevation is 1 everywhere.
void add_flat_band(const float* band, std::size_t width, float* sum) {
    for (std::size_t x = 0; x < width; ++x) sum[x] += std::abs(band[x]);
}

/// The sums over all bands of one row, and f_6.
void sum_bands(const BandRows& bands, const ElevationRow& elevation, RowBuffers& b) {
    const std::size_t width = b.sum.size();
    for (int i = 0; i < band_count; ++i) {
        if (elevation.is_one(i)) {
            add_flat_band(bands.band(i), width, b.sum.data());
        } else {
            elevation.elevations(i, b.flat.data());
            add_band(bands.band(i), b.flat.data(), width, b.sum.data(), b.above.data());
        }
    }
    if (elevation.is_one(band_count - 1)) std::fill(b.flat.begin(), b.flat.end(), 1.0f);
}

void sum_bands(const BandRows& bands, const CastleRow& elevation, RowBuffers& b) {
    const std::size_t width = b.sum.size();
    for (int i = 0; i < band_count; ++i) {
        add_band(bands.band(i), elevation.elevations(i), width, b.sum.data(), b.above.data());
    }
    std::copy_n(elevation.elevations(band_count - 1), width, b.flat.begin());
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

}  // namespace

ElevationRow::ElevationRow(const std::array<double, band_count>& rho, int width, const KellyModel& model)
    : model_(model), spread_(width), peak_(width) {
    for (int i = 0; i < band_count; ++i) {
        slope_[i] = static_cast<float>(rho[i] * model.angular() / csf_rho_numerator);
    }
}

void ElevationRow::load(const float* velocity) {
    // CSF_max = k c0 c2 v rho_max^2 e^-2
    const auto peak_factor =
        static_cast<float>(model_.c0 * model_.c2 * csf_rho_numerator * csf_rho_numerator * std::exp(-2.0));
    const auto log_offset = static_cast<float>(std::log10(model_.c2 / csf_k_velocity));
    const auto c2 = static_cast<float>(model_.c2), slowest = static_cast<float>(model_.min_velocity);
    const std::size_t width = spread_.size();
    float* const spread = spread_.data();
    float* const peak = peak_.data();
    float largest = 0.0f;
#pragma omp simd reduction(max : largest)
    for (std::size_t x = 0; x < width; ++x) {
        const float limited = velocity[x] < max_model_velocity ? velocity[x] : max_model_velocity;
        const float v = limited > slowest ? limited : slowest;
        const float s = c2 * v + static_cast<float>(csf_rho_offset);
        const float l = std::abs(log10_2 * fast_log2(v) + log_offset);
        const float k = static_cast<float>(csf_k_offset) + static_cast<float>(csf_k_slope) * (l * l * l);
        spread[x] = s;
        largest = s > largest ? s : largest;
        peak[x] = peak_factor * k * v / (s * s);
    }
    max_spread_ = largest;
}

bool ElevationRow::is_one(int band) const {
    return !(slope_[band] * max_spread_ > 1.0f);
}

void ElevationRow::elevations(int band, float* out) const {
    // k, c0 and c2 v cancel: CSF_max / CSF = e^(2x-2) / x^2 with x = rho / rho_peak. Where CSF < 1, f is CSF_max.
    const float slope = slope_[band];
    const std::size_t width = spread_.size();
    const float* const spread = spread_.data();
    const float* const peak = peak_.data();
    for (std::size_t x = 0; x < width; ++x) {
        const float ratio = slope * spread[x];
        const float f = fast_exp2(2.0f * log2_e * (ratio - 1.0f)) / (ratio * ratio);
        const float clamped = f < peak[x] ? f : peak[x];
        const float at_least_one = clamped > 1.0f ? clamped : 1.0f;
        out[x] = ratio > 1.0f ? at_least_one : 1.0f;
    }
}

void retinal_velocity_row(const float* velocity, const float* saliency, int count, float* out) {
    constexpr auto drift = static_cast<float>(drift_velocity);
    for (int x = 0; x < count; ++x) {
        const float positive = velocity[x] > 0.0f ? velocity[x] : 0.0f;
        const float v = positive < max_velocity ? positive : max_velocity;
        const float tracked = v * (1.0f - saliency[x]) - drift;
        const float limited = v - static_cast<float>(pursuit_limit);
        const float slip = tracked > limited ? tracked : limited;
        out[x] = slip > drift ? slip : drift;
    }
}

void tracked_velocity_row(const float* velocity, const float* saliency, int count, float* out) {
    for (int x = 0; x < count; ++x) {
        const float positive = velocity[x] > 0.0f ? velocity[x] : 0.0f;
        const float followed = (positive < max_velocity ? positive : max_velocity) * saliency[x];
        out[x] = followed < static_cast<float>(pursuit_limit) ? followed : static_cast<float>(pursuit_limit);
    }
}

namespace {

/// Rows [begin, end) of the Aleph map. @return the number of values that had to be clamped
std::uint64_t compute_rows(const AlephPass& pass, int begin, int end, AlephImages& out) {
    const int width = out.aleph.width;
    BandRows bands(pass.bands);
    bands.load(begin, end);
    ElevationRow kelly(pass.rho, pass.castle != nullptr ? 0 : width, pass.model);
    std::optional<CastleRow> castle;
    if (pass.castle != nullptr) castle.emplace(pass.castle->table, width);
    RowBuffers b(width);
    const std::vector<float> full_tracking(width, static_cast<float>(tracking_efficiency));
    std::fill(b.velocity.begin(), b.velocity.end(), static_cast<float>(drift_velocity));
    std::uint64_t clamped = 0;
    for (int y = begin; y < end; ++y) {
        if (pass.velocity != nullptr) {
            const float* const saliency = pass.saliency != nullptr ? pass.saliency->row(y) : full_tracking.data();
            retinal_velocity_row(pass.velocity->row(y), saliency, width, b.velocity.data());
            if (castle) tracked_velocity_row(pass.velocity->row(y), saliency, width, b.tracked.data());
        }
        if (!out.retinal_velocity.empty()) {
            std::copy(b.velocity.begin(), b.velocity.end(), out.retinal_velocity.row(y));
        }
        bands.expand_row(y);
        std::fill(b.sum.begin(), b.sum.end(), 0.0f);
        std::fill(b.above.begin(), b.above.end(), 0.0f);
        if (castle) {
            castle->load(b.velocity.data(), b.tracked.data(), pass.castle->luminance.row(y));
            sum_bands(bands, *castle, b);
        } else {
            kelly.load(b.velocity.data());
            sum_bands(bands, kelly, b);
        }
        if (!out.responses.empty()) keep_responses(bands, b.sum, y, out.responses);
        for (int i = 0; i < static_cast<int>(out.elevations.size()); ++i) {
            float* const row = out.elevations[static_cast<std::size_t>(i)].row(y);
            if (castle) {
                std::copy_n(castle->elevations(i), width, row);
            } else {
                kelly.elevations(i, row);
            }
        }
        divide_sums(b, bands.noise(), out.aleph.row(y));
        clamped += clamp_row(out.aleph.row(y), width);
    }
    return clamped;
}

}  // namespace

AlephImages compute_aleph(const AlephPass& pass, bool with_retinal_velocity, bool with_bands) {
    const LevelSize size = pass.bands.sizes.front();
    AlephImages out;
    out.aleph = Image<float>(size.width, size.height);
    if (with_retinal_velocity) out.retinal_velocity = Image<float>(size.width, size.height);
    if (with_bands) {
        out.responses.assign(band_count, Image<float>(size.width, size.height));
        out.elevations = out.responses;
    }
    std::vector<std::uint64_t> clamped((size.height + rows_per_band - 1) / rows_per_band);
    parallel_rows(size.height, rows_per_band,
                  [&](int begin, int end) { clamped[begin / rows_per_band] = compute_rows(pass, begin, end, out); });
    for (const std::uint64_t c : clamped) out.clamped += c;
    return out;
}

}  // namespace aleph
