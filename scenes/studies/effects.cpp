// Checks the bounds of the effects plan: every effect that it leaves out is forced, and the picture compared with the
// bound that was given.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>

#include "engine/base/errors.h"
#include "engine/base/pixel_loops.h"
#include "engine/load/load_scene.h"
#include "render/cli/study_output.h"
#include "render/cli/support/options.h"
#include "render/cli/support/progress.h"
#include "render/frame/sequence.h"
#include "render/study/prepared_study.h"
#include "scenes/studies/study_options.h"

namespace aleph {

namespace {

struct EffectsOptions {
    StudyOptions study;
    std::vector<std::string> frames;  ///< SCENE or SCENE@FRAME
    int seeds = 4;
    bool quick = false, quiet = false;
};

struct Picture {
    Image<Rgb> color;
    EffectsPlan plan;
};

Picture render_picture(const Scene& scene, const RenderSettings& settings, std::int64_t frame) {
    FrameOutput out = Sequence(scene, settings).render(frame);
    return {std::move(out.shaded.color), out.statistics.plan};
}

/// Differences of luminance, cd/m2.
Image<double> find_differences(const Picture& a, const Picture& b, double white) {
    return map_pixels(
        [white](const Rgb& one, const Rgb& other) { return white * (double{luminance(one)} - luminance(other)); },
        a.color, b.color);
}

/// A difference of two ways to render, over several seeds: mean, and variance of the mean.
struct MeanDifference {
    Image<double> mean, variance;
    int seeds = 0;

    void add(const Image<double>& differences) {
        if (seeds++ == 0) mean = variance = squares_ = Image<double>(differences.width, differences.height);
        for (std::size_t i = 0; i < mean.size(); ++i) {
            const double delta = differences.pixels[i] - mean.pixels[i];
            mean.pixels[i] += delta / seeds;
            squares_.pixels[i] += delta * (differences.pixels[i] - mean.pixels[i]);  // Welford 1962
            variance.pixels[i] = seeds > 1 ? squares_.pixels[i] / (seeds - 1) / seeds : 0.0;
        }
    }

