// What the Aleph map and the rules of stopping save of a frame with many samples, with an empty and with a full cache:
// the setting of figure 6.14 of the thesis.

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "engine/load/load_scene.h"
#include "render/cli/options.h"
#include "render/frame_list.h"
#include "scenes/studies/judged_frame.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_table.h"

namespace aleph {

namespace {

struct SamplingOptions {
    StudyOptions study{.size = "120x90", .gather = 0, .spp = 512};
    ReferencePictureOptions reference{.kind = "gather"};
    std::string frames = "0";
    std::vector<std::string> sets;
    bool markdown = false;
};

/// A way to render, as settings.
struct Way {
    std::string name;
    std::vector<std::string> sets;
};

/// The first is what the others are compared with.
std::vector<Way> list_ways() {
    return {{"uniform", {"guide=none", "sampling=uniform"}},
            {"guided cache", {"sampling=uniform"}},
            {"consecutive (6.10)", {"sampling=consecutive"}},
            {"variance (6.12)", {"sampling=variance"}},
            {"variance, deviation as printed", {"sampling=variance", "variance_test=deviation"}},
            {"protocol (6.13)", {"sampling=protocol"}},
            {"threshold", {"sampling=threshold"}},
            {"`--error 1`", {"error=1"}}};
}

RenderSettings settings_of(const Way& way, const JudgedFrame& frame, const SamplingOptions& options) {
    std::vector<std::string> sets = way.sets;
    sets.push_back(fmt::format("spp={}", options.study.spp));
    sets.insert(sets.end(), options.sets.begin(), options.sets.end());
    return with_settings(frame.settings, sets);
}

/// A frame rendered in one way: with an empty cache, whose picture is judged, and with a full one.
struct WayRun {
    ErrorRun run;
    double full_seconds = 0.0;  ///< of a processor
};

WayRun run_way(const Way& way, const JudgedFrame& frame, const SamplingOptions& options) {
    auto [empty, full] = render_timed_twice(frame.scene, settings_of(way, frame, options), frame.number);
    return {judge(frame, way.name, std::move(empty)), full.cost.seconds()};
}

void add_row(const StudyTable& table, const JudgedFrame& frame, const WayRun& way, const WayRun& first) {
    const auto samples = [](const WayRun& w) {
        return 1e-6 * w.run.cost.mean_samples * static_cast<double>(w.run.error.pixels);
    };
    const auto ratio = [](double a, double b) { return fmt::format("{:.1f}", a / std::max(b, 1e-9)); };
    const BeyondShare& beyond = way.run.error.beyond.front();
    table.add({frame.name, way.run.name, fmt::format("{:.1f}", way.run.cost.seconds()),
               ratio(first.run.cost.seconds(), way.run.cost.seconds()), fmt::format("{:.1f}", way.full_seconds),
               ratio(first.full_seconds, way.full_seconds), fmt::format("{:.2f}", samples(way)),
               ratio(samples(first), samples(way)), fmt::format("{:.2f}", beyond.percent),
               fmt::format("{:.2f}", beyond.certain), fmt::format("{:.2f}", beyond.by_noise),
               fmt::format("{:.3f}", way.run.error.median)});
}

void run_sampling(const SamplingOptions& options) {
    const Scene scene = load_scene(options.study.scene);
    const RenderSettings settings = judged_settings(scene, options.study.scene, options.study.size, options.sets);
    fmt::print("{}, {}, at most {} samples a pixel, thresholds of {}; seconds of a processor\n\n", options.study.scene,
               options.study.size, options.study.spp, std::get<std::string>(setting_map(settings).at("vision")));
    const StudyTable table({"frame", "settings", "empty cache: seconds", "ratio", "full: seconds", "ratio",
                            "samples (M)", "ratio", "beyond 1 (%)", "certain", "by noise", "median error"},
                           2, options.markdown);
    for (const int number : parse_frame_list(options.frames)) {
        const JudgedFrame frame = make_judged_frame(scene, settings, number, options.study.scene, options.reference,
                                                    {1.0}, options.study.quiet);
        std::optional<WayRun> first;
        for (const Way& way : list_ways()) {
            const WayRun run = run_way(way, frame, options);
            if (!first) first = run;
            add_row(table, frame, run, *first);
        }
    }
}

void add_sampling_options(CLI::App& app, SamplingOptions& options) {
    add_scene_option(app, options.study);
    app.add_option("--frames", options.frames, "frame numbers, such as 20,60 or 0-89x10")->capture_default_str();
    app.add_option("--size", options.study.size, "WIDTHxHEIGHT of the frames in pixels")->capture_default_str();
    add_value(app, "--spp", options.study.spp, "samples per pixel of uniform sampling, and the most of every rule");
    add_value(app, "-t,--threads", options.study.threads, "number of threads; 0: all");
    add_quiet_option(app, options.study);
    add_reference_options(app, options.reference);
    add_set_option(app, options.sets);
    app.add_flag("--markdown", options.markdown, "print the table as Markdown");
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Renders frames with many samples a pixel: without a guide, with the cache guided by the Aleph map, and with "
        "every rule of stopping. Each is rendered twice: with an empty cache, and with the key moments and estimates "
        "of the first time. Pictures are judged by references with other random numbers, in thresholds of the viewer."};
    aleph::SamplingOptions options;
    aleph::add_sampling_options(app, options);
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_sampling(options); });
}
