// What `--error` keeps of its promise, and what it saves: renderings with an asked error, with the other stopping rules
// and with fixed settings, judged by path-traced references in thresholds of the viewer.

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "engine/load/load_scene.h"
#include "render/cli/options.h"
#include "render/settings/frame_list.h"
#include "scenes/studies/error_report.h"
#include "scenes/studies/judged_frame.h"
#include "scenes/studies/study_options.h"

namespace aleph {

namespace {

struct ErrorOptions {
    StudyOptions study{.size = "320x240", .gather = 0, .spp = 0};
    ReferencePictureOptions reference;
    std::string frames = "0", report;
    std::vector<std::string> errors = {"1", "2"}, percents = {".5"}, rules, sets;
    std::vector<std::string> spps = {"1", "2", "4", "8", "16", "32", "64", "128"}, light_samples = {"4", "16", "64"},
                             accuracies = {".5", ".15"};
    int rule_spp = 512, repeats = 1, check_passes = 0;
    double most_seconds = 300.0;
    bool no_ladder = false, no_defaults = false, markdown = false;
};

JudgedFrame prepare(const Scene& scene, const RenderSettings& settings, int number, const ErrorOptions& options) {
    JudgedFrame frame = make_judged_frame(scene, settings, number, options.study.scene, options.reference,
                                          parse_values(options.errors, "--errors"), options.study.quiet);
    frame.repeats = options.repeats;
    return frame;
}

/// The reference against traced paths of its own; nothing if that is not asked for.
std::optional<LuminanceDifference> check_reference(const JudgedFrame& frame, const ErrorOptions& options) {
    if (options.check_passes == 0) return std::nullopt;
    ReferencePictureOptions paths = options.reference;
    paths.kind = "path";
    paths.passes = options.check_passes;
    const ChannelImage traced = load_judged_reference(frame.scene, frame.settings, frame.number, options.study.scene,
                                                      paths, options.study.quiet);
    return compare_luminance(frame.reference, traced, {});
}

/// The settings as they are, `--error` and the stopping rules.
void run_variants(ErrorStudy& study, const ErrorOptions& options, const StudyTable& table) {
    const JudgedFrame& frame = study.frame;
    const auto run = [&](const std::string& name, const RenderSettings& settings, double asked = 1.0) {
        study.runs.push_back(judge(frame, name, settings, asked));
        add_run(table, frame, study.runs.back());
    };
    if (!options.no_defaults) run("defaults", frame.settings);
    if (has_setting("error")) {
        for (const std::string& error : options.errors) {
            std::vector<std::string> sets = options.sets;
            sets.push_back("error=" + error);
            const double thresholds = frame.multiples[&error - options.errors.data()];
            run("--error " + error, with_settings(frame.settings, sets), thresholds);
            study.shares.push_back({frame.name,
                                    {thresholds, study.runs.back().percent_beyond(thresholds)},
                                    study.runs.back().name,
                                    study.runs.back().cost,
                                    {}});
        }
    }
    for (const std::string& rule : options.rules) {
        run("--sampling " + rule,
            with_settings(frame.settings, {"sampling=" + rule, fmt::format("spp={}", options.rule_spp)}));
    }
}

void run_ladder(ErrorStudy& study, const ErrorOptions& options, const StudyTable& table) {
    for (const std::string& percent : options.percents) {
        for (const double thresholds : study.frame.multiples) {
            study.shares.push_back(
                {study.frame.name, {thresholds, parse_value<double>(percent, "--percents")}, percent + " %", {}, {}});
        }
    }
    std::vector<ShareGoal> goals;
    for (const EqualShare& share : study.shares) goals.push_back(share.goal);
    const Ladder ladder{parse_values(options.spps, "--spps"), parse_values(options.light_samples, "--light-samples"),
                        parse_values(options.accuracies, "--accuracies"), options.most_seconds};
    const auto sides = climb(study.frame, ladder, goals, [&](const ErrorRun& run) {
        study.fixed.push_back(run);
        add_run(table, study.frame, run);
    });
    for (EqualShare& share : study.shares) share.fixed = find_best_fixed(sides, share.goal);
}

void run_errors(const ErrorOptions& options) {
    const Scene scene = load_scene(options.study.scene);
    const RenderSettings settings = judged_settings(scene, options.study.scene, options.study.size, options.sets);
    std::vector<ErrorStudy> studies;
    for (const int number : parse_frame_list(options.frames)) {
        JudgedFrame frame = prepare(scene, settings, number, options);
        const PictureError noise = measure_picture(frame.reference, frame.reference, frame.threshold, frame.multiples);
        const auto check = check_reference(frame, options);
        studies.push_back({std::move(frame), noise, check, {}, {}, {}});
    }
    fmt::print("{}, {}, thresholds of {}, {} bounces\n\nReferences; noise in thresholds:\n\n", options.study.scene,
               options.study.size, std::get<std::string>(setting_map(settings).at("vision")), settings.bounces);
    print_references(studies, options.markdown);
    if (!has_setting("error")) fmt::print("\nThis version has no setting `error`.\n");
    fmt::print("\nErrors in thresholds; seconds of a processor:\n\n");
    const StudyTable table = start_run_table(studies.front().frame.multiples, options.markdown);
    for (ErrorStudy& study : studies) {
        run_variants(study, options, table);
        if (!options.no_ladder) run_ladder(study, options, table);
        if (!options.report.empty()) write_report(options.report, studies);
    }
    fmt::print("\nSeconds of a processor by stage:\n\n");
    print_stages(studies, options.markdown);
    fmt::print(
        "\nThe program's own estimates, percent: pixels beyond; error over estimate; pixels beyond what 99.5 % should "
        "be "
        "within; samples of the 1 % with most; by their largest estimated cause, pixels beyond and samples:\n\n");
    print_claims(studies, options.markdown);
    if (options.no_ladder) return;
    fmt::print("\nSeconds of a processor at equal shares of pixels beyond:\n\n");
    print_shares(studies, options.markdown);
}

void add_error_options(CLI::App& app, ErrorOptions& options) {
    const auto add_list = [&](const char* name, std::vector<std::string>& values, const char* help) {
        app.add_option(name, values, help)->delimiter(',')->capture_default_str();
    };
    aleph::add_scene_option(app, options.study);
    app.add_option("--frames", options.frames, "frame numbers, such as 20,60 or 0-89x10")->capture_default_str();
    app.add_option("--size", options.study.size, "WIDTHxHEIGHT of the frames in pixels")->capture_default_str();
    add_value(app, "-t,--threads", options.study.threads, "number of threads; 0: all");
    add_quiet_option(app, options.study);
    add_reference_options(app, options.reference);
    add_value(app, "--check-passes", options.check_passes,
              "path-traced renderings with which the mean of a gathered reference is compared; 0: none");
    add_list("--errors", options.errors, "errors to ask for, and multiples of the threshold to measure");
    add_list("--rules", options.rules, "other values of the setting sampling to run");
    add_value(app, "--rule-spp", options.rule_spp, "most samples per pixel of these");
    add_list("--percents", options.percents,
             "percentages beyond that fixed settings are to reach, beside those measured");
    add_list("--spps", options.spps, "samples per pixel of fixed settings, ascending");
    add_list("--light-samples", options.light_samples, "light samples of fixed settings");
    add_list("--accuracies", options.accuracies, "accuracies of fixed settings");
    add_value(app, "--most-seconds", options.most_seconds, "processor seconds after which nothing dearer is tried");
    add_value(app, "--repeats", options.repeats, "renderings of each picture, of which the median of seconds counts");
    add_set_option(app, options.sets);
    app.add_option("--json", options.report, "file for all figures");
    app.add_flag("--no-ladder", options.no_ladder, "no fixed settings");
    app.add_flag("--no-defaults", options.no_defaults, "do not render with the settings as they are");
    app.add_flag("--markdown", options.markdown, "print the tables as Markdown");
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Measures pictures that were asked for an error, in thresholds of the viewer, against path-traced references: "
        "the share of pixels beyond, the median, rays and seconds by stage, beside the best fixed settings with the "
        "same share. Seconds are of a processor."};
    aleph::ErrorOptions options;
    aleph::add_error_options(app, options);
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_errors(options); });
}
