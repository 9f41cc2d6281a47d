#include "render/time/cache_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/scene/scene_hash.h"
#include "render/pixels/frame_checkpoint.h"

namespace aleph {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view magic = "alephL2\n";
static_assert(std::is_trivially_copyable_v<IrradianceRecord>);

/// They change how records are read, not the records.
const std::set<std::string> reading_settings{"light_samples"};

bool is_fingerprint(const Json& json) {
    if (!json.is_object() || !json.contains("settings") || !json["settings"].is_object()) return false;
    return std::ranges::all_of(json["settings"], [](const Json& value) { return value.is_string(); }) &&
           json.contains("build") && json.contains("scene");
}

/// Describes the difference between a file's fingerprint and the one that is wanted; empty if there is none.
std::string find_difference(const Json& found, const Fingerprint& wanted) {
    if (found["build"] != wanted.build) return "it was written by another build of aleph";
    for (const auto& [key, value] : wanted.settings) {
        const std::string here = setting_text(value), there = found["settings"].value(key, "not set");
        if (here != there) return fmt::format("its setting {} is {}, here {}", key, printable(there), printable(here));
    }
    if (found["scene"] != wanted.scene) return "it belongs to another scene, or the scene has changed";
    return {};
}

[[noreturn]] void refuse_damaged(const std::string& file) {
    throw InputError(file, "", "the cache file is damaged or not complete");
}

}  // namespace

Fingerprint make_cache_fingerprint(const Scene& scene, const RenderSettings& settings,
                                   const std::vector<CameraShot>& shots) {
    Fingerprint fingerprint = make_fingerprint(scene, settings, shots);
    std::erase_if(fingerprint.settings, [](const auto& setting) { return reading_settings.contains(setting.first); });
    return fingerprint;
}

void write_cache_file(const std::filesystem::path& path, const Fingerprint& fingerprint, const ShotRecords& keyframes) {
    ByteWriter out;
    out.add_text(format_fingerprint(fingerprint));
    out.add(std::uint64_t{sizeof(IrradianceRecord)});
    out.add(std::uint64_t{keyframes.size()});
    for (const auto& [frame, records] : keyframes) {
        out.add(frame);
        out.add(records.seen);
        out.add(records.further);
    }
    std::string text = std::string(magic) + out.take();
    text += hash_bytes(text);
    write_file(path, text);
}

ShotRecords read_cache_file(const std::filesystem::path& path, const Fingerprint& fingerprint) {
    if (!std::filesystem::exists(path)) return {};
    const std::string file = path.string();
    const Bytes bytes = read_regular_file(path, file, "");
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!all.starts_with(magic)) throw InputError(file, "", "this is not a cache file of aleph");
    constexpr std::size_t digest_size = 40;
    if (all.size() < magic.size() + digest_size ||
        hash_bytes(all.substr(0, all.size() - digest_size)) != all.substr(all.size() - digest_size)) {
        refuse_damaged(file);
    }
    ByteReader in(all.substr(magic.size(), all.size() - magic.size() - digest_size));
    const Json found = Json::parse(in.read_text(), nullptr, false);
    if (!is_fingerprint(found)) refuse_damaged(file);
    const std::string difference = find_difference(found, fingerprint);
    if (!difference.empty()) throw InputError(file, "", "the cache file cannot be used: " + difference);
    if (in.read<std::uint64_t>() != sizeof(IrradianceRecord)) refuse_damaged(file);
    ShotRecords keyframes;
    const auto count = in.read<std::uint64_t>();
    for (std::uint64_t i = 0; i < count && in.is_good(); ++i) {
        const auto frame = in.read<std::int64_t>();
        KeyframeRecords& records = keyframes[frame];
        records.seen = in.read_all<IrradianceRecord>();
        records.further = in.read_all<IrradianceRecord>();
    }
    if (!in.is_good() || !in.at_end()) refuse_damaged(file);
    return keyframes;
}

}  // namespace aleph
