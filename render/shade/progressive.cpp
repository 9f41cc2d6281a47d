#include "render/shade/progressive.h"

#include <algorithm>

#include "engine/base/parallel.h"
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
            const int count = plan.rule == Sampling::protocol ? protocol_samples(plan.aleph(x, y), plan.most)
                                                              : first_samples(plan.rule, outline, plan.most);
            ranges.push_back({x, y, 0, count});
        }
    }
    return ranges;
}

/// The pixels of a stage that need another one.
std::vector<PixelRange> next_ranges(const SamplingPlan& plan, const Image<PixelSamples>& pixels,
                                    const std::vector<PixelRange>& stage) {
    std::vector<std::uint8_t> goes_on(stage.size());
    const Image<float> around =
        plan.rule == Sampling::threshold ? deviations_around(pixels, plan.reach) : Image<float>();
    parallel_for(stage.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const PixelRange& range = stage[i];
            if (range.last >= plan.most) continue;
            MeanEstimate mean = estimate_mean(pixels, plan.outlines, range.x, range.y);
            if (!around.empty()) mean.around = static_cast<double>(around(range.x, range.y));
            goes_on[i] = !is_enough(plan.rule, plan.test, mean, plan.tolerance(range.x, range.y));
        }
    });
    std::vector<PixelRange> next;
    for (std::size_t i = 0; i < stage.size(); ++i) {
        const PixelRange& range = stage[i];
        if (goes_on[i]) next.push_back({range.x, range.y, range.last, std::min(2 * range.last, plan.most)});
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

}  // namespace

double sum_samples(std::span<const PixelRange> ranges) {
    double count = 0.0;
    for (const PixelRange& range : ranges) count += range.last - range.first;
    return count;
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

void sample_by_stages(const SamplingPlan& plan, const Image<PixelSamples>& pixels, const TakeSamples& take,
                      std::vector<PixelRange> begin) {
    std::vector<PixelRange> stage = begin.empty() ? first_ranges(plan, pixels) : std::move(begin);
    while (!stage.empty()) {
        take(stage);
        if (plan.tolerance.empty()) return;
        stage = next_ranges(plan, pixels, stage);
    }
}

}  // namespace aleph
