#include "render/time/cache_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/scene/scene_hash.h"

namespace aleph {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view magic = "alephL1\n";
static_assert(std::is_trivially_copyable_v<IrradianceRecord>);

/// They change how records are read, not the records.
const std::set<std::string> reading_settings{"light_samples", "plan", "force"};

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

class Writer {
  public:
    void bytes(const void* data, std::size_t size) { text_.append(static_cast<const char*>(data), size); }
    template <class T>
    void value(const T& v) {
        bytes(&v, sizeof v);
    }
    std::string finish() {
        const std::string digest = hash_bytes(text_);
        return std::move(text_) + digest;
    }

  private:
    std::string text_;
};

class Reader {
  public:
    Reader(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

    std::string_view bytes(std::uint64_t size) {
        if (size > text_.size()) damaged();
        const std::string_view found = text_.substr(0, size);
        text_.remove_prefix(size);
        return found;
    }
    template <class T>
    T value() {
        T v;
        std::memcpy(&v, bytes(sizeof v).data(), sizeof v);
        return v;
    }
    std::vector<IrradianceRecord> records() {
        const auto count = value<std::uint64_t>();
        if (count > text_.size() / sizeof(IrradianceRecord)) damaged();
        std::vector<IrradianceRecord> found(count);
        const std::string_view data = bytes(count * sizeof(IrradianceRecord));
        if (count > 0) std::memcpy(found.data(), data.data(), data.size());
        return found;
    }
    bool at_end() const { return text_.empty(); }
    [[noreturn]] void damaged() const { throw InputError(file_, "", "the cache file is damaged or not complete"); }

  private:
    std::string_view text_;
    std::string file_;
};

}  // namespace

Fingerprint make_cache_fingerprint(const Scene& scene, const RenderSettings& settings,
                                   const std::vector<CameraShot>& shots) {
    Fingerprint fingerprint = make_fingerprint(scene, settings, shots);
    std::erase_if(fingerprint.settings, [](const auto& setting) { return reading_settings.contains(setting.first); });
    return fingerprint;
}

void write_cache_file(const std::filesystem::path& path, const Fingerprint& fingerprint,
                      const KeyframeRecords& keyframes) {
    Writer out;
    const std::string text = format_fingerprint(fingerprint);
    out.bytes(magic.data(), magic.size());
    out.value(std::uint64_t{text.size()});
    out.bytes(text.data(), text.size());
    out.value(std::uint64_t{sizeof(IrradianceRecord)});
    out.value(std::uint64_t{keyframes.size()});
    for (const auto& [frame, records] : keyframes) {
        out.value(frame);
        out.value(std::uint64_t{records.size()});
        out.bytes(records.data(), records.size() * sizeof(IrradianceRecord));
    }
    write_file(path, out.finish());
}

KeyframeRecords read_cache_file(const std::filesystem::path& path, const Fingerprint& fingerprint) {
    if (!std::filesystem::exists(path)) return {};
    const std::string file = path.string();
    const Bytes bytes = read_regular_file(path, file, "");
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!all.starts_with(magic)) throw InputError(file, "", "this is not a cache file of aleph");
    constexpr std::size_t digest_size = 40;
    Reader in(all.substr(0, all.size() - std::min(all.size(), digest_size)), file);
    if (all.size() < magic.size() + digest_size ||
        hash_bytes(all.substr(0, all.size() - digest_size)) != all.substr(all.size() - digest_size)) {
        in.damaged();
    }
    in.bytes(magic.size());
    const Json found = Json::parse(in.bytes(in.value<std::uint64_t>()), nullptr, false);
    if (!is_fingerprint(found)) in.damaged();
    const std::string difference = find_difference(found, fingerprint);
    if (!difference.empty()) throw InputError(file, "", "the cache file cannot be used: " + difference);
    if (in.value<std::uint64_t>() != sizeof(IrradianceRecord)) in.damaged();
    KeyframeRecords keyframes;
    const auto count = in.value<std::uint64_t>();
    for (std::uint64_t i = 0; i < count; ++i) {
        const auto frame = in.value<std::int64_t>();
        keyframes[frame] = in.records();
    }
    if (!in.at_end()) in.damaged();
    return keyframes;
}

}  // namespace aleph
