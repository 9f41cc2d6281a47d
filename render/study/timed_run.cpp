#include "render/study/timed_run.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "render/frame/sequence.h"
#include "render/output/frame_files.h"
#include "render/plan/effect_table.h"
#include "render/settings/measure.h"
#include "render/study/processor_time.h"
#include "render/study/reference_picture.h"

namespace aleph {

namespace {

std::vector<std::pair<std::string, double>> list_rays(const RayCounts& rays) {
    const auto number = [](std::uint64_t count) { return static_cast<double>(count); };
    return {{"primary", number(rays.primary)},
            {"shadow", number(rays.shadow)},
            {"gather", number(rays.gather)},
            {"glossy", number(rays.glossy)},
            {"specular", number(rays.specular)},
            {"path", number(rays.path)},
            {"multi_bounce", number(rays.multi_bounce)}};
}

/// @param copied  the picture was there: the statistics are those of the frame that it is a copy of
FrameRun describe_frame(const FrameStatistics& statistics, bool copied) {
    FrameRun run;
    run.frame = statistics.frame;
    run.plan = to_json(statistics.plan).dump();
    RayCounts rays = copied ? RayCounts() : statistics.counts.rays;
    double keyframes = 0.0;
    if (!copied) run.records = static_cast<double>(statistics.counts.records);
    for (const auto& [stage, seconds] : list_stages(statistics.seconds)) {
        if (stage != std::string_view("total") && stage != std::string_view("write"))
            run.stages.emplace_back(stage, copied ? 0.0 : seconds);
    }
    for (const KeyframeStatistics& keyframe : statistics.keyframes) {
        rays += keyframe.counts.rays;
        run.records += static_cast<double>(keyframe.counts.records);
        keyframes += keyframe.seconds;
    }
    run.stages.emplace_back("keyframes", keyframes);
    run.rays = list_rays(rays);
    return run;
}

}  // namespace

std::vector<FrameRun> render_run(const Scene& scene, const RenderSettings& settings, const std::vector<int>& frames,
                                 const SaveFrame& save, const std::function<void(double)>& progress) {
    std::vector<FrameRun> runs;
    std::optional<std::int64_t> rendered;  // last; first of its static span
    Sequence sequence(scene, settings);
    const double pixels = static_cast<double>(settings.picture.width) * settings.picture.height;
    for (const int frame : frames) {
        FrameRequest request;
        request.progress = [&](double fraction, const char*) {
            if (progress) progress((static_cast<double>(runs.size()) + fraction) / static_cast<double>(frames.size()));
        };
        const double start = processor_seconds();
        StageClock clock;
        const FrameOutput output = sequence.render(frame, request);
        double wall = 0.0;
        clock.add_to(wall);
        const double processor = processor_seconds() - start;
        const std::int64_t first = output.statistics.copy_of.value_or(output.statistics.frame);
        FrameRun run = describe_frame(output.statistics, rendered == first);
        rendered = first;
        run.processor_seconds = processor;
        run.wall_seconds = wall;
        run.samples = static_cast<double>(output.statistics.counts.samples) / pixels;
        ChannelImage picture = make_frame_image(output, true, sequence.scene(), settings, sequence.exposure());
        add_indirect(picture, output.shaded);
        save(frame, picture);
        runs.push_back(std::move(run));
    }
    return runs;
}

}  // namespace aleph
