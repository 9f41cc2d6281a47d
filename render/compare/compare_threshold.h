#pragma once
// Luminance errors in units of what a viewer tolerates: counts and percentiles over any number of pixels and frames, in
// constant memory.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/image.h"
#include "render/compare/compare_luminance.h"

namespace aleph {

/// Ratios of differences to their thresholds.
class RatioHistogram {
  public:
    /// @param difference  not negative
    /// @param threshold   in the same unit
    void add(double difference, double threshold);

    std::size_t count() const { return count_; }
    /// Differences above their threshold. One that is not finite counts, as does one whose threshold is not finite or
    /// negative.
    std::size_t beyond() const { return beyond_; }
    /// The largest difference over its threshold; infinite if that threshold is 0.
    double worst() const { return worst_; }
    /// The ratio that `share` (0 to 1) of the differences do not exceed, within 0.5 %. Below 1e-6 it is 0; it is
    /// infinite above 1e6 and where it falls on values that are not finite. 0 if there are none.
    double percentile(double share) const;

  private:
    std::vector<std::uint64_t> bins_;
    std::size_t count_ = 0, beyond_ = 0;
    double worst_ = 0.0;
};

/// Errors with the noise of the reference that they are measured against.
struct ThresholdSum {
    RatioHistogram errors;
    RatioHistogram noise;  ///< standard errors of the reference over the threshold; empty without its variance
    double expected = 0.0;
    std::size_t certain = 0;

    /// Adds the pixels of a picture. Where the variance is negative or not finite, nothing is certain of a pixel.
    /// @param threshold  cd/m2
    /// @throws InputError (place "threshold map") if it has another size
    void add(const LuminanceError& error, const Image<float>& threshold);
};

/// The noise of a reference, and what it makes of the share beyond the threshold. The noise is taken as normally
/// distributed: a mean of many samples is.
struct ReferenceNoise {
    double median = 0.0;         ///< of the standard error of its luminance, in thresholds
    double percentile_99 = 0.0;  ///< the same
    std::size_t beyond = 0;      ///< pixels whose standard error is above the threshold
    /// Pixels that are beyond the threshold on average if the pictures differ by this noise alone: the sum of
    /// erfc(threshold / (sqrt(2) standard error)).
    double expected = 0.0;
    /// Pixels that are beyond the threshold by more than 3 standard errors.
    std::size_t certain = 0;
};

/// 0 of no pixels.
inline double percent_of(double count, std::size_t pixels) {
    return pixels == 0 ? 0.0 : 100.0 * count / static_cast<double>(pixels);
}

/// Errors in units of the threshold.
struct ThresholdFigures {
    std::size_t pixels = 0;
    std::size_t beyond = 0;  ///< pixels with an error above the threshold, or without a finite error or threshold
    double percentile_99 = 0.0;
    double worst = 0.0;
    std::optional<ReferenceNoise> noise;  ///< if the reference has `variance.Y`

    double percent(double count) const { return percent_of(count, pixels); }
    double percent_beyond() const { return percent(static_cast<double>(beyond)); }
};

ThresholdFigures summarize(const ThresholdSum& sum);

/// The figures of one picture. @throws InputError as ThresholdSum::add
ThresholdFigures measure_error(const LuminanceError& error, const Image<float>& threshold);

}  // namespace aleph
