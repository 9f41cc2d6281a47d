// Whether the effects plan keeps its word: every effect that it leaves out is forced, and the picture compared with the
// bound that was given; and what the plan saves.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "engine/load/load_scene.h"
#include "render/cli/options.h"
#include "render/cli/progress.h"
#include "render/sequence.h"
#include "scenes/studies/study_frame.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_table.h"
#include "scenes/studies/study_tools.h"

namespace aleph {

namespace {

struct EffectsOptions {
    StudyOptions study{.size = "320x240", .gather = 0, .spp = 0};
    std::vector<std::string> frames;  ///< SCENE or SCENE@FRAME
    std::vector<std::string> sets;
    bool markdown = false;
};

/// A picture and what it took, key moments included.
struct Picture {
    Image<Rgb> color;
    double seconds = 0.0, rays = 0.0;
    EffectsPlan plan;
};

Picture render_picture(const Scene& scene, const RenderSettings& settings, std::int64_t frame) {
    Sequence sequence(scene, settings);
    const double start = processor_seconds();
    FrameOutput out = sequence.render(frame);
    Picture picture{std::move(out.shaded.color), processor_seconds() - start, 0.0, out.statistics.plan};
    picture.rays = static_cast<double>(out.statistics.counts.rays.total());
    for (const MomentStatistics& moment : out.statistics.moments) {
        picture.rays += static_cast<double>(moment.counts.rays.total());
    }
    return picture;
}

/// Of luminance, cd/m2.
Image<double> find_differences(const Picture& a, const Picture& b, double white) {
    Image<double> differences(a.color.width, a.color.height);
    for (std::size_t i = 0; i < a.color.size(); ++i) {
        differences.pixels[i] = white * std::abs(double{luminance(a.color.pixels[i])} - luminance(b.color.pixels[i]));
    }
    return differences;
}

/// The noise of one of two renderings with different seeds, cd/m2: the largest difference within two pixels, over
/// sqrt 2, since rare samples at outlines miss some pixels.
Image<double> find_local_noise(const Image<double>& differences) {
    constexpr int reach = 2;
    Image<double> noise(differences.width, differences.height, 0.0);
    for (int y = 0; y < noise.height; ++y) {
        for (int x = 0; x < noise.width; ++x) {
            for (int ny = std::max(0, y - reach); ny <= std::min(noise.height - 1, y + reach); ++ny) {
                for (int nx = std::max(0, x - reach); nx <= std::min(noise.width - 1, x + reach); ++nx) {
                    noise(x, y) = std::max(noise(x, y), differences(nx, ny) / std::sqrt(2.0));
                }
            }
        }
    }
    return noise;
}

double largest_of(const Image<double>& values) {
    return *std::ranges::max_element(values.pixels);
}

/// An effect, or several without a bound above 0, that are forced together.
struct Trial {
    std::string name;
    EffectSet effects;
    EffectBound bound;
};

/// Effects that have a bound or cost rays, one by one; those that cannot change the picture, together.
std::vector<Trial> list_trials(const EffectsPlan& plan) {
    constexpr Effect alone[] = {Effect::direct_light, Effect::area_shadows, Effect::indirect_diffuse};
    std::vector<Trial> trials;
    Trial others{"all others", {}, {}};
    for (std::size_t i = 0; i < effect_count; ++i) {
        const Effect effect = static_cast<Effect>(i);
        const PlannedEffect& planned = plan.effects[i];
        if (planned.decision == Decision::simulate || planned.by_user || !planned.bound) continue;
        const bool one = planned.bound->luminance > 0.0 || std::ranges::find(alone, effect) != std::end(alone);
        if (!one) {
            others.effects.add(effect);
            continue;
        }
        Trial trial{effect_name(effect), {}, *planned.bound};
        trial.effects.add(effect);
        trials.push_back(trial);
    }
    if (!others.effects.empty()) trials.push_back(others);
    return trials;
}

struct Totals {
    std::size_t pixels = 0, violations = 0;
    double planned = 0.0, off = 0.0;
};

/// Rounding of 32-bit sums, relative to the brightest pixel.
double rounding_of(const Picture& picture, double white) {
    double brightest = 0.0;
    for (const Rgb& pixel : picture.color.pixels) brightest = std::max(brightest, double{luminance(pixel)});
    return 1e-5 * white * brightest;
}

void try_frame(const FrameOfScene& which, const EffectsOptions& options, const StudyTable& table, Totals& totals) {
    const Scene scene = load_scene(which.file);
    const RenderSettings settings = scene_settings(scene, which.file, options.study.size, options.sets);
    const std::int64_t frame = which.frame.value_or(frame_range(scene).first);
    const double white = scene.viewing.display_white;
    const std::string name = fmt::format("{} {}", scene_name(which.file), frame);
    const Picture planned = render_picture(scene, settings, frame);
    RenderSettings off = settings;
    off.plan = EffectsPlanning::off;
    const Picture everything = render_picture(scene, off, frame);
    totals.planned += planned.seconds;
    totals.off += everything.seconds;
    const double bound_of_all = planned.plan.left_out_thresholds();
    table.add({name, "plan off", "", fmt::format("{:.2g}", bound_of_all),
               fmt::format("{:.2g}", largest_of(find_differences(planned, everything, white))), "",
               fmt::format("{:.3f}", planned.seconds), fmt::format("{:.3f}", everything.seconds),
               fmt::format("{:.3f}", planned.rays / everything.rays), ""});
    for (const Trial& trial : list_trials(planned.plan)) {
        RenderSettings forced = settings;
        forced.force = trial.effects;
        const Picture with = render_picture(scene, forced, frame);
        Image<double> noise(planned.color.width, planned.color.height, 0.0);
        if (trial.bound.luminance > 0.0) {
            forced.seed = settings.seed + 1;
            noise = find_local_noise(find_differences(with, render_picture(scene, forced, frame), white));
        }
        const Image<double> differences = find_differences(planned, with, white);
        const double rounding = rounding_of(planned, white);
        std::size_t violations = 0;
        for (std::size_t i = 0; i < differences.size(); ++i) {
            if (differences.pixels[i] > trial.bound.luminance + 4.0 * noise.pixels[i] + rounding) ++violations;
        }
        totals.pixels += planned.color.size();
        totals.violations += violations;
        table.add({"", trial.name, fmt::format("{:.2g}", trial.bound.luminance),
                   fmt::format("{:.2g}", trial.bound.thresholds), fmt::format("{:.2g}", largest_of(differences)),
                   fmt::format("{:.2g}", largest_of(noise)), fmt::format("{:.3f}", planned.seconds),
                   fmt::format("{:.3f}", with.seconds), fmt::format("{:.3f}", planned.rays / with.rays),
                   fmt::format("{}", violations)});
    }
}

int run_effects(const EffectsOptions& options) {
    const StudyTable table({"frame", "forced", "bound, cd/m2", "thresholds", "difference", "noise", "seconds", "forced",
                            "share of rays", "violations"},
                           2, options.markdown);
    Totals totals;
    Progress progress("frames", static_cast<double>(options.frames.size()), progress_look(options.study.quiet));
    for (std::size_t i = 0; i < options.frames.size(); ++i) {
        try_frame(parse_frame_of_scene(options.frames[i]), options, table, totals);
        progress.update(static_cast<double>(i + 1));
    }
    fmt::print("\n{} violations over {} pixels; {:.2f} s with the plan, {:.2f} s without\n", totals.violations,
               totals.pixels, totals.planned, totals.off);
    return totals.violations == 0 ? 0 : 1;
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Renders frames with the effects plan, without it, and with each effect forced that the plan leaves out. The "
        "difference of every pixel is compared with the bound that the plan gave: where it is larger, by more than "
        "rounding and four times the noise between two seeds nearby, the plan is wrong. Exit code 1 if one is."};
    aleph::EffectsOptions options;
    app.add_option("frames", options.frames, "scene files, as FILE or FILE@FRAME; default: the first frame")
        ->required()
        ->type_name("FRAME");
    app.add_option("--size", options.study.size, "WIDTHxHEIGHT of the frames in pixels")->capture_default_str();
    aleph::add_value(app, "-t,--threads", options.study.threads, "number of threads; 0: all");
    aleph::add_quiet_option(app, options.study);
    aleph::add_set_option(app, options.sets);
    app.add_flag("--markdown", options.markdown, "print the table as Markdown");
    int violations = 0;
    const int code =
        aleph::run_study(app, options.study, argc, argv, [&] { violations = aleph::run_effects(options); });
    return code != 0 ? code : violations;
}
