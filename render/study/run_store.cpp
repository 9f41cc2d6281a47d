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

/// To and from JSON. Files of other builds of the program have other names (digest).
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FrameRun, frame, processor_seconds, wall_seconds, stages, rays, samples, records,
                                   plan)

namespace {

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
        nlohmann::json::parse(bytes.begin(), bytes.end()).at("frames").get_to(runs);
    } catch (const nlohmann::json::exception&) {
        throw InputError(path.string(), "",
                         "is no finished run of a study; remove it, and the study will make it again");
    }
    const bool complete =
        std::ranges::equal(runs, frames, {}, &FrameRun::frame) &&
        std::ranges::all_of(runs, [](const FrameRun& run) { return nlohmann::json::accept(run.plan); });
    return complete ? std::optional(std::move(runs)) : std::nullopt;
}

void RunStore::save(const RunName& name, const std::vector<FrameRun>& frames) const {
    const nlohmann::json run{{"scene", name.scene},
                             {"variant", name.variant},
                             {"seed", name.seed},
                             {"repeat", name.repeat},
                             {"frames", frames}};
    write_file(file(name), run.dump(1) + "\n");
}

}  // namespace aleph
