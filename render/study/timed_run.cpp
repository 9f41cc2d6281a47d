#include "render/study/timed_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/scene/scene_hash.h"
#include "render/frame/sequence.h"
#include "render/output/frame_files.h"
#include "render/plan/effect_table.h"
#include "render/settings/fingerprint.h"
#include "render/settings/measure.h"
#include "render/study/reference_picture.h"

namespace aleph {

/// To and from JSON. Files of other builds of the program have other names (digest).
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FrameRun, frame, processor_seconds, wall_seconds, stages, rays, samples, records,
                                   plan)

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

/// Names of files, which variants may not fit.
std::string digest(const RunName& name) {
    return hash_bytes(fmt::format("{}\n{}\n{}\n{}", program_build(), name.identity, name.scene, name.seed))
        .substr(0, 16);
}

}  // namespace

double processor_seconds() {
    timespec used{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
    return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

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
        add_color(picture, indirect_layer, output.shaded.indirect);
        save(frame, picture);
        runs.push_back(std::move(run));
    }
    return runs;
}

RunStore::RunStore(std::filesystem::path folder) : folder_(std::move(folder)) {
    create_folder(folder_ / "runs");
}

std::filesystem::path RunStore::file(const RunName& name) const {
    return folder_ / "runs" / fmt::format("{}-{}.json", digest(name), name.repeat);
}

std::filesystem::path RunStore::picture(const RunName& name, std::int64_t frame) const {
    return folder_ / "runs" / fmt::format("{}-{}.exr", digest(name), frame);
}

std::optional<std::vector<FrameRun>> RunStore::find(const RunName& name, const std::vector<int>& frames) const {
    const std::filesystem::path path = file(name);
    if (!std::filesystem::exists(path)) return std::nullopt;
    for (const int frame : frames) {
        if (!std::filesystem::exists(picture(name, frame))) return std::nullopt;
    }
    const std::string text = read_text(path);
    std::vector<FrameRun> runs;
    try {
        nlohmann::json::parse(text).at("frames").get_to(runs);
    } catch (const nlohmann::json::exception&) {
        throw InputError(path.string(), "",
                         "is no finished run of a study; remove it, and the study will make it again");
    }
    const bool complete =
        std::ranges::equal(runs, frames, {}, &FrameRun::frame) &&
        std::ranges::all_of(runs, [](const FrameRun& run) { return nlohmann::json::accept(run.plan); });
    return complete ? std::optional(std::move(runs)) : std::nullopt;
}

void RunStore::save(const RunName& name, const std::vector<FrameRun>& frames) const {
    const nlohmann::json run{{"scene", name.scene},
                             {"variant", name.variant},
                             {"seed", name.seed},
                             {"repeat", name.repeat},
                             {"frames", frames}};
    write_file(file(name), run.dump(1) + "\n");
}

}  // namespace aleph
