#include "render/study/run_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/scene/scene_hash.h"
#include "render/settings/fingerprint.h"

namespace aleph {

namespace {

using Json = nlohmann::ordered_json;

Json pairs_json(const std::vector<std::pair<std::string, double>>& pairs) {
    Json json = Json::object();
    for (const auto& [name, value] : pairs) json[name] = value;
    return json;
}

std::vector<std::pair<std::string, double>> read_pairs(const Json& json) {
    std::vector<std::pair<std::string, double>> pairs;
    for (const auto& [name, value] : json.items()) pairs.emplace_back(name, value.get<double>());
    return pairs;
}

Json to_json(const FrameRun& run) {
    return {{"frame", run.frame},
            {"processor_seconds", run.processor_seconds},
            {"wall_seconds", run.wall_seconds},
            {"stages", pairs_json(run.stages)},
            {"rays", pairs_json(run.rays)},
            {"samples", run.samples},
            {"records", run.records},
            {"plan", Json::parse(run.plan)}};
}

FrameRun read_frame(const Json& json) {
    return {json.at("frame").get<std::int64_t>(),  json.at("processor_seconds").get<double>(),
            json.at("wall_seconds").get<double>(), read_pairs(json.at("stages")),
            read_pairs(json.at("rays")),           json.at("samples").get<double>(),
            json.at("records").get<double>(),      json.at("plan").dump()};
}

/// Names of files, which variants may not fit.
std::string digest(const RunName& name) {
    return hash_bytes(fmt::format("{}\n{}\n{}\n{}", program_build(), name.identity, name.scene, name.seed))
        .substr(0, 16);
}

}  // namespace

RunStore::RunStore(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::error_code error;
    std::filesystem::create_directories(folder_ / "runs", error);
    if (error) throw OutputError((folder_ / "runs").string(), error.message());
}

std::filesystem::path RunStore::file(const RunName& name) const {
    return folder_ / "runs" / fmt::format("{}-{}.json", digest(name), name.repeat);
}

std::filesystem::path RunStore::picture(const RunName& name, std::int64_t frame) const {
    return folder_ / "runs" / fmt::format("{}-{}.exr", digest(name), frame);
}

std::optional<std::vector<FrameRun>> RunStore::find(const RunName& name, const std::vector<int>& frames) const {
    const std::filesystem::path path = file(name);
    if (!std::filesystem::exists(path)) return std::nullopt;
    for (const int frame : frames) {
        if (!std::filesystem::exists(picture(name, frame))) return std::nullopt;
    }
    const Bytes bytes = read_regular_file(path, path.string(), "");
    std::vector<FrameRun> runs;
    try {
        const Json json = Json::parse(bytes.begin(), bytes.end());
        for (const Json& frame : json.at("frames")) runs.push_back(read_frame(frame));
    } catch (const nlohmann::json::exception&) {
        throw InputError(path.string(), "",
                         "is no finished run of a study; remove it, and the study will make it again");
    }
    const bool complete = std::ranges::equal(runs, frames, {}, &FrameRun::frame);
    return complete ? std::optional(std::move(runs)) : std::nullopt;
}

void RunStore::save(const RunName& name, const std::vector<FrameRun>& frames) const {
    Json json{{"scene", name.scene}, {"variant", name.variant}, {"seed", name.seed}, {"repeat", name.repeat}};
    json["frames"] = Json::array();
    for (const FrameRun& frame : frames) json["frames"].push_back(to_json(frame));
    write_file(file(name), json.dump(1) + "\n");
}

}  // namespace aleph
