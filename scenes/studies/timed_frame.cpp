#include "scenes/studies/timed_frame.h"

#include <algorithm>
#include <numeric>
#include <string_view>

#include "render/frame/sequence.h"
#include "render/output/frame_files.h"
#include "render/settings/measure.h"
#include "scenes/studies/study_frame.h"

namespace aleph {

namespace {

FrameCost find_cost(const FrameOutput& output, double processor, double clock) {
    const FrameStatistics& statistics = output.statistics;
    FrameCost cost;
    cost.frame_seconds = statistics.seconds.total;
    cost.clock_seconds = clock;
    cost.rays = static_cast<double>(statistics.counts.rays.total());
    for (const MomentStatistics& moment : statistics.moments) {
        cost.moment_seconds += moment.seconds;
        cost.rays += static_cast<double>(moment.counts.rays.total());
    }
    const double scale = processor / std::max(cost.seconds(), 1e-9);
    cost.frame_seconds *= scale;
    cost.moment_seconds *= scale;
    for (const auto& [stage, seconds] : list_stages(statistics.seconds)) {
        if (stage != std::string_view("total")) cost.stages.emplace_back(stage, scale * seconds);
    }
    const std::vector<float>& samples = output.shaded.samples.pixels;
    cost.mean_samples = std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
    cost.most_samples = *std::ranges::max_element(samples);
    return cost;
}

TimedFrame render_once(Sequence& sequence, const RenderSettings& settings, std::int64_t frame) {
    const double start = processor_seconds();
    StageClock clock;
    const FrameOutput output = sequence.render(frame);
    double seconds = 0.0;
    clock.add_to(seconds);
    const FrameCost cost = find_cost(output, processor_seconds() - start, seconds);
    return {make_frame_image(output, false, sequence.scene(), settings, sequence.exposure()),
            {output.shaded.errors, output.shaded.samples},
            cost,
            format_statistics({output.statistics}, sequence.scene(), settings, sequence.exposure())};
}

}  // namespace

TimedFrame render_timed(const Scene& scene, const RenderSettings& settings, std::int64_t frame, int repeats) {
    std::vector<TimedFrame> frames;
    for (int i = 0; i < std::max(1, repeats); ++i) {
        Sequence sequence(scene, settings);
        frames.push_back(render_once(sequence, settings, frame));
    }
    std::ranges::sort(frames, {}, [](const TimedFrame& timed) { return timed.cost.seconds(); });
    return std::move(frames[frames.size() / 2]);
}

}  // namespace aleph
