#include "scenes/studies/picture_error.h"

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

}  // namespace aleph
