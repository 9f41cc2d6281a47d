// `aleph farm`: frames and studies divided into tasks for a scheduler.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <regex.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <ranges>
#include <tuple>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "render/cli/commands.h"
#include "render/cli/farm/farm_job.h"
#include "render/cli/study_output.h"
#include "render/cli/support/options.h"
#include "render/cli/support/output_path.h"
#include "render/settings/frame_list.h"
#include "render/study/study.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

constexpr int most_tasks = 100000;

struct FarmOptions {
    SceneOptions scene;
    std::string command = "render", cache, checkpoint;
    bool aovs = false, submit = false;
    int tasks = 0;
    FarmResources resources;
};

std::string this_program() {
    return fs::read_symlink("/proc/self/exe").string();
}

/// The options beside frames and files, as words of the command.
std::vector<std::string> list_arguments(const FarmOptions& options) {
    const SceneOptions& scene = options.scene;
    std::vector<std::string> words{scene.scene};
    const auto add = [&](const char* option, const std::string& value) {
        if (!value.empty()) words.insert(words.end(), {option, value});
    };
    add("--fps", scene.fps);
    add("--camera", scene.camera);
    add("--crop", scene.crop);
    if (scene.limits.memory != LoadLimits().memory) add("--load-memory", fmt::format("{}", scene.limits.memory >> 20));
    if (scene.threads > 0) add("--threads", fmt::format("{}", scene.threads));
    for (const auto& [key, value] : scene.settings) add("--set", key + "=" + setting_text(value));
    // A folder, in which tasks find the keyframes of each other.
    if (!options.cache.empty()) add("--cache", (fs::path(options.cache) / "").string());
    add("--checkpoint", options.checkpoint);
    if (options.aovs) words.push_back("--aovs");
    if (scene.importance) words.push_back("--importance");
    return words;
}

/// Refuses options that the command of the tasks does not have.
/// @throws InputError (the option)
void refuse_other_options(const FarmOptions& options, const std::string& command) {
    const SceneOptions& scene = options.scene;
    const std::tuple<const char*, bool, const char*> given[] = {
        {"--fps", !scene.fps.empty(), "render, maps"},
        {"--camera", !scene.camera.empty(), "render, maps"},
        {"--crop", !scene.crop.empty(), "render, maps"},
        {"--load-memory", scene.limits.memory != LoadLimits().memory, "render, maps"},
        {"--stats", !scene.stats.empty(), "render, maps"},
        {"--cache", !options.cache.empty(), "render"},
        {"--aovs", options.aovs, "render"},
        {"--checkpoint", !options.checkpoint.empty(), "render"},
        {"--importance", scene.importance, "maps"},
    };
    for (const auto& [option, is_given, commands] : given) {
        if (is_given && std::string_view(commands).find(command) == std::string_view::npos)
            throw InputError("", option, fmt::format("`aleph {}` has no such option, only {}", command, commands));
    }
}

/// A list has one task on each line, and a comment of Slurm's ends with its line.
/// @throws InputError
void refuse_line_breaks(const FarmJob& job) {
    std::vector<std::string> words = job.arguments;
    words.insert(words.end(), {job.output, job.working.string(), job.folder.string()});
    for (const std::string& word : words) {
        if (word.find('\n') != std::string::npos) throw InputError("", printable(word, 400), "a name has a line break");
    }
}

