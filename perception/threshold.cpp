#include "perception/threshold.h"

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "perception/vision/luminance_curve.h"

namespace aleph {

namespace {

constexpr std::size_t pixels_per_part = std::size_t{1} << 14;

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

}  // namespace

void check_viewing(const ViewingConditions& viewing) {
    const auto check = [](double value, const char* name) {
        if (!(std::isfinite(value) && value > 0.0)) throw InputError("", name, "must be positive and finite");
    };
    check(viewing.pixels_per_degree, "pixels per degree");
    check(viewing.display_white, "display white");
    if (!(viewing.persistence >= 0.0 && viewing.persistence <= 1.0)) {
        throw InputError("", "persistence", "must be from 0 to 1");
    }
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

Image<float> compute_threshold(const Image<float>& aleph, const Image<float>& adaptation_luminance,
                               const VisionModel& vision) {
    if (!same_size(aleph, adaptation_luminance)) throw InputError("", "aleph", "not of the luminance's size");
    Image<float> out(aleph.width, aleph.height);
    parallel_for(out.size(), pixels_per_part, [&](std::size_t begin, std::size_t end) {
        vision.thresholds(adaptation_luminance.pixels.data() + begin, end - begin, out.pixels.data() + begin);
        for (std::size_t i = begin; i < end; ++i) out.pixels[i] *= aleph.pixels[i];
    });
    return out;
}

}  // namespace aleph
