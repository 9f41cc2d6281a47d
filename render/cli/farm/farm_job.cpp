#include "render/cli/farm/farm_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "render/settings/frame_list.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

using Json = nlohmann::ordered_json;

constexpr const char* job_file = "job.json";

}  // namespace

FrameCommand parse_frame_command(const FarmJob& job) {
    FrameCommand command;
    CLI::App app{"aleph"};
    add_scene_options(app, command.options);
    app.add_flag("--aovs", command.request.maps);
    app.add_flag("--importance", command.options.importance);
    app.add_option("--cache", command.cache);
    add_value(app, "--checkpoint", command.options.checkpoint, "");
    std::vector<std::string> words = job.arguments;
    words.insert(words.end(), {"-o", job.output});
    if (!job.frames.empty()) words.insert(words.end(), {"--frames", job.frames});
    std::ranges::reverse(words);  // CLI11 takes the last first
    app.parse(words);
    command.request.frame = job.command == "render";
    command.request.maps = command.request.maps || !command.request.frame;
    command.options.keeps_to_error = command.request.frame;
    command.options.resume = true;
    return command;
}

std::vector<std::string> divide_frames(const std::vector<int>& frames, int tasks) {
    const std::size_t count = std::clamp<std::size_t>(static_cast<std::size_t>(tasks), 1, frames.size());
    std::vector<std::string> chunks;
    for (std::size_t i = 0; i < count; ++i) {
        const auto at = [&](std::size_t k) {
            return frames.begin() + static_cast<std::ptrdiff_t>(k * frames.size() / count);
        };
        chunks.push_back(format_frame_list({at(i), at(i + 1)}));
    }
    return chunks;
}

void write_farm_job(const FarmJob& job) {
    const FarmResources& r = job.resources;
    const Json resources{{"time", r.time}, {"partition", r.partition}, {"memory", r.memory},
                         {"cpus", r.cpus}, {"hosts", r.hosts},         {"jobs", r.jobs}};
    const Json json{{"scheduler", job.scheduler}, {"resources", resources},     {"tasks", job.tasks},
                    {"command", job.command},     {"arguments", job.arguments}, {"frames", job.frames},
                    {"output", job.output},       {"stats", job.stats},         {"working", job.working.string()},
                    {"rounds", job.rounds}};
    try {
        write_file(job.folder / job_file, json.dump(2) + "\n");
    } catch (const Json::type_error&) {
        throw InputError(printable(job.folder.string(), 400), "", "a name or a path is not UTF-8");
    }
}

FarmJob read_farm_job(const fs::path& folder) {
    fs::path file = folder / job_file;
    if (!fs::exists(file)) file = folder / "farm" / job_file;
    if (!fs::exists(file)) {
        throw InputError(printable(folder.string(), 400), "",
                         "there is no job of `aleph farm` in this folder; give the folder of its results");
    }
    const Bytes bytes = read_regular_file(file, file.string(), "");
    FarmJob job;
    try {
        const Json json = Json::parse(bytes.begin(), bytes.end());
        json.at("scheduler").get_to(job.scheduler);
        json.at("tasks").get_to(job.tasks);
        const Json& resources = json.at("resources");
        FarmResources& r = job.resources;
        resources.at("time").get_to(r.time);
        resources.at("partition").get_to(r.partition);
        resources.at("memory").get_to(r.memory);
        resources.at("cpus").get_to(r.cpus);
        resources.at("hosts").get_to(r.hosts);
        resources.at("jobs").get_to(r.jobs);
        json.at("command").get_to(job.command);
        json.at("arguments").get_to(job.arguments);
        json.at("frames").get_to(job.frames);
        json.at("output").get_to(job.output);
        json.at("stats").get_to(job.stats);
        job.working = json.at("working").get<std::string>();
        json.at("rounds").get_to(job.rounds);
    } catch (const nlohmann::json::exception&) {
        throw InputError(file.string(), "", "this is not as `aleph farm` wrote it");
    }
    job.folder = fs::absolute(file).parent_path();
    return job;
}

}  // namespace aleph
