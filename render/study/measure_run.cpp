#include "render/study/measure_run.h"

#include <algorithm>
#include <cmath>

#include "render/compare/compare_luminance.h"
#include "render/compare/compare_sequence.h"
#include "render/study/reference_picture.h"

namespace aleph {

namespace {

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
    for (const char* name : {"R", "G", "B"}) {
        const Image<float>* channel = picture.find(std::string(indirect_layer) + name);
        if (channel == nullptr) return {};
        out.channels.push_back({name, *channel});
    }
    return out;
}

}  // namespace

MetricValues measure_errors(const ChannelImage& picture, const ChannelImage& truth,
                            const std::vector<Image<float>>& thresholds, const std::vector<Metric>& metrics) {
    const ChannelImage reference = with_exposure_of(truth, picture);
    MetricValues all;
    const LuminanceError error = compute_luminance_error(picture, reference);
    for (const Metric& metric : metrics) {
        const std::string suffix = metric.name.substr(std::min(metric.name.find('.'), metric.name.size()));
        if (metric.viewer < 0 || all.contains("mean_error" + suffix)) continue;
        measure_viewer(error, thresholds.at(static_cast<std::size_t>(metric.viewer)), suffix, all);
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

ReferenceQuality measure_reference(const ChannelImage& reference, const Image<float>& threshold) {
    const ThresholdFigures figures = measure_error(compute_luminance_error(reference, reference), threshold);
    if (!figures.noise) return {};
    return {figures.percent(figures.noise->expected), figures.noise->percentile_99};
}

double find_ideal_samples(const Image<float>& seen, const Image<float>& samples) {
    std::vector<double> needed;
    needed.reserve(seen.size());
    for (std::size_t i = 0; i < seen.size(); ++i)
        needed.push_back(std::max(1.0, samples.pixels[i] * std::pow(static_cast<double>(seen.pixels[i]), 2.0)));
    const auto kept = needed.begin() + static_cast<std::ptrdiff_t>((99 * needed.size() + 99) / 100);
    if (kept != needed.end()) std::ranges::nth_element(needed, kept);
    needed.erase(kept, needed.end());
    return mean_of(needed).value;
}

std::vector<MetricValues> measure_visible(std::span<const JudgingFrame> frames, const FramePictures& pictures) {
    std::vector<MetricValues> errors;
    std::vector<Image<float>> samples;  // of frames that are not finished
    std::optional<VisibleDifference> difference;
    const auto take = [&](const std::vector<VisibleMaps>& finished) {
        for (const VisibleMaps& maps : finished) {
            VisibleCount count;
            count.add(maps, frames[errors.size()].maps.find("saliency.Y"));
            Image<float>& taken = samples[errors.size()];
            const VisibleShares shares = count.shares();
            MetricValues& out = errors.emplace_back(MetricValues{
                {"share_seen", shares.seen}, {"share_flicker", shares.flicker}, {"share_lasting", shares.lasting}});
            if (shares.noticed) out["share_noticed"] = *shares.noticed;
            if (same_size(taken, maps.seen)) out["ideal_samples"] = find_ideal_samples(maps.seen, taken);
            taken = {};
        }
    };
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (i == 0 || frames[i].scene != frames[i - 1].scene) {
            if (difference) take(difference->finish());
            difference.emplace(read_viewing(frames[i].maps));
        }
        const auto [picture, other] = pictures(i);
        const ChannelImage reference = with_exposure_of(other, picture);
        const Image<float>* const taken = picture.find("samples.Y");
        samples.push_back(taken == nullptr ? Image<float>() : *taken);
        take(difference->add(frames[i].frame, read_pair(picture, reference), read_motion(frames[i].maps)));
    }
    if (difference) take(difference->finish());
    return errors;
}

void add_seed_metrics(const std::vector<JudgingFrame>& frames, const std::vector<std::string>& other,
                      std::vector<FrameResult>& results) {
    const std::vector<MetricValues> errors = measure_visible(
        frames, [&](std::size_t i) { return std::pair(read_image(results.at(i).picture), read_image(other.at(i))); });
    for (std::size_t i = 0; i < errors.size(); ++i) {
        results.at(i).metrics["seed_seen"] = {errors[i].at("share_seen"), std::nullopt};
        results.at(i).metrics["seed_flicker"] = {errors[i].at("share_flicker"), std::nullopt};
    }
}

}  // namespace aleph
