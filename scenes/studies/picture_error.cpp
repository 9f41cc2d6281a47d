#include "scenes/studies/picture_error.h"

#include <algorithm>
#include <cmath>

namespace aleph {

Image<float> scaled(Image<float> image, double factor) {
    for (float& value : image.pixels) value = static_cast<float>(value * factor);
    return image;
}

PictureError measure_picture(const ChannelImage& picture, const ChannelImage& reference, const Image<float>& threshold,
                             const std::vector<double>& multiples) {
    const LuminanceError error = compute_luminance_error(picture, reference);
    const ThresholdSum sum = measure_error(error, threshold);
    PictureError out;
    out.pixels = sum.errors.count();
    out.median = sum.errors.percentile(0.5);
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

ClaimCheck check_claim(const ChannelImage& picture, const ChannelImage& reference, const Image<float>& threshold,
                       const ErrorMaps& claimed, double asked) {
    constexpr double normal_median = 0.67449, normal_99_5 = 2.807;  // standard deviations
    const LuminanceError error = compute_luminance_error(picture, reference);
    RatioHistogram ratios;
    ClaimCheck out;
    const double percent = 100.0 / static_cast<double>(std::max<std::size_t>(1, threshold.size()));
    for (std::size_t i = 0; i < threshold.size(); ++i) {
        const double size = std::abs(error.error.pixels[i]) / threshold.pixels[i];
        ratios.add(size, claimed.total.pixels[i]);
        if (size > normal_99_5 * claimed.total.pixels[i]) out.understated += percent;
        if (!(size > asked)) continue;
        std::size_t largest = 0;
        for (std::size_t cause = 1; cause < cause_count; ++cause) {
            if (claimed.by_cause[cause].pixels[i] > claimed.by_cause[largest].pixels[i]) largest = cause;
        }
        out.beyond_by_cause[largest] += percent;
    }
    out.median_ratio = ratios.percentile(0.5) / normal_median;
    return out;
}

}  // namespace aleph