int run_words(const std::vector<std::string>& words) {
    std::cout.flush();
    const int status = std::system(quote_words(words).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : static_cast<int>(exit_failed);
}

/// The parts of a study: of each task what --shard takes.
std::vector<std::string> divide_study(int tasks) {
    std::vector<std::string> parts;
    for (int i = 1; i <= tasks; ++i) parts.push_back(fmt::format("{}/{}", i, tasks));
    return parts;
}

/// The command of a job's study, with the threads of its tasks: runs are found by these.
std::vector<std::string> study_words(const FarmJob& job) {
    std::vector<std::string> words{this_program(), "study"};
    words.insert(words.end(), job.arguments.begin(), job.arguments.end());
    words.insert(words.end(), {"-o", job.output});
    if (job.resources.cpus > 0 && std::ranges::find(words, "--threads") == words.end())
        words.insert(words.end(), {"--threads", fmt::format("{}", job.resources.cpus)});
    return words;
}

/// Counts what is finished of a job's study. @return the exit code, 1 if some is missing
int print_study_status(const FarmJob& job) {
    std::vector<std::string> words = study_words(job);
    words.push_back("--status");
    return run_words(words);
}

/// Returns whether the whole text is as the extended regular expression says. That of POSIX takes texts of any length,
/// and std::regex, which takes one more call for each character, does not.
bool matches(const std::string& text, const std::string& pattern) {
    regex_t compiled;
    const int failed = regcomp(&compiled, ("^" + pattern + "$").c_str(), REG_EXTENDED | REG_ICASE | REG_NOSUB);
    ALEPH_CHECK(failed == 0, pattern);
    const bool found = regexec(&compiled, text.c_str(), 0, nullptr, 0) == 0;
    regfree(&compiled);
    return found;
}

/// Requests that the scheduler would refuse, or misunderstand.
/// @throws InputError (the option)
void check_resources(const FarmResources& resources) {
    const auto require = [](bool good, const char* option, const std::string& given, const char* expected) {
        if (!good) throw InputError("", option, fmt::format("'{}': expected {}", printable(given), expected));
    };
    require(resources.time.empty() || matches(resources.time, "[0-9]+(-[0-9]+)?(:[0-9]+){0,2}"), "--time",
            resources.time,
            "MINUTES, MINUTES:SECONDS, HOURS:MINUTES:SECONDS, or DAYS-HOURS with :MINUTES and :SECONDS behind it");
    require(resources.memory.empty() || matches(resources.memory, "[0-9]+[KMGT]?"), "--memory", resources.memory,
            "a whole number of MB, or with K, M, G or T behind it, such as 4G");
    require(resources.cpus >= 0, "--cpus", fmt::format("{}", resources.cpus), "0 (the cluster's default) or more");
    require(resources.jobs >= 1, "--jobs", fmt::format("{}", resources.jobs), "1 or more");
    require(std::ranges::find(resources.hosts, "") == resources.hosts.end(), "--hosts",
            fmt::format("{}", fmt::join(resources.hosts, ",")), "names of hosts, such as one,two");
}

/// The parts of a study, or of the frames, with everything checked that a task would refuse.
std::vector<std::string> prepare_job(const FarmOptions& options, FarmJob& job) {
    job.output = options.scene.output;
    job.stats = options.scene.stats;
    job.working = fs::current_path();
    job.arguments = list_arguments(options);
    job.command = is_study(options.scene.scene) ? "study" : options.command;
    refuse_other_options(options, job.command);
    if (job.command == "study") {
        if (job.output.empty()) job.output = study_folder(options.scene.scene).string();
        if (!options.scene.frames.empty())
            job.arguments.insert(job.arguments.end(), {"--frames", options.scene.frames});
        job.folder = fs::absolute(job.output) / "farm";
        return divide_study(options.tasks);
    }
    if (job.output.empty()) throw InputError("", "--output", "name the files of the frames, or their folder");
    job.frames = options.scene.frames;
    const PreparedScene prepared = prepare_scene(parse_frame_command(job).options);
    const std::vector<fs::path> files = output_paths(job.output, prepared.name, prepared.frames);
    for (const fs::path& file : files) try_output(file);
    job.frames = format_frame_list(prepared.frames);
    job.folder = fs::absolute(files.front()).parent_path() / "farm";
    return divide_frames(prepared.frames, options.tasks);
}

int write_job(const FarmOptions& options, const std::string& scheduler) {
    if (options.tasks < 1 || options.tasks > most_tasks)
        throw InputError("", "--tasks", fmt::format("expected 1 to {}", most_tasks));
    check_resources(options.resources);
    FarmJob job;
    job.scheduler = scheduler;
    job.resources = options.resources;
    job.tasks = options.tasks;
    const std::vector<std::string> parts = prepare_job(options, job);
    refuse_line_breaks(job);
    try_output(job.folder / "job.json");
    if (fs::exists(job.folder / "job.json")) {
        const FarmJob there = read_farm_job(job.folder);
        if (!makes_the_same(there, job))
            throw OutputError(printable(job.folder.string(), 4096),
                              "this is the folder of another job, which is collated from it; choose another --output, "
                              "or remove it if that job is finished");
        job.rounds = there.rounds;
    }
    const fs::path submit = write_farm_scripts(job, parts, this_program());
    std::cout << fmt::format("{} tasks; {}\n", parts.size(), quote_words({"bash", submit.string()}));
    return options.submit ? run_words({"bash", submit.string()}) : static_cast<int>(exit_done);
}

int print_farm_status(const std::string& folder) {
    const FarmJob job = read_farm_job(folder);
    fs::current_path(job.working);
    if (job.command == "study") return print_study_status(job);
    const FarmStatus status = find_status(job, false);
    print_status(status, std::cout);
    return status.left().empty() ? exit_done : exit_failed;
}

/// Writes a round of tasks and submits it. @return the exit code
int submit_parts(FarmJob& job, const std::vector<std::string>& parts) {
    return run_words({"bash", write_farm_scripts(job, parts, this_program()).string()});
}

int collate(const std::string& folder, bool submit) {
    FarmJob job = read_farm_job(folder);
    fs::current_path(job.working);
    if (job.command == "study") {
        const int state = submit ? print_study_status(job) : static_cast<int>(exit_done);
        return state == exit_failed ? submit_parts(job, divide_study(job.tasks)) : run_words(study_words(job));
    }
    const FarmStatus status = find_status(job, true);
    print_status(status, std::cout);
    join_statistics(job, status);
    if (status.left().empty()) return exit_done;
    if (!submit) return exit_failed;
    return submit_parts(job, divide_frames(status.left(), job.tasks));
}

/// Told to all schedulers.
void add_job_options(CLI::App& app, FarmOptions& options) {
    add_scene_options(app, options.scene);
    app.get_option("scene")->description("scene file, or a study file (.json)");
    app.remove_option(app.get_option("--resume"));
    app.get_option("--output")
        ->description(
            "output files: name.####.exr or .png (#### is the frame number), or a folder, to be named; of a study: its "
            "folder, default: NAME-study");
    add_value(app, "--tasks", options.tasks, "tasks that the frames, or the runs of a study, are divided into")
        ->required();
    app.add_option("--command", options.command, "what makes the frames")
        ->check(CLI::IsMember({"render", "maps"}))
        ->default_str("render");
    app.add_flag("--aovs", options.aovs, "as of `aleph render`");
    app.add_flag("--importance", options.scene.importance, "as of `aleph maps`");
    add_text(app, "--cache", "FOLDER", options.cache, "as of `aleph render`; a folder");
    add_text(app, "--checkpoint", "SECONDS", options.checkpoint, "as of `aleph render`, for frames that take long");
    app.add_flag("--submit", options.submit, "run the script that submits the tasks, too");
}

void add_slurm(CLI::App& farm, Command& command) {
    CLI::App* slurm = farm.add_subcommand("slurm", "write an array of tasks for Slurm, and a job that collates them");
    const auto options = std::make_shared<FarmOptions>();
    add_job_options(*slurm, *options);
    FarmResources& resources = options->resources;
    add_text(*slurm, "--time", "TIME", resources.time, "time of a task, such as 2:00:00");
    add_text(*slurm, "--memory", "SIZE", resources.memory, "memory of a task, such as 4G");
    add_text(*slurm, "--partition", "NAME", resources.partition, "partition of the cluster");
    add_value(*slurm, "--cpus", resources.cpus, "processors of a task, which it uses all; 0: the cluster's default");
    slurm->footer(
        "The folder `farm` beside the frames gets plain scripts: task.1.sh runs a task, submit.1.sh submits all of "
        "them. A minute before its time is up Slurm tells a task to stop, and it exits with 75; where the cluster has "
        "RequeueExit=75 it then goes on by itself, elsewhere `aleph farm collate --submit` submits what is left. A "
        "task on a node that dies is begun again. Nothing that is finished is made twice.\n\n"
        "Examples:\n"
        "  aleph farm slurm scene.json --frames 0-749 --error 1 -o out/ --tasks 40 --time 2:00:00 --submit\n"
        "  aleph farm slurm scenes/studies/knob.json -o out/knob --tasks 8 --cpus 2");
    slurm->callback([options, &command] { command = [options] { return write_job(*options, "slurm"); }; });
}

void add_parallel(CLI::App& farm, Command& command) {
    CLI::App* parallel = farm.add_subcommand("parallel", "the same for GNU parallel, on this host or on several");
    const auto options = std::make_shared<FarmOptions>();
    add_job_options(*parallel, *options);
    const auto read_hosts = [&hosts = options->resources.hosts](const std::string& text) {
        hosts.clear();
        for (const auto& part : std::views::split(text, ',')) hosts.emplace_back(part.begin(), part.end());
    };
    parallel
        ->add_option_function<std::string>(
            "--hosts", read_hosts,
            "hosts, such as one,two, which have this program, the scene and the output under the same paths")
        ->type_name("HOST,...");
    add_value(*parallel, "--jobs", options->resources.jobs, "tasks at a time on each host");
    parallel->footer(
        "Examples:\n"
        "  aleph farm parallel scene.json --frames 0-749 --error 1 -o out/ --tasks 40 --hosts one,two --submit");
    parallel->callback([options, &command] { command = [options] { return write_job(*options, "parallel"); }; });
}

}  // namespace

