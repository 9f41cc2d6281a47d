#include "perception/threshold.h"

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "perception/fast_math.h"

namespace aleph {

namespace {

constexpr std::size_t rows_per_band = 32;
constexpr double lowest_luminance = 1e-6, highest_luminance = 1e12;  // cd/m2

// Ward-Larson, Rushmeier and Piatko 1997: where one piece ends and the next begins, log10 of cd/m2.
constexpr double rods_end = -3.94, scotopic_end = -1.44, mesopic_end = -0.0184, photopic_start = 1.9;

/// Prefix sums of luminance along every row: `reach` zeros on the left, `reach` times the total on the right, so that
/// windows need no clamping.
class LuminanceSums {
  public:
    LuminanceSums(const Image<Rgb>& estimate, double white, int reach)
        : reach_(reach),
          stride_(static_cast<std::size_t>(estimate.width + 2 * reach + 1)),
          sums_(stride_ * static_cast<std::size_t>(estimate.height)) {
        parallel_for(static_cast<std::size_t>(estimate.height), rows_per_band, [&](std::size_t begin, std::size_t end) {
            for (std::size_t y = begin; y < end; ++y) {
                double* out = sums_.data() + y * stride_ + reach + 1;
                double sum = 0.0;
                const Rgb* const row = estimate.row(static_cast<int>(y));
                for (int x = 0; x < estimate.width; ++x) *out++ = sum += white * luminance(row[x]);
                std::fill_n(out, reach, sum);
            }
        });
    }

    /// Sum over pixels [x - half, x + half] of row y is at(y, half + 1)[x] - at(y, -half)[x].
    const double* at(int y, int shift) const {
        return sums_.data() + static_cast<std::size_t>(y) * stride_ + (reach_ + shift);
    }

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

}  // namespace

double tvi(double luminance) {
    const double l = std::log10(std::fmin(std::fmax(luminance, lowest_luminance), highest_luminance));
    double t;
    if (l < rods_end) {
        t = -2.86;
    } else if (l < scotopic_end) {
        t = std::pow(0.405 * l + 1.6, 2.18) - 2.86;
    } else if (l < mesopic_end) {
        t = l - 0.395;
    } else if (l < photopic_start) {
        t = std::pow(0.249 * l + 0.65, 2.7) - 0.72;
    } else {
        t = l - 1.255;
    }
    return std::pow(10.0, t);
}

Image<float> compute_adaptation_luminance(const Image<Rgb>& estimate, const ViewingConditions& viewing) {
    if (estimate.empty()) throw InputError("", "estimate", "the image is empty");
    if (!(std::isfinite(viewing.pixels_per_degree) && viewing.pixels_per_degree > 0.0)) {
        throw InputError("", "pixels per degree", "must be positive and finite");
    }
    if (!(std::isfinite(viewing.display_white) && viewing.display_white > 0.0)) {
        throw InputError("", "display white", "must be positive and finite");
    }
    const std::vector<int> half = disc_half_widths(viewing.pixels_per_degree / 2, estimate);
    const LuminanceSums sums(estimate, viewing.display_white, half.front());
    const int reach = static_cast<int>(half.size()) - 1;
    Image<float> out(estimate.width, estimate.height);
    parallel_for(static_cast<std::size_t>(out.height), rows_per_band, [&](std::size_t begin, std::size_t end) {
        const auto width = static_cast<std::size_t>(out.width);
        std::vector<double> total(width), counts(width);
        int counted_first = 0, counted_last = 0;  // the rows (dy) that `counts` holds for
        bool counted = false;
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
            const int first = std::max(-reach, -y), last = std::min(reach, out.height - 1 - y);
            std::fill(total.begin(), total.end(), 0.0);
            for (int dy = first; dy <= last; ++dy) {
                const int h = half[static_cast<std::size_t>(std::abs(dy))];
                const double* const right = sums.at(y + dy, h + 1);
                const double* const left = sums.at(y + dy, -h);
                for (std::size_t x = 0; x < width; ++x) total[x] += right[x] - left[x];
            }
            if (!counted || first != counted_first || last != counted_last) {
                counted = true, counted_first = first, counted_last = last;
                std::fill(counts.begin(), counts.end(), 0.0);
                for (int dy = first; dy <= last; ++dy) {
                    const int h = half[static_cast<std::size_t>(std::abs(dy))];
                    for (int x = 0; x < out.width; ++x) {
                        counts[static_cast<std::size_t>(x)] += std::min(x + h, out.width - 1) - std::max(x - h, 0) + 1;
                    }
                }
            }
            float* const row = out.row(y);
            for (std::size_t x = 0; x < width; ++x) row[x] = static_cast<float>(total[x] / counts[x]);
        }
    });
    return out;
}

Image<float> compute_threshold(const Image<float>& aleph, const Image<float>& adaptation_luminance) {
    if (!same_size(aleph, adaptation_luminance)) throw InputError("", "aleph", "not of the luminance's size");
    Image<float> out(aleph.width, aleph.height);
    parallel_for(out.size(), std::size_t{1} << 14, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            out.pixels[i] = static_cast<float>(aleph.pixels[i] * tvi(adaptation_luminance.pixels[i]));
        }
    });
    return out;
}

}  // namespace aleph
