#pragma once
// The error of a picture against a noisy reference, in thresholds of a viewer, at several multiples of the threshold.

#include <array>
#include <vector>

#include "render/compare/compare_threshold.h"
#include "render/guide/error_report.h"

namespace aleph {

/// Pixels beyond so many thresholds, percent of all.
struct BeyondShare {
    double thresholds = 1.0;
    double percent = 0.0;   ///< with the noise of the reference, which adds to it
    double certain = 0.0;   ///< beyond by more than 3 standard errors of the reference
    double by_noise = 0.0;  ///< expected of a perfect picture, by the noise of the reference alone
};

struct PictureError {
    std::size_t pixels = 0;
    std::vector<BeyondShare> beyond;            ///< for each multiple asked
    double percentile_99_5 = 0.0, worst = 0.0;  ///< of |error| over the threshold
    double median = 0.0;  ///< the same, of the pixels that are not alike in all passes of the reference: no background
    double noise_median = 0.0, noise_percentile_99 = 0.0;  ///< of the reference's standard error over the threshold
    double noisy_percent = 0.0;                            ///< pixels whose standard error is above a tenth of it
    double bias = 0.0, bias_error = 0.0;  ///< of the picture's mean luminance, relative; the reference's standard error
};

/// Errors of luminance.
/// @param reference   with `variance.Y`
/// @param threshold   cd/m2
/// @param multiples   of the threshold
/// @throws InputError if sizes differ
PictureError measure_picture(const ChannelImage& picture, const ChannelImage& reference, const Image<float>& threshold,
                             const std::vector<double>& multiples);

/// What a program says of the error of its picture.
struct PictureClaim {
    ErrorMaps errors;      ///< in thresholds
    Image<float> samples;  ///< that each pixel took
};

/// That, held against the error itself.
struct ClaimCheck {
    double median_ratio =
        0.0;  ///< median of |error| over the median of a normal distribution with the claimed deviation
    double understated = 0.0;  ///< percent of the pixels beyond what 99.5 % should be within: .5 is expected
    double dearest = 0.0;      ///< percent of all samples that the 1 % of the pixels with most samples take
    /// By the largest claimed cause of a pixel: percent of the pixels that are beyond the asked error, percent of all
    /// samples.
    std::array<double, cause_count> beyond_by_cause{}, samples_by_cause{};
};

/// @param asked  thresholds
/// @throws InputError if sizes differ
ClaimCheck check_claim(const ChannelImage& picture, const ChannelImage& reference, const Image<float>& threshold,
                       const PictureClaim& claim, double asked);

/// Every value times a factor.
Image<float> scaled(Image<float> image, double factor);

}  // namespace aleph
