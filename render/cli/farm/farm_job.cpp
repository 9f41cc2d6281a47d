#include "render/cli/farm/farm_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <tuple>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "render/cli/support/options.h"
#include "render/settings/frame_list.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

using Json = nlohmann::ordered_json;

constexpr const char* job_file = "job.json";

/// Calls visit(object, key, field) for all that the file has of a job, in its order.
template <class Job, class Visit>
void visit_fields(Json& json, Job& job, const Visit& visit) {
    visit(json, "scheduler", job.scheduler);
    Json& resources = json["resources"];
    visit(resources, "time", job.resources.time);
    visit(resources, "partition", job.resources.partition);
    visit(resources, "memory", job.resources.memory);
    visit(resources, "cpus", job.resources.cpus);
    visit(resources, "hosts", job.resources.hosts);
    visit(resources, "jobs", job.resources.jobs);
    visit(json, "tasks", job.tasks);
    visit(json, "command", job.command);
    visit(json, "arguments", job.arguments);
    visit(json, "frames", job.frames);
    visit(json, "output", job.output);
    visit(json, "stats", job.stats);
    visit(json, "working", job.working);
    visit(json, "rounds", job.rounds);
}

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
    Json json;
    visit_fields(json, job, [](Json& object, const char* key, const auto& field) { object[key] = field; });
    try {
        write_file(job.folder / job_file, json.dump(2) + "\n");
    } catch (const Json::type_error&) {
        throw InputError(printable(job.folder.string(), 400), "", "a name or a path is not UTF-8");
    }
}

bool makes_the_same(const FarmJob& a, const FarmJob& b) {
    const auto work = [](const FarmJob& job) {
        return std::tie(job.command, job.arguments, job.frames, job.output, job.stats, job.working);
    };
    return work(a) == work(b);
}

FarmJob read_farm_job(const fs::path& folder) {
    fs::path file = folder / job_file;
    if (!fs::exists(file)) file = folder / "farm" / job_file;
    if (!fs::exists(file)) {
        throw InputError(printable(folder.string(), 400), "",
                         "there is no job of `aleph farm` in this folder; give the folder of its results");
    }
    const std::string text = read_text(file);
    FarmJob job;
    try {
        Json json = Json::parse(text);
        visit_fields(json, job, [](Json& object, const char* key, auto& field) { object.at(key).get_to(field); });
    } catch (const nlohmann::json::exception&) {
        throw InputError(file.string(), "", "this is not as `aleph farm` wrote it");
    }
    job.folder = fs::absolute(file).parent_path();
    return job;
}

}  // namespace aleph