void add_farm_command(CLI::App& app, Command& command) {
    CLI::App* farm = app.add_subcommand("farm", "divide frames or a study into tasks for several machines");
    farm->require_subcommand(1);
    add_slurm(*farm, command);
    add_parallel(*farm, command);
    const auto folder = std::make_shared<std::string>();
    const auto submit = std::make_shared<bool>(false);
    const auto add = [&](const char* name, const char* help) {
        CLI::App* sub = farm->add_subcommand(name, help);
        add_text(*sub, "folder", "FOLDER", *folder, "folder of the frames or of the study")->required();
        return sub;
    };
    add("status",
        "say which frames are finished, missing, damaged or of something else, or how many references and runs of a "
        "study are finished; exit code 1 if any is not finished")
        ->callback([folder, &command] { command = [folder] { return print_farm_status(*folder); }; });
    CLI::App* collated =
        add("collate", "the same, with every file decoded, and join the statistics; of a study: finish it");
    collated->add_flag("--submit", *submit,
                       "submit what is left again; of a study: where something is left, all parts");
    collated->callback(
        [folder, submit, &command] { command = [folder, submit] { return collate(*folder, *submit); }; });
    farm->footer(
        "The scheduler is the one that is there: Slurm, or GNU parallel. Files have the bytes that one machine would "
        "make, whatever the tasks.\n"
        "`aleph farm slurm --help` has examples.");
}

}  // namespace aleph
