// What the indirect light of a shot costs, and how steady it is: all frames of a range with light from key moments
// (light_step) and with frames on their own. Flicker is the change of light from frame to frame, along the exact
// motion, of surface points whose surroundings are at rest.

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "engine/base/errors.h"
#include "engine/load/load_scene.h"
#include "render/cli/options.h"
#include "render/cli/progress.h"
#include "render/settings/frame_list.h"
#include "scenes/studies/rest_points.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_table.h"

namespace aleph {

namespace {

struct ShotOptions {
    StudyOptions study{.size = "160x120", .gather = 0, .spp = 0};
    std::string frames = "0-59";
    std::vector<std::string> steps = {"0", "10"};
    std::string guide = "none";
    double accuracy = 0.15;
    int block = 8;
    bool markdown = false;
};

/// All frames of a shot, rendered in order.
struct Shot {
    std::vector<Image<Rgb>> indirect;  ///< per frame
    double gather_rays = 0.0, records = 0.0, seconds = 0.0;
};

Shot render_shot(const Scene& scene, const RenderSettings& settings, const std::vector<int>& frames,
                 const std::string& name, bool quiet) {
    Sequence sequence(scene, settings);
    Progress progress(name, static_cast<double>(frames.size()), progress_look(quiet));
    Shot shot;
    const double start = processor_seconds();
    for (const int frame : frames) {
        FrameOutput out = sequence.render(frame);
        shot.gather_rays += static_cast<double>(out.statistics.counts.rays.gather);
        shot.records += static_cast<double>(out.statistics.counts.records);
        for (const MomentStatistics& moment : out.statistics.moments) {
            shot.gather_rays += static_cast<double>(moment.counts.rays.gather);
            shot.records += static_cast<double>(moment.counts.records);
        }
        shot.indirect.push_back(std::move(out.shaded.indirect));
        progress.update(static_cast<double>(shot.indirect.size()));
    }
    shot.seconds = processor_seconds() - start;
    return shot;
}

/// Flicker of several renderings of one shot over all pairs of consecutive frames, ascending.
std::vector<std::vector<double>> measure_shots(const Scene& scene, const RenderSettings& settings,
                                               const std::vector<int>& frames, const std::vector<Shot>& shots,
                                               int block) {
    const Sequence sequence(scene, settings);
    Sequence viewer = make_vision_sequence(scene, settings, Guide::spatial, &thesis_vision());
    StudyFrame one(sequence, settings, frames[0]), other(sequence, settings, frames[0]);
    StudyFrame *now = &one, *next = &other;
    std::vector<std::vector<double>> flicker(shots.size());
    for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
        next->move_to(frames[i + 1]);
        const FrameVision vision = compute_vision(viewer, frames[i]);
        const std::vector<RestPoint> points = find_rest_points(*now, *next, settings, vision.threshold, block);
        for (std::size_t s = 0; s < shots.size(); ++s) {
            const std::vector<double> changes =
                measure_flicker(*now, points, find_irradiance(*now, shots[s].indirect[i]),
                                find_irradiance(*next, shots[s].indirect[i + 1]));
            flicker[s].insert(flicker[s].end(), changes.begin(), changes.end());
        }
        std::swap(now, next);
    }
    for (std::vector<double>& changes : flicker) std::ranges::sort(changes);
    return flicker;
}

void print_row(const StudyTable& table, const std::string& step, const Shot& shot, double direct_seconds,
               const Shot& alone, const std::vector<double>& flicker) {
    const auto count = static_cast<double>(flicker.size());
    const auto quantile = [&](double q) {
        return flicker.empty() ? 0.0 : flicker[static_cast<std::size_t>(q * (count - 1.0))];
    };
    const auto beyond = flicker.end() - std::ranges::upper_bound(flicker, 0.1);
    table.add({step, fmt::format("{:.0f}", shot.records), fmt::format("{:.2f}", 1e-6 * shot.gather_rays),
               fmt::format("{:.2f}", alone.gather_rays / shot.gather_rays), fmt::format("{:.1f}", shot.seconds),
               fmt::format("{:.1f}", shot.seconds - direct_seconds),
               fmt::format("{:.2f}", (alone.seconds - direct_seconds) / (shot.seconds - direct_seconds)),
               fmt::format("{}", flicker.size()),
               fmt::format("{:.2f}", 100.0 * static_cast<double>(beyond) / std::max(1.0, count)),
               fmt::format("{:.3f}", quantile(0.5)), fmt::format("{:.3f}", quantile(0.99)),
               fmt::format("{:.3f}", quantile(0.999)), fmt::format("{:.2f}", quantile(1.0))});
}

void run_shot(const ShotOptions& options) {
    const StudyOptions& study = options.study;
    const std::vector<int> frames = parse_frame_list(options.frames);
    const Scene scene = load_scene(study.scene);
    RenderSettings settings = with_choice(study_settings(scene, study.scene, study), "guide", options.guide);
    settings.accuracy = options.accuracy;
    settings.light_samples = 1;
    std::vector<std::string> steps = options.steps;
    if (!has_setting("light_step")) steps = {"0"};
    std::vector<Shot> shots;
    for (const std::string& step : steps) {
        RenderSettings variant = settings;
        SettingMap map;
        parse_setting("light_step=" + step, map);
        if (has_setting("light_step")) apply_settings(variant, map, "--steps");
        shots.push_back(render_shot(scene, variant, frames, "light step " + step, study.quiet));
    }
    RenderSettings direct = settings;
    direct.bounces = 0;
    const Shot without = render_shot(scene, direct, frames, "direct light", study.quiet);
    settings.perception.guide = Guide::none;
    const auto flicker = measure_shots(scene, settings, frames, shots, options.block);

    fmt::print(
        "{}, frames {}, {}, accuracy {:g}, guide {}, gather {}; seconds of processor time, {:.1f} of them without "
        "indirect light; change from frame to frame in thresholds of the thesis's model at rest\n\n",
        study.scene, options.frames, study.size, options.accuracy, options.guide, study.gather, without.seconds);
    const StudyTable table({"light step", "records", "gather rays (M)", "times fewer", "seconds", "of indirect",
                            "times faster", "points", "above .1 (%)", "median", "99 %", "99.9 %", "worst"},
                           0, options.markdown);
    for (std::size_t s = 0; s < shots.size(); ++s)
        print_row(table, steps[s], shots[s], without.seconds, shots.front(), flicker[s]);
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Compares the indirect light of a whole shot at several steps of key moments (0: every frame on its own): "
        "gather rays and seconds of all frames, and the change of light from frame to frame at points whose "
        "surroundings are at rest. Ratios are to the first step."};
    aleph::ShotOptions options;
    aleph::add_scene_option(app, options.study);
    aleph::add_study_options(app, options.study);
    aleph::add_quiet_option(app, options.study);
    aleph::add_accuracy_option(app, options.accuracy);
    app.add_option("--frames", options.frames, "consecutive frames")->capture_default_str();
    app.add_option("--steps", options.steps, "values of the setting light_step")->delimiter(',')->capture_default_str();
    app.add_option("--guide", options.guide, "guide of the renderings")->capture_default_str();
    aleph::add_value(app, "--every", options.block, "side of a block of pixels; one point of each is followed");
    app.add_flag("--markdown", options.markdown, "print the table as Markdown");
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_shot(options); });
}
