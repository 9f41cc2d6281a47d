#include "render/study/measure_run.h"

#include <algorithm>
#include <cmath>

#include "render/compare/compare_luminance.h"
#include "render/compare/compare_threshold.h"
#include "render/study/reference_picture.h"

namespace aleph {

namespace {

/// Errors in the thresholds of one viewer.
void measure_viewer(const LuminanceError& error, const Image<float>& threshold, const std::string& suffix,
                    MetricValues& out) {
    const ThresholdFigures figures = measure_error(error, threshold);
    out["share_beyond" + suffix] = figures.percent_beyond();
    if (figures.noise) out["share_certain" + suffix] = figures.percent(static_cast<double>(figures.noise->certain));
    double sum = 0.0;
    for (std::size_t i = 0; i < threshold.size(); ++i) sum += std::abs(error.error.pixels[i]) / threshold.pixels[i];
    out["mean_error" + suffix] = sum / static_cast<double>(threshold.size());
    out["p99_error" + suffix] = figures.percentile_99;
}

/// The indirect light of a picture as R, G and B; no channels if it has none.
ChannelImage indirect_of(const ChannelImage& picture) {
    ChannelImage out{{}, picture.metadata};
    constexpr std::array names = {"R", "G", "B"};
    for (std::size_t c = 0; c < names.size(); ++c) {
        const Image<float>* channel = picture.find(indirect_channels[c]);
        if (channel == nullptr) return {};
        out.channels.push_back({names[c], *channel});
    }
    return out;
}

}  // namespace

MetricValues measure_errors(const ChannelImage& picture, const FrameTruth& truth, const std::vector<Metric>& metrics) {
    const ChannelImage reference = with_exposure_of(truth.reference, picture);
    MetricValues all;
    const LuminanceError error = compute_luminance_error(picture, reference);
    for (const Metric& metric : metrics) {
        const std::string suffix = metric.name.substr(std::min(metric.name.find('.'), metric.name.size()));
        if (metric.viewer < 0 || all.contains("mean_error" + suffix)) continue;
        measure_viewer(error, truth.thresholds.at(static_cast<std::size_t>(metric.viewer)), suffix, all);
    }
    const LuminanceDifference difference = compare_luminance(picture, reference, {});
    all["relative_mse"] = difference.without_noise();
    all["bias"] = 100.0 * difference.bias;
    const ChannelImage indirect = indirect_of(picture), true_indirect = indirect_of(reference);
    if (!indirect.channels.empty() && !true_indirect.channels.empty())
        all["relative_mse_indirect"] = compare_luminance(indirect, true_indirect, {}).relative_mse;
    std::erase_if(all, [&](const auto& value) {
        return std::ranges::find(metrics, value.first, &Metric::name) == metrics.end();
    });
    return all;
}

ReferenceQuality measure_reference(const FrameTruth& truth) {
    const LuminanceError none = compute_luminance_error(truth.reference, truth.reference);
    const ThresholdFigures figures = measure_error(none, truth.thresholds.front());
    if (!figures.noise) return {};
    return {figures.percent(figures.noise->expected), figures.noise->percentile_99};
}

}  // namespace aleph
