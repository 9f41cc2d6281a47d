// What accuracy costs, and what a viewer sees of it: consecutive frames at several accuracies, guides and models of
// vision, measured against a path-traced reference with random numbers of its own. Errors and flicker are in units of
// the model's thresholds. Also finds the loosest uniform accuracy with no more pixels beyond the threshold.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/load/load_scene.h"
#include "render/cli/options.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_tools.h"

namespace aleph {

namespace {

struct AccuracyOptions {
    StudyOptions study{.size = "160x120", .gather = 64, .spp = 4};
    std::string reference{};  ///< pattern of the reference's files
    std::vector<std::string> accuracies = {"1", ".5", ".3", ".2", ".1"};
    std::vector<std::string> guides = {"none", "spatial", "full", "saliency"};
    std::vector<std::string> visions = {"thesis"};
    int frame = 20, frames = 10, light_samples = 16, reference_spp = 1024;
    bool dense = false, best_uniform = false;
};

/// A model of vision with its thresholds.
struct Model {
    std::string name;
    Vision vision;
    std::vector<ChannelImage> maps;
};

struct Experiment {
    const Scene& scene;
    RenderSettings settings;
    FrameRange range;
    std::vector<ChannelImage> reference;

    RenderedFrames render(Guide guide, Vision vision, double accuracy) const {
        RenderSettings variant = settings;
        variant.perception.guide = guide;
        variant.perception.vision = vision;
        variant.accuracy = accuracy;
        return render_frames(scene, variant, range);
    }
};

/// The reference differs from what it judges in its integrator, its samples and its seed.
RenderSettings reference_settings(const AccuracyOptions& options, RenderSettings settings) {
    settings.perception.guide = Guide::none;
    settings.spp = options.reference_spp;
    settings.seed += 1;
    if (options.dense) {
        settings.accuracy = 0.0;
    } else {
        settings.integrator = Integrator::path;
    }
    return settings;
}

std::string percent_columns(const ThresholdFigures& figures) {
    return figures.pixels == 0 ? "- | -"
                               : fmt::format("{:.3f} | {:.3g}", figures.percent_beyond(), figures.percentile_99);
}

void print_row(double accuracy, const std::string& model, const std::string& guide, const StudyRow& row) {
    const std::string certain =
        row.error.noise ? fmt::format("{:.3f}", row.error.percent(static_cast<double>(row.error.noise->certain))) : "-";
    const std::string flicker = row.flicker
                                    ? percent_columns(row.flicker->rest) + " | " + percent_columns(row.flicker->moving)
                                    : "- | - | - | -";
    fmt::print("| {:.3g} | {} | {} | {:.2f} | {:.2f} | {:.0f} | {:.2e} | {} | {} | {} |\n", accuracy, model, guide,
               row.seconds, row.gather_rays * 1e-6, row.records, row.relative_mse, percent_columns(row.error), certain,
               flicker);
    std::cout << std::flush;
}

/// What the reference's own noise makes of each model's columns: it is compared with itself.
void print_noise(const Experiment& experiment, const Model& model) {
    const StudyRow row =
        measure_frames({experiment.range.first, experiment.reference, 0.0, 0.0, 0.0}, experiment.reference, model.maps);
    if (!row.error.noise) {
        fmt::print("The reference has no variance: its noise in thresholds of {} is not known.\n", model.name);
        return;
    }
    const ReferenceNoise& noise = *row.error.noise;
    fmt::print(
        "Noise of the reference in thresholds of {}: median {:.3g}, 99th percentile {:.3g}; by it alone {:.3f} % "
        "of the pixels are beyond",
        model.name, noise.median, noise.percentile_99, row.error.percent(noise.expected));
    if (row.flicker && row.flicker->rest.noise && row.flicker->moving.noise) {
        fmt::print(", and flicker beyond in {:.3f} % at rest, {:.3f} % moving",
                   row.flicker->rest.percent(row.flicker->rest.noise->expected),
                   row.flicker->moving.percent(row.flicker->moving.noise->expected));
    }
    fmt::print(".\n");
}

/// The loosest uniform accuracy with at most `percent` of the pixels beyond the threshold, by bisection of log
/// accuracy.
void print_best_uniform(const Experiment& experiment, const Model& model, double tightest, double percent) {
    double low = std::log(tightest), high = 0.0, best = tightest;
    const auto run = [&](double accuracy) {
        return measure_frames(experiment.render(Guide::none, model.vision, accuracy), experiment.reference, model.maps);
    };
    StudyRow best_row = run(tightest);
    for (int step = 0; step < 7; ++step) {
        const double middle = 0.5 * (low + high);
        const StudyRow row = run(std::exp(middle));
        if (row.error.percent_beyond() <= percent) {
            low = middle;
            best = std::exp(middle);
            best_row = row;
        } else {
            high = middle;
        }
    }
    print_row(best, model.name, "best uniform", best_row);
}

/// All guides and models at one accuracy. Without a guide the picture is the same for every model.
void print_rows(const AccuracyOptions& options, const Experiment& experiment, const std::vector<Model>& models,
                double accuracy) {
    std::optional<RenderedFrames> unguided;
    for (const Model& model : models) {
        double percent_guided = 100.0;
        for (const std::string& name : options.guides) {
            const Guide guide = with_choice(experiment.settings, "guide", name).perception.guide;
            RenderedFrames frames;
            if (guide == Guide::none) {
                if (!unguided) unguided = experiment.render(guide, model.vision, accuracy);
            } else {
                frames = experiment.render(guide, model.vision, accuracy);
            }
            const StudyRow row =
                measure_frames(guide == Guide::none ? *unguided : frames, experiment.reference, model.maps);
            if (guide == Guide::saliency) percent_guided = row.error.percent_beyond();
            print_row(accuracy, model.name, guide_name(guide), row);
        }
        if (options.best_uniform) print_best_uniform(experiment, model, accuracy, percent_guided);
    }
}

void print_head(const AccuracyOptions& options, const Experiment& experiment, const std::vector<Model>& models) {
    const StudyOptions& study = options.study;
    fmt::print(
        "{}, frames {} to {}, {}, gather {}, samples per pixel {}, {} threads; reference {} with {} samples per "
        "pixel\n\n",
        study.scene, experiment.range.first, experiment.range.last, study.size, study.gather, study.spp, thread_count(),
        options.dense ? "gathered at every sample" : "path traced", options.reference_spp);
    for (const Model& model : models) print_noise(experiment, model);
    fmt::print(
        "\n| accuracy | vision | guide | seconds | gather rays (M) | records | relative MSE | beyond (%) | 99 % | "
        "certain (%) | flicker at rest (%) | 99 % | flicker moving (%) | 99 % |\n");
    fmt::print("| ---: | --- | --- |");
    for (int column = 0; column < 11; ++column) fmt::print(" ---: |");
    fmt::print("\n");
}

void run_accuracy(const AccuracyOptions& options) {
    const StudyOptions& study = options.study;
    if (study.spp < 2) {
        throw InputError("", "--spp", "expected at least 2: the reference averages the whole pixel, not its centre");
    }
    if (options.frames < 1) throw InputError("", "--frames", "expected at least 1");
    const Scene scene = load_scene(study.scene);
    RenderSettings settings = study_settings(scene, study.scene, study);
    settings.light_samples = options.light_samples;
    const FrameRange range{options.frame, options.frame + options.frames - 1};
    std::vector<Model> models;
    for (const std::string& name : options.visions) {
        const RenderSettings seen = with_choice(settings, "vision", name);
        models.push_back({name, seen.perception.vision, compute_threshold_maps(scene, seen, range)});
    }
    const Experiment experiment{
        scene, settings, range,
        load_or_render_reference(scene, reference_settings(options, settings), range, options.reference, study.quiet)};
    print_head(options, experiment, models);
    for (const std::string& text : options.accuracies)
        print_rows(options, experiment, models, parse_value<double>(text, "--accuracies"));
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Prints a table of what accuracy costs: seconds, gather rays, records; and what is left of it to see: errors "
        "and flicker against a path-traced reference, in thresholds of a viewer."};
    aleph::AccuracyOptions options;
    aleph::add_scene_option(app, options.study);
    aleph::add_study_options(app, options.study);
    aleph::add_quiet_option(app, options.study);
    app.add_option("--accuracies", options.accuracies, "accuracies to compare")->delimiter(',')->capture_default_str();
    app.add_option("--guides", options.guides, "guides to compare")->delimiter(',')->capture_default_str();
    app.add_option("--vision", options.visions, "models of vision to compare")->delimiter(',')->capture_default_str();
    app.add_option("--reference", options.reference,
                   "EXR files of the reference, such as reference.####.exr: read if they exist, else written");
    aleph::add_value(app, "--frame", options.frame, "first frame");
    aleph::add_value(app, "--frames", options.frames, "number of frames; flicker needs two");
    aleph::add_value(app, "--reference-spp", options.reference_spp, "samples per pixel of the reference");
    app.add_flag("--dense", options.dense, "reference by gathering at every sample in place of path tracing");
    aleph::add_value(app, "--light-samples", options.light_samples, "direct-light samples, the same in every variant");
    app.add_flag("--best-uniform", options.best_uniform,
                 "also find the loosest uniform accuracy with no more pixels beyond the threshold");
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_accuracy(options); });
}
