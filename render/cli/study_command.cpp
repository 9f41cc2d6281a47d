// `aleph study`: what settings cost, and what error they leave.

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <ranges>

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/parallel.h"
#include "engine/pose/pose.h"
#include "perception/vision/vision_model.h"
#include "render/cli/commands.h"
#include "render/cli/scene_options.h"
#include "render/cli/study_output.h"
#include "render/cli/support/options.h"
#include "render/cli/support/output_path.h"
#include "render/cli/support/progress.h"
#include "render/cli/support/render_signals.h"
#include "render/settings/frame_pattern.h"
#include "render/settings/setting_table.h"
#include "render/study/effects_ledger.h"
#include "render/study/pages/pages.h"
#include "render/study/prepared_study.h"
#include "render/study/reference_picture.h"
#include "render/study/search_study.h"
#include "render/study/study.h"

namespace aleph {

namespace {

struct StudyCommandOptions {
    std::string file, frames, size, output, part, progress = "auto";
    std::vector<std::string> sweeps, sets, viewers, judges, pictures;
    int passes = 0, spp = 0, repeats = 0, seeds = 0, threads = 0, candidates = 0;
    bool effects = false, search = false, quiet = false, markdown = false, status = false;
    StudyExtras extras;
};

/// The parts before and behind '='.
/// @param expected  in messages
std::pair<std::string, std::string> split_named(const std::string& text, const char* option, const char* expected) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
        throw InputError("", option, fmt::format("{}: expected {}", printable(text), expected));
    return {text.substr(0, equals), text.substr(equals + 1)};
}

/// "error=.5,1,2"
StudyAxis parse_sweep(const std::string& text) {
    const auto [key, values] = split_named(text, "--sweep", "KEY=VALUE,VALUE,...");
    StudyAxis axis{key, {}};
    for (const auto& part : std::views::split(values, ',')) {
        SettingMap value;
        parse_setting(fmt::format("{}={}", key, std::string_view(part.begin(), part.end())), value);
        if (!find_noise(value, "--sweep")) check_settings(value, "--sweep");
        axis.values.push_back(value.begin()->second);
    }
    return axis;
}

/// "castle=folder", or for one variant "castle=maps.####.exr"
StudyJudge parse_judge(const std::string& text) {
    const auto [name, folder] = split_named(text, "--judge", "NAME=FOLDER or NAME=maps.####.exr");
    StudyJudge judge{name, folder};
    if (find_number_field(judge.folder.filename().string(), "--judge")) {
        judge.frames = find_frame_files(judge.folder.string(), "--judge");
        return judge;
    }
    if (!std::filesystem::is_directory(judge.folder))
        throw InputError(judge.folder.string(), "--judge", "there is no such folder");
    return judge;
}

/// "other=other.####.exr"
StudyVariant parse_pictures(const std::string& text) {
    const auto [name, pattern] = split_named(text, "--pictures", "NAME=other.####.exr");
    return {name, {}, find_frame_files(pattern, "--pictures")};
}

/// A model of vision by its name, on a display that holds its frames.
StudyViewer make_viewer(const std::string& vision) {
    StudyViewer viewer{vision, {{"vision", vision}}};
    if (find_vision(vision)->uses_persistence()) viewer.settings["viewing.persistence"] = 1.0;
    return viewer;
}

/// The study of a file, or that of the sweeps of a scene.
Study make_study(const StudyCommandOptions& options) {
    Study study;
    if (is_study(options.file)) {
        study = load_study(options.file);
    } else {
        study.scenes.push_back({options.file, ""});
        study.title = fmt::format("{}: what accuracy costs in time", printable(name_scene(options.file)));
        study.settings["size"] = std::string("320x240");
        study.viewers.emplace_back();
        if (options.search) study.settings["bounces"] = 8.0;  // about all of the light, as the reference has it
    }
    for (const std::string& text : options.sweeps) {
        StudyAxis axis = parse_sweep(text);
        std::erase_if(study.sweep, [&](const StudyAxis& other) { return other.setting == axis.setting; });
        study.sweep.push_back(std::move(axis));
    }
    for (const std::string& text : options.pictures) study.variants.push_back(parse_pictures(text));
    study.effects = study.effects || options.effects;
    if (options.search && !study.search) study.search = default_search();
    if (options.candidates > 0) {
        if (!study.search) throw InputError("", "--candidates", "nothing is searched: add --search");
        study.search->candidates = options.candidates;
    }
    if (study.sweep.empty() && study.variants.empty() && !study.search && !study.effects) {
        throw InputError(options.file, "--sweep",
                         "nothing to compare: name the settings, such as --sweep error=.5,1,2,4 --sweep "
                         "guide=none,saliency, or --effects");
    }
    return study;
}

/// @throws InputError for a search, whose runs are not known before it ends
void refuse_search(const PreparedStudy& prepared, const char* option) {
    if (prepared.study.search)
        throw InputError("", option, "a search decides by what it has measured; its runs are not known before");
}

/// "3/8": the third of eight.
StudyPart parse_part(const std::string& text, const PreparedStudy& prepared) {
    refuse_search(prepared, "--shard");
    const std::size_t slash = std::min(text.find('/'), text.size());
    const int index = parse_value<int>(text.substr(0, slash), "--shard");
    const int count = slash < text.size() ? parse_value<int>(text.substr(slash + 1), "--shard") : 0;
    if (index < 1 || index > count)
        throw InputError("", "--shard", fmt::format("'{}': expected such as 3/8, the third of eight", printable(text)));
    return {static_cast<std::size_t>(index - 1), static_cast<std::size_t>(count)};
}

/// @throws InputError for numbers that are out of range; 0 stands for the study's own
void check_numbers(const StudyCommandOptions& options) {
    const auto check = [](const char* name, int value, int most) {
        if (value < 0 || value > most)
            throw InputError("", name, fmt::format("{}: expected 0 (the study's own) to {}", value, most));
    };
    check("--reference-passes", options.passes, 4096);
    check("--reference-spp", options.spp, 65536);
    check("--repeats", options.repeats, 1000);
    check("--seeds", options.seeds, 1000);
    check("--candidates", options.candidates, 10000);
}

void override_study(const StudyCommandOptions& options, Study& study) {
    if (!options.frames.empty()) {
        for (StudyScene& scene : study.scenes) scene.frames = options.frames;
    }
    if (!options.size.empty()) {
        RenderSettings checked;
        apply_given(checked, {{"size", options.size}});
        study.settings["size"] = options.size;
    }
    SettingMap given;
    for (const std::string& set : options.sets) parse_setting(set, given);
    check_settings(given, "--set");
    given.merge(study.settings);
    study.settings = std::move(given);
    if (options.passes > 0) study.reference.passes = options.passes;
    if (options.spp > 0) study.reference.spp = options.spp;
    if (options.repeats > 0) study.runs.repeats = options.repeats;
    if (options.seeds > 0) {
        study.runs.seeds.clear();
        for (int seed = 0; seed < options.seeds; ++seed) study.runs.seeds.push_back(static_cast<std::uint32_t>(seed));
    }
    if (options.viewers.empty()) return;
    study.viewers.clear();
    for (const std::string& viewer : options.viewers) study.viewers.push_back(make_viewer(viewer));
}

/// Prints how much of the study its folder has. @return the exit code
int print_count(const PreparedStudy& prepared, const std::filesystem::path& folder) {
    refuse_search(prepared, "--status");
    const StudyCount count = count_finished(prepared, folder);
    std::cout << fmt::format("references: {} of {} finished\nruns: {} of {} finished\n", count.finished_references,
                             count.references, count.finished_runs, count.runs);
    return count.is_finished() ? exit_done : exit_failed;
}

int run(const StudyCommandOptions& options) {
    check_threads(options.threads);
    check_numbers(options);
    const ThreadLimit limit(find_threads(options.threads));
    const RenderSignals signals;
    const ReadFiles read;
    Study study = make_study(options);
    override_study(options, study);
    const PreparedStudy prepared = prepare_study(std::move(study));
    std::vector<StudyJudge> judges;
    for (const std::string& judge : options.judges) judges.push_back(parse_judge(judge));
    for (const std::string& variant : options.extras.errors) check_variant_name(prepared, variant);
    for (const PreparedStudyScene& scene : prepared.scenes) {
        if (options.quiet) break;
        print_warnings(scene.scene.source.warnings);
        warn_of_frames_outside(scene.frames, frame_range(scene.scene));
    }
    const std::filesystem::path folder =
        options.output.empty() ? study_folder(options.file) : std::filesystem::path(options.output);
    if (options.status) return print_count(prepared, folder);
    std::optional<Progress> progress(std::in_place, "study", 1.0, progress_look(options.quiet, options.progress));
    const auto show = [&](double share, const std::string& what) {
        signals.stop_if_asked(": finished passes and runs are kept; the same command goes on", true);
        progress->update(share, what);
    };
    if (!options.part.empty()) {
        make_part(prepared, folder, parse_part(options.part, prepared), show);
        return exit_done;
    }
    refuse_overwriting(read.paths(), study_files(folder));
    StudyResults results =
        prepared.study.search ? search_study(prepared, folder, show) : run_study(prepared, folder, show);
    results.judges = judges;
    progress.reset();
    if (prepared.study.search)
        print_search(prepared, results, options.markdown, std::cout);
    else
        print_study(prepared, results, options.markdown, std::cout);
    if (prepared.study.effects) print_ledger(make_ledger(prepared, results), options.markdown, std::cout);
    const StudyContext context{study_command_line(), study_date(), thread_count(), folder};
    write_study(prepared, results, context, options.extras, options.quiet);
    return exit_done;
}

void add_options(CLI::App& study, StudyCommandOptions& options) {
    add_text(study, "study", "FILE|SCENE", options.file,
             "study file (.json), or a scene with --sweep, --effects or --search")
        ->required();
    add_text(study, "--sweep", "KEY=A,B,...", options.sweeps,
             "a setting and its values; every combination of several sweeps is a variant. Alone, noise or "
             "zero_mean_noise: the reference with noise of so many visible thresholds")
        ->allow_extra_args(false);
    study.add_flag("--effects", options.effects,
                   "also render without each effect that the scene calls for, in turn, and tell what each costs and in "
                   "how many pixels a viewer would miss it; errors.jpg shows where");
    study.add_flag("--search", options.search,
                   "also search, for each scene, the fixed settings that cost least for what a viewer sees, and tell "
                   "what they take to show as little as each variant");
    add_value(study, "--candidates", options.candidates,
              "settings that the search tries in its first round; 0: the study's, or 48");
    add_text(study, "--frames", "LIST", options.frames,
             "frames, such as 20,60; default: the study's, or the middle of the shot");
    add_text(study, "--size", "WIDTHxHEIGHT", options.size, "of the frames; default: the study's, or 320x240");
    add_text(study, "--set", "KEY=VALUE", options.sets, "a setting of every variant and of the reference")
        ->allow_extra_args(false);
    add_value(study, "--reference-passes", options.passes,
              "renderings that the reference is the mean of, at least 2; 0: the study's, or 4");
    add_value(study, "--reference-spp", options.spp, "samples per pixel of each; 0: the study's, or 32");
    add_value(study, "--repeats", options.repeats, "renderings with equal random numbers; 0: the study's, or 1");
    add_value(study, "--seeds", options.seeds, "renderings with different ones; 0: the study's, or 1");
    study
        .add_option("--viewers", options.viewers,
                    "models of vision that judge, such as thesis,castle, on a display that holds its frames")
        ->delimiter(',')
        ->check(CLI::IsMember(std::ranges::find(setting_table(), "vision", &Setting::key)->choices));
    add_text(study, "--judge", "NAME=FOLDER", options.judges,
             "maps of visible differences by another program, 1 where a difference is just visible: for each picture "
             "that study.json names, a file of the same name in this folder, or for a study of one variant files by "
             "frame, NAME=maps.####.exr; the page shows where they and our thresholds disagree")
        ->allow_extra_args(false);
    add_text(study, "--pictures", "NAME=other.####.exr", options.pictures,
             "a variant that another program made: frames of the scene, of the study's size, with the exposure that "
             "`aleph explain` prints; its errors are measured, and no costs")
        ->allow_extra_args(false);
    add_text(study, "-o,--output", "FOLDER", options.output, "folder of the results; default: NAME-study");
    add_value(study, "-t,--threads", options.threads,
              "number of threads, 0 to 4096; 0: all processors, or those of a Slurm task (SLURM_CPUS_PER_TASK)");
    study.add_flag(
        "--viewer-test", options.extras.viewer_test,
        "also write viewer-test.html: a test in which viewers say which of two sequences had the errors, the reference "
        "or a variant; several consecutive --frames make sequences. It pools the results of several viewers");
    add_text(study, "--errors", "VARIANT", options.extras.errors,
             "also write errors.jpg: where the errors of this variant lie, in visible thresholds of every viewer; may "
             "be given several times, for variants side by side")
        ->allow_extra_args(false);
    add_text(study, "--shard", "N/M", options.part,
             "only make every M-th reference and run, from the N-th on, and compare nothing: several machines share a "
             "study so, which the same command without it then finishes, with as many threads");
    study.add_flag("--status", options.status,
                   "only count the references and runs that are finished; exit code 1 if some are missing");
    study.add_flag("--markdown", options.markdown, "print the table as Markdown");
    study.add_flag("-q,--quiet", options.quiet, "print no progress and no list of files");
    add_progress_form(study, options.progress);
}

}  // namespace

