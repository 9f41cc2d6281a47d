#include "perception/threshold.h"

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "perception/check_viewing.h"
#include "perception/fast_math.h"
#include "perception/luminance_curve.h"

namespace aleph {

namespace {

constexpr int rows_per_band = 32;
constexpr double min_luminance = 1e-6, max_luminance = 1e12;  // cd/m2

// Ward-Larson, Rushmeier and Piatko 1997: where one piece ends and the next begins, log10 of cd/m2.
constexpr double rods_end = -3.94, scotopic_end = -1.44, mesopic_end = -0.0184, photopic_start = 1.9;

// The pieces of t(l), log10 of cd/m2 to log10 of cd/m2, for tvi() and fast_tvi().
constexpr double rods_level = -2.86;
constexpr double scotopic_slope = 0.405, scotopic_offset = 1.6, scotopic_power = 2.18;
constexpr double mesopic_shift = 0.395;
constexpr double rising_slope = 0.249, rising_offset = 0.65, rising_power = 2.7, rising_shift = 0.72;
constexpr double photopic_shift = 1.255;

/// base^power, base > 0.
float fast_power(float base, float power) {
    return fast_exp2(power * fast_log2(base));
}

/// tvi() in float, without branches; within 1e-5 of it.
float fast_tvi(float luminance) {
    constexpr float log10_2 = 0.30102999566398120f, log2_10 = 3.3219280948873623f;
    constexpr auto lowest = static_cast<float>(min_luminance), highest = static_cast<float>(max_luminance);
    constexpr float min_base = 1e-3f;  // the base of a piece that is not in use may be negative
    const float clamped = luminance > lowest ? (luminance < highest ? luminance : highest) : lowest;
    const float l = log10_2 * fast_log2(clamped);
    const float scotopic = static_cast<float>(scotopic_slope) * l + static_cast<float>(scotopic_offset);
    const float rising = static_cast<float>(rising_slope) * l + static_cast<float>(rising_offset);
    float t = static_cast<float>(rods_level);
    t = l < static_cast<float>(rods_end)
            ? t
            : fast_power(scotopic > min_base ? scotopic : min_base, static_cast<float>(scotopic_power)) +
                  static_cast<float>(rods_level);
    t = l < static_cast<float>(scotopic_end) ? t : l - static_cast<float>(mesopic_shift);
    t = l < static_cast<float>(mesopic_end)
            ? t
            : fast_power(rising > min_base ? rising : min_base, static_cast<float>(rising_power)) -
                  static_cast<float>(rising_shift);
    t = l < static_cast<float>(photopic_start) ? t : l - static_cast<float>(photopic_shift);
    return fast_exp2(log2_10 * t);
}

/// Prefix sums of luminance along every row: `reach` zeros on the left, `reach` times the total on the right, so that
/// windows may reach past the image.
class LuminanceSums {
  public:
    LuminanceSums(const Image<Rgb>& estimate, double white, int reach)
        : reach_(reach), stride_(estimate.width + 2 * reach + 1), sums_(stride_ * estimate.height) {
        parallel_rows(estimate.height, rows_per_band, [&](int begin, int end) {
            for (int y = begin; y < end; ++y) {
                double* out = sums_.data() + y * stride_ + reach + 1;
                double sum = 0.0;
                const Rgb* const row = estimate.row(y);
                for (int x = 0; x < estimate.width; ++x) *out++ = sum += white * luminance(row[x]);
                std::fill_n(out, reach, sum);
            }
        });
    }

    /// Sum over pixels [x - half, x + half] of row y is at(y, half + 1)[x] - at(y, -half)[x].
    const double* at(int y, int shift) const { return sums_.data() + y * stride_ + (reach_ + shift); }

  private:
    int reach_;
    std::size_t stride_;
    std::vector<double> sums_;
};

/// Half widths of the disc's rows, by |dy|.
std::vector<int> disc_half_widths(double radius, const Image<Rgb>& estimate) {
    std::vector<int> half;
    const int reach = static_cast<int>(std::min(radius, static_cast<double>(estimate.height - 1)));
    for (int dy = 0; dy <= reach; ++dy) {
        const double width = std::floor(std::sqrt(radius * radius - static_cast<double>(dy) * dy));
        half.push_back(static_cast<int>(std::min(width, static_cast<double>(estimate.width - 1))));
    }
    return half;
}

/// f(a[i], b[i]) of all pixels.
template <class Function>
Image<float> map_pixels(const Image<float>& a, const Image<float>& b, const Function& f) {
    Image<float> out(a.width, a.height);
    parallel_for(out.size(), std::size_t{1} << 14, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) out.pixels[i] = f(a.pixels[i], b.pixels[i]);
    });
    return out;
}

