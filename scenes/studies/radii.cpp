// How far irradiance values may be used: published rules against the cache's own. Indirect light at the pixel centres
// of one frame against dense gathers with random numbers of their own. All rules take equally many rays per value.

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "engine/load/load_scene.h"
#include "render/cli/options.h"
#include "scenes/studies/reference_light.h"
#include "scenes/studies/ruled_light.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_table.h"

namespace aleph {

namespace {

struct RadiiOptions {
    StudyOptions study{.size = "160x120", .gather = 1024, .spp = 0};
    ReferenceOptions reference;
    std::vector<std::string> accuracies = {".4", ".2", ".1", ".05"};
    std::vector<std::string> split = {".8", ".4", ".2", ".1"};
    std::vector<std::string> nearest = {"4", "2", "1", ".5"};
    std::vector<std::string> bounds = {"1e-2", "1e-3", "1e-4", "1e-5", "1e-6"};
    int frame = 0;
    bool markdown = false;
};

struct Study {
    const StudyFrame& frame;
    const RenderSettings& settings;
    const ReferenceLight& reference;
    const PixelGrid& grid;
    const Image<float>& threshold;
    const StudyTable& table;
};

void add_row(const Study& study, const std::string& rule, const std::string& accuracy, const CachedLight& light) {
    const LightError error = measure_light(light.light, study.reference, study.grid, study.threshold);
    study.table.add({rule, accuracy, fmt::format("{}", light.record_count), fmt::format("{:.3f}", 1e-6 * light.rays()),
                     fmt::format("{:.2e}", error.relative_mse - error.noise_mse),
                     fmt::format("{:.2e}", error.relative_mse_most - error.noise_mse),
                     fmt::format("{:+.2f}", 100.0 * error.bias), fmt::format("{:.2f}", error.percent_beyond(1.0))});
}

void add_rule(const Study& study, const std::string& name, RadiusRule rule, const std::vector<std::string>& accuracies,
              const char* option) {
    for (const std::string& text : accuracies) {
        const double accuracy = parse_value<double>(text, option);
        add_row(study, name, text, compute_ruled_light(study.frame, study.settings, rule, accuracy));
    }
}

void add_own(const Study& study, const std::string& name, const std::vector<std::string>& accuracies, bool smooth) {
    for (const std::string& text : accuracies) {
        RenderSettings settings = study.settings;
        settings.accuracy = parse_value<double>(text, "--accuracies");
        validate(settings);
        const Image<float> alpha(settings.width, settings.height, static_cast<float>(settings.accuracy));
        add_row(study, name, text, compute_cached_light(study.frame, settings, alpha, smooth));
    }
}

void run_radii(const RadiiOptions& options) {
    const StudyOptions& study = options.study;
    const Scene scene = load_scene(study.scene);
    RenderSettings settings = study_settings(scene, study.scene, study);
    Sequence viewer = make_vision_sequence(scene, settings, Guide::spatial, &thesis_vision());
    const FrameVision vision = compute_vision(viewer, options.frame);
    settings.perception.guide = Guide::none;
    const Sequence sequence(scene, settings);
    const StudyFrame frame(sequence, settings, options.frame);
    const ReferenceLight reference =
        load_or_gather_reference(frame, settings, study.scene, options.reference, study.quiet);
    const LightError noise = measure_light(Image<float>(settings.width, settings.height), reference,
                                           options.reference.grid, vision.threshold);
    fmt::print(
        "{}, frame {}, {}, {} rays per value; reference: {} rays at each of {} pixels; its noise: relative MSE {:.1e}, "
        "99 % of the pixels within {:.2g} thresholds\n\n",
        study.scene, options.frame, study.size, study.gather, options.reference.strata, noise.pixels, noise.noise_mse,
        noise.noise_percentile_99);
    const StudyTable table(
        {"rule", "accuracy", "values", "rays (M)", "relative MSE", "without .1 %", "bias (%)", "beyond (%)"}, 1,
        options.markdown);
    const Study all{frame, settings, reference, options.reference.grid, vision.threshold, table};
    add_rule(all, "split sphere", RadiusRule::split_sphere, options.split, "--split");
    add_rule(all, "nearest, clamped", RadiusRule::nearest_clamped, options.nearest, "--nearest");
    add_own(all, "error-driven", options.accuracies, true);
    add_own(all, "error-driven, not averaged", options.accuracies, false);
    add_rule(all, "Hessian", RadiusRule::hessian, options.bounds, "--bounds");
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Prints a table of rules for the radii of irradiance values: split sphere (Ward 1988), nearest distance with "
        "neighbour clamping (Tabellion 2004, Krivanek 2006), the renderer's own, and Hessian (Schwarzhaupt 2012); each "
        "at several accuracies, with the error of the indirect light against dense gathers."};
    aleph::RadiiOptions options;
    aleph::add_scene_option(app, options.study);
    aleph::add_study_options(app, options.study);
    aleph::add_quiet_option(app, options.study);
    aleph::add_value(app, "--frame", options.frame, "which frame");
    const auto add_list = [&](const char* name, std::vector<std::string>& list, const char* help) {
        app.add_option(name, list, help)->delimiter(',')->capture_default_str();
    };
    add_list("--accuracies", options.accuracies, "of the renderer's own rule");
    add_list("--split", options.split, "accuracies of the split sphere");
    add_list("--nearest", options.nearest, "accuracies with the nearest distance");
    add_list("--bounds", options.bounds,
             "of the Hessian rule: relative error times area, over the scene's radius squared");
    aleph::add_reference_options(app, options.reference);
    app.add_flag("--markdown", options.markdown, "print the table as Markdown");
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_radii(options); });
}
