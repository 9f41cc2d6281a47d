#include "render/study/picture_error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace aleph {

Image<float> scaled(Image<float> image, double factor) {
    for (float& value : image.pixels) value = static_cast<float>(value * factor);
    return image;
}

namespace {

/// A background is exactly known, and often more than half of a picture.
double median_of_shaded(const LuminanceError& error, const Image<float>& threshold) {
    RatioHistogram ratios;
    for (std::size_t i = 0; i < threshold.size(); ++i) {
        if (error.variance.empty() || error.variance.pixels[i] > 0.0)
            ratios.add(std::abs(error.error.pixels[i]), threshold.pixels[i]);
    }
    return ratios.percentile(0.5);
}

}  // namespace

PictureError measure_picture(const ChannelImage& picture, const ChannelImage& reference, const Image<float>& threshold,
                             const std::vector<double>& multiples) {
    const LuminanceError error = compute_luminance_error(picture, reference);
    const ThresholdSum sum = measure_error(error, threshold);
    PictureError out;
    out.pixels = sum.errors.count();
    out.median = median_of_shaded(error, threshold);
    out.percentile_99_5 = sum.errors.percentile(0.995);
    out.worst = sum.errors.worst();
    out.noise_median = sum.noise.percentile(0.5);
    out.noise_percentile_99 = sum.noise.percentile(0.99);
    for (const double multiple : multiples) {
        const ThresholdFigures figures = summarize(measure_error(error, scaled(threshold, multiple)));
        const ReferenceNoise noise = figures.noise.value_or(ReferenceNoise{});
        out.beyond.push_back({multiple, figures.percent_beyond(), figures.percent(static_cast<double>(noise.certain)),
                              figures.percent(noise.expected)});
    }
    const ThresholdFigures tenth = summarize(measure_error(error, scaled(threshold, 0.1)));
    out.noisy_percent = tenth.noise ? tenth.percent(static_cast<double>(tenth.noise->beyond)) : 0.0;
    const LuminanceDifference difference = compare_luminance(picture, reference, {});
    out.bias = difference.bias;
    out.bias_error = difference.bias_error;
    return out;
}

namespace {

std::size_t largest_cause(const ErrorMaps& errors, std::size_t pixel) {
    std::size_t largest = 0;
    for (std::size_t cause = 1; cause < cause_count; ++cause) {
        if (errors.by_cause[cause].pixels[pixel] > errors.by_cause[largest].pixels[pixel]) largest = cause;
    }
    return largest;
}

/// Percent of the samples that the 1 % of the pixels with most of them take.
double percent_of_dearest(std::vector<float> samples) {
    std::ranges::sort(samples, std::greater());
    const auto few = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 100);
    const double all = std::accumulate(samples.begin(), samples.end(), 0.0);
    return 100.0 * std::accumulate(samples.begin(), few, 0.0) / std::max(all, 1.0);
}

}  // namespace

ClaimCheck check_claim(const ChannelImage& picture, const ChannelImage& reference, const Image<float>& threshold,
                       const PictureClaim& claim, double asked) {
    constexpr double normal_median = 0.67449, normal_99_5 = 2.807;  // standard deviations
    const LuminanceError error = compute_luminance_error(picture, reference);
    const std::vector<float>& samples = claim.samples.pixels;
    const double per_sample = 100.0 / std::max(1.0, std::accumulate(samples.begin(), samples.end(), 0.0));
    const double per_pixel = 100.0 / static_cast<double>(std::max<std::size_t>(1, threshold.size()));
    RatioHistogram ratios;
    ClaimCheck out;
    for (std::size_t i = 0; i < threshold.size(); ++i) {
        const double size = std::abs(error.error.pixels[i]) / threshold.pixels[i];
        const float claimed = claim.errors.total.pixels[i];
        const std::size_t cause = largest_cause(claim.errors, i);
        ratios.add(size, claimed);
        out.samples_by_cause[cause] += per_sample * samples[i];
        if (size > normal_99_5 * claimed) out.understated += per_pixel;
        if (size > asked) out.beyond_by_cause[cause] += per_pixel;
    }
    out.median_ratio = ratios.percentile(0.5) / normal_median;
    out.dearest = percent_of_dearest(samples);
    return out;
}

}  // namespace aleph
