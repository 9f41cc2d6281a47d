#include "render/progressive.h"

#include <algorithm>

#include "engine/base/parallel.h"
#include "render/shutter.h"

namespace aleph {

namespace {

std::vector<PixelRange> first_ranges(const SamplingPlan& plan, const Image<PixelSamples>& pixels) {
    std::vector<PixelRange> ranges;
    ranges.reserve(pixels.size());
    for (int y = 0; y < pixels.height; ++y) {
        for (int x = 0; x < pixels.width; ++x) {
            const Outline outline = plan.outlines.empty() ? Outline::none : plan.outlines(x, y);
            const int count = plan.rule == Sampling::protocol ? protocol_samples(plan.aleph(x, y), plan.most)
                                                              : first_samples(plan.rule, outline, plan.most);
            ranges.push_back({x, y, 0, count});
        }
    }
    return ranges;
}

/// The pixels that do not have enough samples. Also of those that had before: their neighbours know more now.
std::vector<PixelRange> next_ranges(const SamplingPlan& plan, const Image<PixelSamples>& pixels) {
    std::vector<std::uint8_t> goes_on(pixels.size());
    parallel_rows(pixels.height, 8, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < pixels.width; ++x) {
                if (pixels(x, y).taken() >= plan.most) continue;
                goes_on[pixels.index(x, y)] =
                    !is_enough(plan.rule, plan.test, estimate_mean(pixels, plan.outlines, x, y), plan.tolerance(x, y));
            }
        }
    });
    std::vector<PixelRange> next;
    for (int y = 0; y < pixels.height; ++y) {
        for (int x = 0; x < pixels.width; ++x) {
            if (!goes_on[pixels.index(x, y)]) continue;
            const int taken = pixels(x, y).taken();
            next.push_back({x, y, taken, std::min(2 * taken, plan.most)});
        }
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

void sample_by_stages(const SamplingPlan& plan, const Image<PixelSamples>& pixels, const TakeSamples& take) {
    std::vector<PixelRange> stage = first_ranges(plan, pixels);
    while (true) {
        take(stage);
        if (plan.tolerance.empty()) return;
        stage = next_ranges(plan, pixels);
        if (stage.empty()) return;
    }
}

}  // namespace aleph
