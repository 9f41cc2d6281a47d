// What accuracy costs: a frame at several accuracies under all four guides, against a dense gather; then the best
// uniform accuracy that leaves no more pixels beyond threshold than the guided frame does.

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
    std::string scene, dense;
    StudyOptions study{.size = "320x240"};
    std::vector<std::string> accuracies = {".5", ".3", ".2", ".15", ".1", ".05"};
    int frame = 20, dense_gather = 4096, light_samples = 4;
    bool best_uniform = false;
};

/// One frame's experiment: every variant is measured against the same dense frame and the same thresholds.
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
               row.statistics.seconds.total, static_cast<double>(row.statistics.rays.gather) * 1e-6,
               row.statistics.records, row.error.relative_mse, row.error.percent_beyond);
    std::cout << std::flush;
}

/// The loosest uniform accuracy with at most `percent` of the pixels beyond, by bisection of log accuracy.
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

int run_accuracy(const AccuracyOptions& options) {
    const Scene scene = load_scene(options.scene);
    RenderSettings settings = study_settings(scene, options.scene, options.study);
    settings.light_samples = options.light_samples;
    const ThreadLimit limit(options.study.threads);
    const Image<Rgb> dense = load_or_render_dense(scene, settings, options.frame, options.dense_gather, options.dense);
    fmt::print("{}, frame {}, {}, gather {}, dense gather {}, samples per pixel {}, {} threads\n\n", options.scene,
               options.frame, options.study.size, options.study.gather, options.dense_gather, options.study.spp,
               thread_count());
    fmt::print("| accuracy | guide | seconds | gather rays (M) | records | relative MSE | beyond threshold (%) |\n");
    fmt::print("| ---: | --- | ---: | ---: | ---: | ---: | ---: |\n");
    for (const std::string& text : options.accuracies) {
        const double accuracy = parse_value<double>(text, "--accuracies");
        const FrameOutput saliency = render_variant(scene, settings, options.frame, Guide::saliency, accuracy);
        const Experiment experiment{scene, settings, options.frame, dense, saliency.threshold};
        Experiment::Row guided;
        for (const Guide guide : {Guide::none, Guide::spatial, Guide::full, Guide::saliency}) {
            const Experiment::Row row = experiment.run(guide, accuracy);
            if (guide == Guide::saliency) guided = row;
            print_row(accuracy, guide_name(guide), row);
        }
        if (options.best_uniform) print_best_uniform(experiment, accuracy, guided.error.percent_beyond);
    }
    return exit_done;
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{"a table of what accuracy costs: seconds, gather rays, records, errors against a dense gather"};
    aleph::AccuracyOptions options;
    app.add_option("scene", options.scene, "a scene file")->required();
    aleph::add_study_options(app, options.study);
    app.add_option("--accuracies", options.accuracies, "list")->delimiter(',')->capture_default_str();
    app.add_option("--dense", options.dense, "EXR that holds, or will hold, the dense frame");
    aleph::add_value(app, "--frame", options.frame, "frame");
    aleph::add_value(app, "--dense-gather", options.dense_gather, "rays per irradiance value of the dense frame");
    aleph::add_value(app, "--light-samples", options.light_samples, "direct light; the same noise in every variant");
    app.add_flag("--best-uniform", options.best_uniform, "add the best uniform accuracy with the same share beyond");
    return aleph::run_program(
        app, [&] { return aleph::run_accuracy(options); }, argc, argv, std::cerr);
}
