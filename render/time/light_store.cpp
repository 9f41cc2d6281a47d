#include "render/time/light_store.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "engine/base/errors.h"
#include "engine/scene/scene_hash.h"

namespace aleph {

namespace {

bool means_folder(const std::filesystem::path& path) {
    std::error_code ignored;
    return !path.has_filename() || std::filesystem::is_directory(path, ignored);
}

}  // namespace

LightStore::LightStore(std::filesystem::path path, Fingerprint fingerprint)
    : path_(std::move(path)), fingerprint_(std::move(fingerprint)), is_folder_(means_folder(path_)) {
    if (!is_folder_) {
        records_ = read_cache_file(path_, fingerprint_);
        return;
    }
    std::error_code error;
    std::filesystem::create_directories(path_, error);
    if (error) throw OutputError(printable(path_.string(), 4096), "cannot create the folder: " + error.message());
}

std::filesystem::path LightStore::file_of(std::int64_t keyframe) const {
    return path_ / fmt::format("{}.{}.light", hash_bytes(format_fingerprint(fingerprint_)).substr(0, 16), keyframe);
}

std::optional<KeyframeRecords> LightStore::find(std::int64_t keyframe) const {
    const ShotRecords read = is_folder_ ? read_cache_file(file_of(keyframe), fingerprint_) : ShotRecords();
    const ShotRecords& known = is_folder_ ? read : records_;
    const auto found = known.find(keyframe);
    return found == known.end() ? std::nullopt : std::optional(found->second);
}

void LightStore::keep(std::int64_t keyframe, const KeyframeRecords& records) {
    if (is_folder_) {
        write_cache_file(file_of(keyframe), fingerprint_, {{keyframe, records}});
        return;
    }
    records_[keyframe] = records;
    changed_ = true;
}

void LightStore::save() {
    if (is_folder_ || (!changed_ && std::filesystem::exists(path_))) return;
    write_cache_file(path_, fingerprint_, records_);
    changed_ = false;
}

}  // namespace aleph