/// cd/m2, in the range of castle_threshold; NaN is the lowest.
float clamp_for_castle(float luminance) {
    constexpr auto lowest = static_cast<float>(castle_min_luminance), highest = static_cast<float>(max_luminance);
    const float positive = luminance > lowest ? luminance : lowest;
    return positive < highest ? positive : highest;
}

}  // namespace

double tvi(double luminance) {
    const double l = std::log10(std::fmin(std::fmax(luminance, min_luminance), max_luminance));
    double t;
    if (l < rods_end) {
        t = rods_level;
    } else if (l < scotopic_end) {
        t = std::pow(scotopic_slope * l + scotopic_offset, scotopic_power) + rods_level;
    } else if (l < mesopic_end) {
        t = l - mesopic_shift;
    } else if (l < photopic_start) {
        t = std::pow(rising_slope * l + rising_offset, rising_power) - rising_shift;
    } else {
        t = l - photopic_shift;
    }
    return std::pow(10.0, t);
}

Image<float> compute_adaptation_luminance(const Image<Rgb>& estimate, const ViewingConditions& viewing) {
    if (estimate.empty()) throw InputError("", "estimate", "the image is empty");
    check_viewing(viewing);
    const std::vector<int> half = disc_half_widths(viewing.pixels_per_degree / 2, estimate);
    const LuminanceSums sums(estimate, viewing.display_white, half.front());
    const int reach = static_cast<int>(half.size()) - 1;
    Image<float> out(estimate.width, estimate.height);
    parallel_rows(out.height, rows_per_band, [&](int begin, int end) {
        std::vector<double> total(out.width), counts(out.width);
        int counted_first = 0, counted_last = 0;  // the rows (dy) that `counts` was computed for
        bool counted = false;
        for (int y = begin; y < end; ++y) {
            const int first = std::max(-reach, -y), last = std::min(reach, out.height - 1 - y);
            std::fill(total.begin(), total.end(), 0.0);
            for (int dy = first; dy <= last; ++dy) {
                const int h = half[std::abs(dy)];
                const double* const right = sums.at(y + dy, h + 1);
                const double* const left = sums.at(y + dy, -h);
                for (int x = 0; x < out.width; ++x) total[x] += right[x] - left[x];
            }
            if (!counted || first != counted_first || last != counted_last) {
                counted = true, counted_first = first, counted_last = last;
                std::fill(counts.begin(), counts.end(), 0.0);
                for (int dy = first; dy <= last; ++dy) {
                    const int h = half[std::abs(dy)];
                    for (int x = 0; x < out.width; ++x) {
                        counts[x] += std::min(x + h, out.width - 1) - std::max(x - h, 0) + 1;
                    }
                }
            }
            float* const row = out.row(y);
            for (int x = 0; x < out.width; ++x) row[x] = static_cast<float>(total[x] / counts[x]);
        }
    });
    return out;
}

Image<float> compute_threshold(const Image<float>& aleph, const Image<float>& adaptation_luminance, Vision vision) {
    if (!same_size(aleph, adaptation_luminance)) throw InputError("", "aleph", "not of the luminance's size");
    if (vision != Vision::castle)
        return map_pixels(aleph, adaptation_luminance, [](float a, float l) { return a * fast_tvi(l); });
    const LuminanceCurve& peak = castle_peak_curve();
    return map_pixels(aleph, adaptation_luminance,
                      [&](float a, float l) { return a * (clamp_for_castle(l) / peak(l)); });
}

Image<float> compute_flicker_threshold(const Image<float>& threshold, const Image<float>& adaptation_luminance,
                                       const FrameRate& frame_rate) {
    if (!same_size(threshold, adaptation_luminance)) throw InputError("", "threshold", "not of the luminance's size");
    const LuminanceCurve sensitivity(
        [&](double luminance) { return castle_flicker_sensitivity(luminance, frame_rate); });
    return map_pixels(threshold, adaptation_luminance, [&](float t, float l) {
        const float flicker = clamp_for_castle(l) / sensitivity(l);
        return flicker < t ? flicker : t;
    });
}

}  // namespace aleph
