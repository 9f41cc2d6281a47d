// What the irradiance cache gets wrong: indirect light of one frame at several accuracies against dense gathers with
// random numbers of their own, with what it cost. Errors are relative, and in units of a viewer's thresholds for the
// frame at rest.

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "engine/base/parallel.h"
#include "engine/load/load_scene.h"
#include "render/cli/options.h"
#include "render/guide/accuracy_map.h"
#include "render/output/sheet.h"
#include "scenes/studies/cached_light.h"
#include "scenes/studies/reference_light.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_table.h"

namespace aleph {

namespace {

struct CacheOptions {
    StudyOptions study{.size = "512x512", .picture = "cache.png", .gather = 0, .spp = 0};
    ReferenceOptions reference;
    std::vector<std::string> accuracies = {".5", ".3", ".2", ".15", ".1", ".07", ".05"};
    std::string pictured{};
    int frame = 0;
    bool markdown = false;
};

struct Result {
    CachedLight light;
    LightError error;
};

std::vector<Panel> make_panels(const std::string& accuracy, const Result& result, const ReferenceLight& reference,
                               const PixelGrid& grid) {
    Image<float> truth = reference.halves[0];
    double sum = 0.0;
    for (int y = 0; y < truth.height; ++y) {
        for (int x = 0; x < truth.width; ++x) {
            truth(x, y) = reference.has(x, y) ? static_cast<float>(reference.light(x, y)) : 0.0f;
            sum += truth(x, y) / static_cast<double>(truth.size());
        }
    }
    const MapRange range{0.0, 3.0 * sum};
    return {map_panel("indirect light, dense gathers", truth, range),
            map_panel(fmt::format("cache at accuracy {}", accuracy), result.light.light, range),
            map_panel("relative error, 0 to 0.2", relative_error_map(result.light.light, reference, grid), {0.0, 0.2}),
            records_panel(fmt::format("{} irradiance values", result.light.record_count), result.light.records)};
}

Result run_accuracy(const StudyFrame& frame, RenderSettings settings, double accuracy, const ReferenceLight& reference,
                    const PixelGrid& grid, const FrameVision& vision) {
    settings.accuracy = accuracy;
    validate(settings);
    Result result;
    result.light =
        compute_cached_light(frame, settings, compute_accuracy_map(vision.aleph, vision.tolerance, settings));
    result.error = measure_light(result.light.light, reference, grid, vision.threshold);
    return result;
}

void print_row(const StudyTable& table, const std::string& accuracy, const Result& result) {
    const CachedLight& light = result.light;
    const LightError& error = result.error;
    table.add({accuracy, fmt::format("{}", light.record_count), fmt::format("{}", light.late),
               fmt::format("{:.3f}", 1e-6 * light.rays()), fmt::format("{:.2f}", light.fill_seconds),
               fmt::format("{:.2f}", light.late_seconds), fmt::format("{:.3f}", light.lookup_seconds),
               fmt::format("{:.2f}",
                           1e6 * light.lookup_seconds / static_cast<double>(std::max<std::size_t>(1, light.lookups))),
               fmt::format("{:.2e}", error.relative_mse - error.noise_mse),
               fmt::format("{:.2e}", error.relative_mse_most - error.noise_mse),
               fmt::format("{:+.2f}", 100.0 * error.bias), fmt::format("{:.3f}", error.percent_beyond(1.0)),
               fmt::format("{:.3f}", error.percent_beyond(4.0)), fmt::format("{:.1f}", error.worst())});
}

void run_cache(const CacheOptions& options) {
    const StudyOptions& study = options.study;
    const Scene scene = load_scene(study.scene);
    RenderSettings settings = study_settings(scene, study.scene, study);
    Sequence viewer = make_vision_sequence(scene, settings, Guide::spatial, &thesis_vision());
    const FrameVision vision = compute_vision(viewer, options.frame);
    settings.perception.guide = Guide::none;
    const Sequence sequence(scene, settings);
    const StudyFrame frame(sequence, settings, options.frame);
    const PixelGrid& grid = options.reference.grid;
    const ReferenceLight reference =
        load_or_gather_reference(frame, settings, study.scene, options.reference, study.quiet);
    const LightError noise =
        measure_light(Image<float>(settings.width, settings.height), reference, grid, vision.threshold);
    fmt::print(
        "{}, frame {}, {}, gather {}, {} threads; reference: {} rays at each of {} pixels, one of every {}x{}; its "
        "noise: relative MSE {:.1e}, 99 % of "
        "the pixels within {:.2g} thresholds\n\n",
        study.scene, options.frame, study.size, study.gather, thread_count(), options.reference.strata, noise.pixels,
        grid.step, grid.step, noise.noise_mse, noise.noise_percentile_99);
    const StudyTable table(
        {"accuracy", "records", "late", "rays (M)", "fill (s)", "late (s)", "look-ups (s)", "us each", "relative MSE",
         "without .1 %", "bias (%)", "beyond (%)", "beyond 4 (%)", "worst"},
        0, options.markdown);
    for (const std::string& text : options.accuracies) {
        const Result result =
            run_accuracy(frame, settings, parse_value<double>(text, "--accuracies"), reference, grid, vision);
        print_row(table, text, result);
        if (text == options.pictured) write_sheet(study.picture, make_panels(text, result, reference, grid), 4, 512);
    }
    if (options.pictured.empty()) return;
    fmt::print("\nThe picture: {}\n", study.picture);
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Prints a table of the irradiance cache at several accuracies: records, gather and shadow rays, seconds of "
        "processor time, and the error of the indirect light against dense gathers, relative and in thresholds of a "
        "viewer. The reference's noise is subtracted from the relative MSE. 'late' values are gathered for one pixel "
        "alone, where shading finds no record."};
    aleph::CacheOptions options;
    aleph::add_scene_option(app, options.study);
    aleph::add_study_options(app, options.study);
    aleph::add_quiet_option(app, options.study);
    aleph::add_value(app, "--frame", options.frame, "which frame");
    app.add_option("--accuracies", options.accuracies, "accuracies to compare")->delimiter(',')->capture_default_str();
    aleph::add_reference_options(app, options.reference);
    app.add_option("--pictured", options.pictured,
                   "the accuracy, one of --accuracies, that the picture shows; none: no picture");
    app.add_flag("--markdown", options.markdown, "print the table as Markdown");
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_cache(options); });
}
