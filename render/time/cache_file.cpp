#include "render/time/cache_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <utility>

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

bool means_folder(const std::filesystem::path& path) {
    std::error_code ignored;
    return !path.has_filename() || std::filesystem::is_directory(path, ignored);
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
    remove_leftovers(path);
    write_file(path, seal(magic, out.take()));
}

ShotRecords read_cache_file(const std::filesystem::path& path, const Fingerprint& fingerprint) {
    if (!std::filesystem::exists(path)) return {};
    const std::string file = path.string();
    const Bytes bytes = read_regular_file(path, file, "");
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!all.starts_with(magic)) throw InputError(file, "", "this is not a cache file of aleph");
    const std::optional<std::string_view> content = unseal(magic, all);
    if (!content) refuse_damaged(file);
    ByteReader in(*content);
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

LightStore::LightStore(std::filesystem::path path, Fingerprint fingerprint)
    : path_(std::move(path)), fingerprint_(std::move(fingerprint)), is_folder_(means_folder(path_)) {
    if (!is_folder_) {
        records_ = read_cache_file(path_, fingerprint_);
        return;
    }
    create_folder(path_);
}

std::filesystem::path LightStore::file_of(std::int64_t keyframe) const {
    return path_ / fmt::format("{}.{}.light", hash_bytes(format_fingerprint(fingerprint_)).substr(0, 16), keyframe);
}

std::optional<KeyframeRecords> LightStore::find(std::int64_t keyframe) const {
    const ShotRecords read = is_folder_ ? read_cache_file(file_of(keyframe), fingerprint_) : ShotRecords();
    const ShotRecords& known = is_folder_ ? read : records_;
    const auto found = known.find(keyframe);
    if (found != known.end()) return found->second;
    if (!is_folder_) try_output(path_);  // before the keyframe is computed
    return std::nullopt;
}

void LightStore::keep(std::int64_t keyframe, const KeyframeRecords& records) {
    records_[keyframe] = records;
    changed_ = true;
    if (!is_folder_) return;
    try {
        save();
    } catch (const OutputError&) {  // the frame goes on; `save` tries again
    }
}

void LightStore::save() {
    if (is_folder_) {
        for (const auto& [keyframe, records] : records_)
            write_cache_file(file_of(keyframe), fingerprint_, {{keyframe, records}});
        records_.clear();
    } else if (changed_ || !std::filesystem::exists(path_)) {
        write_cache_file(path_, fingerprint_, records_);
    }
    changed_ = false;
}

}  // namespace aleph
