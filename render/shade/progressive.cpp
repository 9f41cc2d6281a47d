#include "render/shade/progressive.h"

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/base/pixel_loops.h"
#include "render/time/shutter.h"

namespace aleph {

namespace {

std::vector<PixelRange> first_ranges(const SamplingPlan& plan, const Image<PixelSamples>& pixels) {
    std::vector<PixelRange> ranges;
    ranges.reserve(pixels.size());
    for (int y = 0; y < pixels.height; ++y) {
        for (int x = 0; x < pixels.width; ++x) {
            if (plan.part != nullptr && (*plan.part)(x, y) == 0) continue;
            const Outline outline = plan.outlines.empty() ? Outline::none : plan.outlines(x, y);
            int count = plan.rule == Sampling::protocol ? protocol_samples(plan.aleph(x, y), plan.most)
                                                        : first_samples(plan.rule, outline, plan.most);
            if (!plan.least.empty()) count = std::max(count, plan.least(x, y));
            ranges.push_back({x, y, 0, count});
        }
    }
    return ranges;
}

MeanEstimate tell_mean(const SamplingPlan& plan, const Image<PixelSamples>& pixels, int x, int y) {
    const bool own = plan.stopping == Stopping::pixel && plan.rule != Sampling::threshold;
    return own ? estimate_own_mean(pixels(x, y)) : estimate_mean(pixels, plan.outlines, x, y);
}

enum class Decision : std::uint8_t {
    stop,
    go_on,
    go_on_by_itself,  ///< its own samples decide, and bias its mean
};

Decision decide(const SamplingPlan& plan, const PixelSamples& pixel, const MeanEstimate& mean, double tolerance) {
    if (!pixel.has_kept_mean() && !is_enough(plan.rule, plan.stopping, mean, tolerance)) return Decision::go_on;
    const bool alone = plan.rule == Sampling::threshold && stands_out(pixel, tolerance);
    return alone ? Decision::go_on_by_itself : Decision::stop;
}

/// Asks the plan's rule about the pixels of a stage.
std::vector<Decision> ask_rule(const SamplingPlan& plan, const Image<PixelSamples>& pixels,
                               const std::vector<PixelRange>& stage) {
    std::vector<Decision> decisions(stage.size(), Decision::stop);
    const Image<float> around =
        plan.rule == Sampling::threshold ? deviations_around(pixels, plan.reach) : Image<float>();
    parallel_each(stage.size(), 4096, [&](std::size_t i) {
        const PixelRange& range = stage[i];
        if (range.last >= plan.most) return;
        MeanEstimate mean = tell_mean(plan, pixels, range.x, range.y);
        const PixelSamples& pixel = pixels(range.x, range.y);
        if (range.last >= white_samples && is_shown_white(pixel, plan.white, mean.variance)) return;
        if (!around.empty()) mean.around = static_cast<double>(around(range.x, range.y));
        decisions[i] = decide(plan, pixel, mean, plan.tolerance(range.x, range.y));
    });
    return decisions;
}

/// The same of a rule of a program's own.
std::vector<Decision> ask_own_rule(const SamplingPlan& plan, const Image<PixelSamples>& pixels,
                                   const std::vector<PixelRange>& stage) {
    StagePixels asked;
    for (const PixelRange& range : stage) {
        const MeanEstimate mean = tell_mean(plan, pixels, range.x, range.y);
        asked.x.push_back(range.x);
        asked.y.push_back(range.y);
        asked.samples.push_back(range.last);
        asked.error.push_back(static_cast<float>(std::sqrt(mean.error2)));
        asked.deviation.push_back(static_cast<float>(std::sqrt(mean.variance)));
        asked.tolerance.push_back(plan.tolerance(range.x, range.y));
    }
    const std::vector<std::uint8_t> enough = plan.own->find_enough(asked);
    if (enough.size() != stage.size())
        throw InputError("", "stopping rule", "it has to decide for each pixel that it is asked about");
    std::vector<Decision> decisions(stage.size(), Decision::stop);
    for (std::size_t i = 0; i < stage.size(); ++i) {
        if (enough[i] == 0 && stage[i].last < plan.most) decisions[i] = Decision::go_on;
    }
    return decisions;
}

/// The pixels of a stage that need another one.
std::vector<PixelRange> next_ranges(const SamplingPlan& plan, Image<PixelSamples>& pixels,
                                    const std::vector<PixelRange>& stage) {
    const std::vector<Decision> decisions =
        plan.own != nullptr ? ask_own_rule(plan, pixels, stage) : ask_rule(plan, pixels, stage);
    std::vector<PixelRange> next;
    for (std::size_t i = 0; i < stage.size(); ++i) {
        const PixelRange& range = stage[i];
        if (decisions[i] == Decision::stop) continue;
        if (decisions[i] == Decision::go_on_by_itself) pixels(range.x, range.y).keep_mean();
        next.push_back({range.x, range.y, range.last, std::min(2 * range.last, plan.most)});
    }
    return next;
}

/// Sample `index` of those pixels of a class that take it.
std::vector<PixelRange> select_sample(std::span<const PixelRange> ranges, int index, int pixel_class) {
    std::vector<PixelRange> taken;
    for (const auto& [x, y, first, last] : ranges) {
        if (first <= index && index < last && time_class(x, y) == pixel_class)
            taken.push_back({x, y, index, index + 1});
    }
    return taken;
}

float strictest_around(const Image<float>& threshold, int x, int y) {
    float least = threshold(x, y);
    visit_around(threshold, x, y, 1, [&](int nx, int ny) { least = std::min(least, threshold(nx, ny)); });
    return least;
}

}  // namespace

double sum_samples(std::span<const PixelRange> ranges) {
    double count = 0.0;
    for (const PixelRange& range : ranges) count += range.last - range.first;
    return count;
}

std::size_t find_task_ranges(std::span<const PixelRange> ranges) {
    constexpr std::size_t most = 64;
    constexpr double task_samples = 4096.0;
    const double mean = sum_samples(ranges) / static_cast<double>(ranges.size());
    return std::clamp<std::size_t>(static_cast<std::size_t>(task_samples / mean), 1, most);
}

double predict_samples(std::span<const PixelRange> stage, std::size_t before, int most) {
    constexpr double typical_share = 0.4;
    const double seen_share = before == 0 ? 0.0 : static_cast<double>(stage.size()) / static_cast<double>(before);
    const double share = std::max(seen_share, typical_share);
    double pixels = static_cast<double>(stage.size()), count = 0.0;
    for (int last = stage.front().last; last < most; last = std::min(2 * last, most)) {
        pixels *= share;
        count += pixels * (std::min(2 * last, most) - last);
    }
    return count;
}

void take_in_turn(std::span<const PixelRange> ranges, const TakeSample& take) {
    int first = ranges.front().first, last = 0;
    for (const PixelRange& range : ranges) {
        first = std::min(first, range.first);
        last = std::max(last, range.last);
    }
    for (int i = first; i < last; ++i) {
        for (int c = 0; c < time_classes; ++c) {
            const std::vector<PixelRange> now = select_sample(ranges, i, c);
            if (!now.empty()) take(i, c, now);
        }
    }
}

void sample_by_stages(const SamplingPlan& plan, Image<PixelSamples>& pixels, const TakeSamples& take,
                      std::vector<PixelRange> begin) {
    std::vector<PixelRange> stage = begin.empty() ? first_ranges(plan, pixels) : std::move(begin);
    while (!stage.empty()) {
        take(stage);
        if (plan.tolerance.empty()) return;
        stage = next_ranges(plan, pixels, stage);
    }
}

Image<float> compute_sampling_tolerance(const VisibleLimits& limits, const RenderSettings& settings, double exposure) {
    if (settings.sampling.rule == Sampling::uniform || settings.sampling.rule == Sampling::protocol) return {};
    const bool by_noise = settings.sampling.rule == Sampling::threshold;
    const Image<float>& limit = by_noise ? limits.noise : limits.threshold;
    const double asked = settings.error > 0.0 ? settings.error : 1.0;
    const double factor = (by_noise ? allow_noise(asked) : asked) / (limits.viewing.display_white * exposure);
    Image<float> tolerance(limits.threshold.width, limits.threshold.height);
    for (int y = 0; y < tolerance.height; ++y) {
        for (int x = 0; x < tolerance.width; ++x) {
            const Outline outline = limits.outlines(x, y);
            const bool moves = outline == Outline::moving || outline == Outline::small;
            const float threshold = moves ? strictest_around(limit, x, y) : limit(x, y);
            tolerance(x, y) = static_cast<float>(factor * threshold);
        }
    }
    return tolerance;
}

/// Pixels of a class have the same times (shutter.h), so their neighbours do not tell what these miss: a step of the
/// luminance may lie anywhere between two of n times, which makes an error of up to its height / n.
Image<int> find_least_samples(const VisibleLimits& limits, const RenderSettings& settings) {
    Image<int> least(limits.swing.width, limits.swing.height);
    const double error = settings.error > 0.0 ? settings.error : 1.0, white = limits.viewing.display_white;
    for (std::size_t i = 0; i < least.size(); ++i) {
        const double needed = limits.swing.pixels[i] * white / (error * limits.threshold.pixels[i]);
        int count = 1;
        while (count < needed && count < settings.sampling.spp) count *= 2;
        least.pixels[i] = std::min(count, settings.sampling.spp);
    }
    return least;
}

SamplingPlan make_sampling_plan(const VisibleLimits* limits, const RenderSettings& settings, double exposure) {
    SamplingPlan plan;
    plan.rule = settings.sampling.rule;
    plan.stopping = settings.sampling.stopping;
    plan.own = settings.sampling.own_rule;
    plan.most = settings.sampling.spp;
    if (limits == nullptr) return plan;
    plan.tolerance = compute_sampling_tolerance(*limits, settings, exposure);
    plan.aleph = limits->aleph;
    plan.outlines = limits->outlines;
    plan.reach = find_seen_reach(limits->viewing.pixels_per_degree);
    if (plan.rule == Sampling::threshold) plan.white = 1.0 / exposure;
    if (plan.rule == Sampling::threshold && !limits->swing.empty()) plan.least = find_least_samples(*limits, settings);
    return plan;
}

}  // namespace aleph