  private:
    Image<double> squares_;
};

/// Standard errors from the variances of a pixel and the 24 around it, whichever tells more: a few seeds alone miss
/// rare samples.
Image<double> find_standard_errors(const Image<double>& variance) {
    constexpr int reach = 2;
    Image<double> errors(variance.width, variance.height, 0.0);
    for (int y = 0; y < errors.height; ++y) {
        for (int x = 0; x < errors.width; ++x) {
            double sum = 0.0;
            int count = 0;
            visit_around(variance, x, y, reach, [&](int nx, int ny) {
                sum += variance(nx, ny);
                ++count;
            });
            errors(x, y) = std::sqrt(std::max(variance(x, y), sum / count));
        }
    }
    return errors;
}

double largest_of(const Image<double>& values) {
    double largest = 0.0;
    for (const double value : values.pixels) largest = std::max(largest, std::abs(value));
    return largest;
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
    for (const auto& [effect, name, description] : effect_list) {
        const PlannedEffect& planned = plan.of(effect);
        if (planned.decision == Decision::simulate || planned.by_user || !planned.bound) continue;
        if (planned.bound->luminance > 0.0 || std::ranges::find(alone, effect) != std::end(alone))
            trials.push_back({name, EffectSet(effect), *planned.bound});
        else
            others.effects.add(effect);
    }
    if (!others.effects.empty()) trials.push_back(others);
    return trials;
}

struct Totals {
    std::size_t pixels = 0, violations = 0, untested = 0;
};

/// Rounding of 32-bit sums that add the same light in another order, relative.
constexpr double rounding = 1e-6;

/// In any channel, by more than rounding; NaN differs from everything.
bool differs(const Rgb& a, const Rgb& b) {
    for (int c = 0; c < 3; ++c) {
        if (!(std::abs(double{a[c]} - b[c]) <= rounding * std::abs(a[c]))) return true;
    }
    return false;
}

struct Finding {
    double difference = 0.0, noise = 0.0;  ///< the largest; of the noise what is allowed for, cd/m2
    std::size_t violations = 0;
    bool tested = true;  ///< the noise is not larger than the bound
};

/// Compares the plan with one that simulates more. Where the bound is 0, nothing but rounding may differ. Elsewhere the
/// means over several seeds are compared, and six standard errors allowed.
Finding compare_with_bound(const Scene& scene, const RenderSettings& settings, std::int64_t frame,
                           const Picture& planned, const EffectSet& force, const EffectBound& bound, int seeds) {
    constexpr double standard_errors = 6.0;
    const double white = scene.film.viewing.display_white;
    Finding finding;
    MeanDifference difference;
    Image<std::uint8_t> changed(planned.color.width, planned.color.height, 0);
    for (int i = 0; i < (bound.luminance > 0.0 ? seeds : 1); ++i) {
        RenderSettings plain = settings, forced = settings;
        plain.seed = forced.seed = settings.seed + static_cast<std::uint32_t>(i);
        forced.effects.force = force;
        const Picture with = render_picture(scene, forced, frame);
        const Picture own = i == 0 ? planned : render_picture(scene, plain, frame);
        difference.add(find_differences(own, with, white));
        for (std::size_t k = 0; k < changed.size(); ++k)
            changed.pixels[k] |= differs(own.color.pixels[k], with.color.pixels[k]) ? 1 : 0;
    }
    const Image<double> noise = find_standard_errors(difference.variance);
    finding.difference = largest_of(difference.mean);
    finding.noise = standard_errors * largest_of(noise);
    finding.tested = finding.noise <= bound.luminance;
    for (std::size_t i = 0; i < noise.size(); ++i) {
        const double allowed =
            bound.luminance + standard_errors * noise.pixels[i] + rounding * white * luminance(planned.color.pixels[i]);
        const bool within = std::abs(difference.mean.pixels[i]) <= allowed;
        finding.violations += !within || (bound.luminance == 0.0 && changed.pixels[i] != 0) ? 1 : 0;
    }
    return finding;
}

void try_frame(const FrameOfScene& which, const EffectsOptions& options, std::vector<TableRow>& rows, Totals& totals) {
    const Scene scene = load_scene(which.file);
    const RenderSettings settings = scene_settings(scene, which.file, options.study);
    const std::int64_t frame = which.frame.value_or(frame_range(scene).first);
    const std::string name = fmt::format("{} {}", name_scene(which.file), frame);
    const Picture planned = render_picture(scene, settings, frame);
    const double bound_of_all = planned.plan.left_out_thresholds();
    const double share = planned_thresholds(settings);
    if (bound_of_all > share * (1.0 + 1e-9)) {
        fmt::print("{}: the bounds of what is left out sum to {:.3g} thresholds; {:.3g} are allowed\n", name,
                   bound_of_all, share);
        ++totals.violations;
    }
    for (const Trial& trial : list_trials(planned.plan)) {
        const Finding found =
            compare_with_bound(scene, settings, frame, planned, trial.effects, trial.bound, options.seeds);
        totals.pixels += found.tested ? planned.color.size() : 0;
        totals.untested += found.tested ? 0 : 1;
        totals.violations += found.violations;
        rows.push_back({name, trial.name, fmt::format("{:.2g}", trial.bound.luminance),
                        fmt::format("{:.2g}", trial.bound.thresholds), fmt::format("{:.2g}", found.difference),
                        fmt::format("{:.2g}", found.noise),
                        found.tested ? fmt::format("{}", found.violations)
                                     : fmt::format("{}, too noisy to tell", found.violations)});
    }
}

void make_quick(EffectsOptions& options) {
    options.study.size = "32x24";
    options.frames = {"scenes/cornell/scene.json@3",      "scenes/pool-still/scene.json@0",
                      "scenes/boomerang/scene.json@45",   "scenes/hard/sealed_lamp.json",
                      "scenes/effects/far_lights.json@1", "scenes/effects/slow_camera.json@1",
                      "tests/assets/gltf/morph_cube.glb"};
}

int run_effects(const EffectsOptions& options) {
    std::vector<TableRow> rows{{"frame", "forced", "bound, cd/m2", "thresholds", "difference", "noise", "violations"}};
    Totals totals;
    if (options.seeds < 2) throw InputError("", "--seeds", "expected at least 2: one has no variance");
    if (options.frames.empty()) throw InputError("", "frames", "name scene files, or give --quick");
    Progress progress("frames", static_cast<double>(options.frames.size()), progress_look(options.quiet));
    for (std::size_t i = 0; i < options.frames.size(); ++i) {
        try_frame(parse_frame_of_scene(options.frames[i]), options, rows, totals);
        progress.update(static_cast<double>(i + 1));
    }
    print_rows(rows, options.study.markdown, std::cout);
    fmt::print("\n{} violations over {} comparisons of pixels; {} rows were too noisy to test their bound\n",
               totals.violations, totals.pixels, totals.untested);
    return totals.violations == 0 ? 0 : 1;
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Renders frames with the effects plan, and with each effect forced that the plan leaves out. The "
        "difference of every pixel is compared with the bound that the plan gave: where it is larger, the plan is "
        "wrong. A bound of 0 allows for rounding only; elsewhere means over several seeds are compared, and six "
        "standard errors are allowed for. Exit code 1 if a plan is wrong."};
    aleph::EffectsOptions options;
    app.add_option("frames", options.frames, "scene files, as FILE or FILE@FRAME; default: the first frame")
        ->type_name("FRAME");
    app.add_flag("--quick", options.quick, "a few frames of scenes of this repository, small: about 20 seconds");
    aleph::add_value(app, "--seeds", options.seeds, "pairs of renderings where a bound is above 0, at least 2");
    app.add_flag("-q,--quiet", options.quiet, "do not show progress");
    return aleph::run_study_program(app, options.study, argc, argv, [&] {
        if (options.quick) aleph::make_quick(options);
        return aleph::run_effects(options);
    });
}
