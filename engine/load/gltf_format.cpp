// The format of glTF files (.gltf, .glb).
#include <fmt/format.h>

#include "engine/base/files.h"
#include "engine/gltf/files.h"
#include "engine/gltf/gltf.h"
#include "engine/gltf/write/write.h"
#include "engine/json/text.h"
#include "engine/load/format_rows.h"
#include "engine/load/validate_scene.h"

namespace aleph {

namespace {

FileTiming append_gltf_file(const AppendRequest& request, Scene& scene) {
    append_gltf(request.path, scene, request.parent_node, request.include, request.limits, request.animations);
    return {};
}

void list_missing_of_gltf(const LoadRequest& request, std::vector<MissingFile>& missing) {
    const Bytes bytes = read_regular_file(request.path, request.file, "");
    const nlohmann::json root =
        parse_strict_json(split_gltf(bytes, request.file).json, request.file, request.limits, "");
    if (!root.is_object()) return;
    for (const char* kind : {"buffers", "images"}) {
        if (!root.contains(kind) || !root[kind].is_array()) continue;
        for (std::size_t i = 0; i < root[kind].size(); ++i) {
            const nlohmann::json& element = root[kind][i];
            if (!element.is_object() || !element.contains("uri") || !element["uri"].is_string()) continue;
            const auto& uri = element["uri"].get_ref<const std::string&>();
            // Only the reader knows what escaped names and other schemes mean.
            if (uri.find(':') != std::string::npos || uri.find('%') != std::string::npos) continue;
            std::error_code error;
            if (std::filesystem::is_regular_file(request.path.parent_path() / uri, error)) continue;
            missing.push_back({request.file, fmt::format("/{}/{}/uri", kind, i), uri});
        }
    }
}

}  // namespace

SceneFormat gltf_format() {
    SceneFormat format;
    format.endings = {".gltf"};
    format.description = "a glTF file";
    format.append = append_gltf_file;
    format.list_missing = list_missing_of_gltf;
    format.has_animation_names = true;
    return format;
}

SceneFormat glb_format() {
    SceneFormat format = gltf_format();
    format.endings = {".glb"};
    format.save = [](const Scene& scene, const std::filesystem::path& path) {
        validate(scene);
        return write_gltf(scene, path);
    };
    return format;
}

}  // namespace aleph
