#include "render/settings/fingerprint.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "engine/base/files.h"
#include "engine/scene/scene_hash.h"

namespace aleph {

const std::string& program_build() {
    static const std::string build = [] {
        const Bytes bytes = read_regular_file(code_file(), "this program", "");
        return std::string(ALEPH_VERSION " ") + hash_bytes({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }();
    return build;
}

Fingerprint make_fingerprint(const Scene& scene, const RenderSettings& settings, const std::vector<CameraShot>& shots) {
    Fingerprint fingerprint{program_build(), hash_scene(scene), setting_map(settings)};
    for (const CameraShot& shot : shots)
        fingerprint.scene += fmt::format(" camera {} from {}", shot.camera, shot.first);
    return fingerprint;
}

std::string format_fingerprint(const Fingerprint& fingerprint) {
    nlohmann::ordered_json json{
        {"build", fingerprint.build}, {"scene", fingerprint.scene}, {"settings", nlohmann::ordered_json::object()}};
    for (const auto& [key, value] : fingerprint.settings) json["settings"][key] = setting_text(value);
    return json.dump();
}

}  // namespace aleph