void add_study_command(CLI::App& app, Command& command) {
    CLI::App* study = app.add_subcommand("study", "measure what settings cost in time, and what error they leave");
    const auto options = std::make_shared<StudyCommandOptions>();
    add_options(*study, *options);
    study->footer(
        "Every variant is rendered and compared with a reference, in units of what a viewer just sees. The folder gets "
        "study.json and study.csv with all figures, and report.html, a page to look at error against time, the frames "
        "and their maps. Finished passes of references and finished runs are kept there: the same "
        "command goes on with a study that was stopped. SIGTERM and SIGINT stop it with exit code 75.\n"
        "Seconds are of a processor. --repeats and --seeds give times and errors their uncertainty; two seeds of "
        "consecutive frames tell how much flickers.\n"
        "--search finds what fixed settings can do at best, a fair opponent for --error: it renders combinations of "
        "guide, adapter, accuracy, gather, spp, light_samples and light_step in small, keeps the better half by "
        "seconds and by what is seen, and so on, and renders the last of them as large as the variants. A scene has 8 "
        "bounces then, unless --set says otherwise. Measured seconds decide: let nothing else run.\n\n"
        "Examples:\n"
        "  aleph study scenes/pool/scene.json --frames 20 --sweep error=.5,1,2,4 --sweep guide=none,saliency\n"
        "  aleph study scenes/cornell/scene.json --sweep accuracy=.05,.15,.5 --repeats 3\n"
        "  aleph study scenes/pool/scene.json --frames 10-39 --sweep noise=0,.5,1,2 --viewer-test\n"
        "  aleph study scenes/pool/scene.json --frames 20-29 --sweep error=1,2 --seeds 2\n"
        "  aleph study scenes/pool/scene.json --frames 20 --set error=1 --effects\n"
        "  aleph study scenes/pool/scene.json --frames 18-23 --sweep error=.5,1,2 --search\n"
        "  aleph study scenes/studies/pool.json -o out/pool");
    study->callback([options, &command] { command = [options] { return run(*options); }; });
}

}  // namespace aleph
