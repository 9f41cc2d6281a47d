#include "render/compare/compare_threshold.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/errors.h"

namespace aleph {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Bin 0: below 1e-6. Bins 1 to `steps`: 1 % wide each. The last bin: 1e6 and more, and what is not finite.
constexpr double smallest = 1e-6, largest = 1e6, bin_ratio = 1.01;
const double log_ratio = std::log(bin_ratio);
const std::size_t steps = static_cast<std::size_t>(std::ceil(std::log(largest / smallest) / log_ratio));

std::size_t bin_of(double ratio) {
    if (ratio < smallest) return 0;
    if (!(ratio < largest)) return steps + 1;
    const double step = std::floor(std::log(ratio / smallest) / log_ratio);
    return 1 + std::min(steps - 1, static_cast<std::size_t>(std::max(0.0, step)));
}

bool usable(double error, double threshold) {
    return std::isfinite(error) && std::isfinite(threshold) && threshold >= 0.0;
}

}  // namespace

void RatioHistogram::add(double difference, double threshold) {
    if (bins_.empty()) bins_.assign(steps + 2, 0);
    ++count_;
    if (!usable(difference, threshold)) {
        ++beyond_;
        ++bins_.back();
        if (difference > 0.0 && threshold >= 0.0) worst_ = std::max(worst_, difference / threshold);
        return;
    }
    beyond_ += difference > threshold;
    const double ratio = difference > 0.0 ? difference / threshold : 0.0;
    worst_ = std::max(worst_, ratio);
    ++bins_[bin_of(ratio)];
}

double RatioHistogram::percentile(double share) const {
    if (count_ == 0) return 0.0;
    const double wanted = std::max(1.0, std::ceil(share * static_cast<double>(count_)));
    std::uint64_t seen = bins_[0];
    if (static_cast<double>(seen) >= wanted) return 0.0;
    for (std::size_t bin = 1; bin <= steps; ++bin) {
        seen += bins_[bin];
        if (static_cast<double>(seen) < wanted) continue;
        return std::min(worst_, smallest * std::pow(bin_ratio, static_cast<double>(bin) - 0.5));
    }
    return infinity;
}

void ThresholdSum::add(const LuminanceError& error, const Image<float>& threshold) {
    if (!same_size(threshold, error.error)) {
        throw InputError("", "threshold map",
                         fmt::format("is {}x{}, the pictures are {}x{}", threshold.width, threshold.height,
                                     error.error.width, error.error.height));
    }
    for (std::size_t i = 0; i < threshold.size(); ++i) {
        const double size = std::abs(error.error.pixels[i]), limit = threshold.pixels[i];
        errors.add(size, limit);
        if (error.variance.empty()) continue;
        const double variance = error.variance.pixels[i];
        const double deviation = variance >= 0.0 && std::isfinite(variance) ? std::sqrt(variance) : infinity;
        noise.add(deviation, limit);
        const bool known = usable(size, limit);
        certain += !known || size > limit + 3.0 * deviation;
        if (known && deviation > 0.0) expected += std::erfc(limit / (std::numbers::sqrt2 * deviation));
    }
}

ThresholdFigures summarize(const ThresholdSum& sum) {
    ThresholdFigures figures{sum.errors.count(), sum.errors.beyond(), sum.errors.percentile(0.99), sum.errors.worst(),
                             std::nullopt};
    if (sum.noise.count() > 0) {
        figures.noise = ReferenceNoise{sum.noise.percentile(0.5), sum.noise.percentile(0.99), sum.noise.beyond(),
                                       sum.expected, sum.certain};
    }
    return figures;
}

ThresholdFigures measure_error(const LuminanceError& error, const Image<float>& threshold) {
    ThresholdSum sum;
    sum.add(error, threshold);
    return summarize(sum);
}

}  // namespace aleph
