// What accuracy costs: a frame at several accuracies with all four guides, measured against a dense gather. Also finds
// the loosest uniform accuracy with no more pixels beyond the threshold than the guided frame.

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
    StudyOptions study{.size = "320x240"};
    std::string dense;  ///< file of the dense frame
    std::vector<std::string> accuracies = {".5", ".3", ".2", ".15", ".1", ".05"};
    int frame = 20, dense_gather = 4096, light_samples = 4;
    bool best_uniform = false;
};

/// Measures variants of one frame against the same dense frame and the same thresholds.
struct Experiment {
    const Scene& scene;
    const RenderSettings& settings;
    int frame;
    const Image<Rgb>& dense;
    const Image<float>& threshold;

    struct Row {
        FrameStatistics statistics;
        ErrorFigures error;
    };
    Row run(Guide guide, double accuracy) const {
        const FrameOutput output = render_variant(scene, settings, frame, guide, accuracy);
        return {output.statistics, measure_error(output.shaded.color, dense, threshold, scene.viewing.display_white)};
    }
};

void print_row(double accuracy, const std::string& guide, const Experiment::Row& row) {
    fmt::print("| {:.3g} | {} | {:.2f} | {:.2f} | {} | {:.2e} | {:.3f} |\n", accuracy, guide,
               row.statistics.seconds.total, static_cast<double>(row.statistics.counts.rays.gather) * 1e-6,
               row.statistics.counts.records, row.error.relative_mse, row.error.percent_beyond);
    std::cout << std::flush;
}

/// The loosest uniform accuracy with at most `percent` of the pixels beyond the threshold, by bisection of log
/// accuracy.
void print_best_uniform(const Experiment& experiment, double tightest, double percent) {
    double low = std::log(tightest), high = 0.0, best = tightest;
    Experiment::Row best_row = experiment.run(Guide::none, tightest);
    for (int step = 0; step < 7; ++step) {
        const double middle = 0.5 * (low + high);
        const Experiment::Row row = experiment.run(Guide::none, std::exp(middle));
        if (row.error.percent_beyond <= percent) {
            low = middle;
            best = std::exp(middle);
            best_row = row;
        } else {
            high = middle;
        }
    }
    print_row(best, "best uniform", best_row);
}

/// All guides at one accuracy. The thresholds are those of the guided frame.
void print_rows(const AccuracyOptions& options, const Scene& scene, const RenderSettings& settings,
                const Image<Rgb>& dense, double accuracy) {
    const FrameOutput saliency = render_variant(scene, settings, options.frame, Guide::saliency, accuracy);
    const Experiment experiment{scene, settings, options.frame, dense, saliency.threshold};
    double percent_guided = 0.0;
    for (const Guide guide : {Guide::none, Guide::spatial, Guide::full, Guide::saliency}) {
        const Experiment::Row row = experiment.run(guide, accuracy);
        if (guide == Guide::saliency) percent_guided = row.error.percent_beyond;
        print_row(accuracy, guide_name(guide), row);
    }
    if (options.best_uniform) print_best_uniform(experiment, accuracy, percent_guided);
}

void run_accuracy(const AccuracyOptions& options) {
    const StudyOptions& study = options.study;
    const Scene scene = load_scene(study.scene);
    RenderSettings settings = study_settings(scene, study.scene, study);
    settings.light_samples = options.light_samples;
    const Image<Rgb> dense = load_or_render_dense(scene, settings, options.frame, options.dense_gather, options.dense);
    fmt::print("{}, frame {}, {}, gather {}, dense gather {}, samples per pixel {}, {} threads\n\n", study.scene,
               options.frame, study.size, study.gather, options.dense_gather, study.spp, thread_count());
    fmt::print("| accuracy | guide | seconds | gather rays (M) | records | relative MSE | beyond threshold (%) |\n");
    fmt::print("| ---: | --- | ---: | ---: | ---: | ---: | ---: |\n");
    for (const std::string& text : options.accuracies)
        print_rows(options, scene, settings, dense, parse_value<double>(text, "--accuracies"));
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Prints a table of what accuracy costs: seconds, gather rays, records, and errors against a dense gather."};
    aleph::AccuracyOptions options;
    aleph::add_scene_option(app, options.study);
    aleph::add_study_options(app, options.study);
    app.add_option("--accuracies", options.accuracies, "accuracies to compare")->delimiter(',')->capture_default_str();
    app.add_option("--dense", options.dense, "EXR file of the dense frame: read if it exists, else written");
    aleph::add_value(app, "--frame", options.frame, "frame number");
    aleph::add_value(app, "--dense-gather", options.dense_gather, "rays per irradiance value of the dense frame");
    aleph::add_value(app, "--light-samples", options.light_samples, "direct-light samples, the same in every variant");
    app.add_flag("--best-uniform", options.best_uniform,
                 "also find the loosest uniform accuracy with no more pixels beyond the threshold");
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_accuracy(options); });
}
