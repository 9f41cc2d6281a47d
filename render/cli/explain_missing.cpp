// Files that a scene names and that are not there, all at once.

#include <fmt/format.h>

#include <set>

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/gltf/files.h"
#include "engine/json/text.h"
#include "engine/scene_file/scene_text.h"
#include "render/cli/explain.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

/// Adds the buffers and images that the glTF file names and that are not there.
/// @throws InputError where the file cannot be read within the limits
void add_gltf_files(const fs::path& path, const LoadLimits& limits, std::vector<MissingFile>& missing) {
    const std::string file = path.string();
    const Bytes bytes = read_regular_file(path, file, "");
    const nlohmann::json root = parse_strict_json(split_gltf(bytes, file).json, file, limits, "");
    if (!root.is_object()) return;
    for (const char* kind : {"buffers", "images"}) {
        if (!root.contains(kind) || !root[kind].is_array()) continue;
        for (std::size_t i = 0; i < root[kind].size(); ++i) {
            const nlohmann::json& element = root[kind][i];
            if (!element.is_object() || !element.contains("uri") || !element["uri"].is_string()) continue;
            const auto& uri = element["uri"].get_ref<const std::string&>();
            // Only the reader knows what escaped names and other schemes mean.
            if (uri.find(':') != std::string::npos || uri.find('%') != std::string::npos) continue;
            if (!is_there(path.parent_path() / uri)) missing.push_back({file, fmt::format("/{}/{}/uri", kind, i), uri});
        }
    }
}

bool is_gltf(const fs::path& path) {
    const std::string extension = lower_extension(path);
    return extension == ".gltf" || extension == ".glb";
}

/// Adds the pictures and includes that the scene file names and that are not there, and what included glTF files miss.
/// @throws InputError where the scene file cannot be read within the limits
void add_scene_files(const fs::path& path, const LoadLimits& limits, std::vector<MissingFile>& missing) {
    const std::string file = path.string();
    std::error_code error;
    if (fs::file_size(path, error) > limits.text()) return;  // also where the size is not known
    const Bytes bytes = read_regular_file(path, file, "");
    const SceneText text = read_scene_text({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file, limits);
    const fs::path folder = path.parent_path();
    for (std::size_t i = 0; i < text.scene.images.size(); ++i) {
        if (!is_there(folder / text.scene.images[i].path))
            missing.push_back({file, text.image_places[i], text.scene.images[i].path});
    }
    std::set<fs::path> seen;  // a thousand includes of one large file cost one
    for (std::size_t i = 0; i < text.scene.includes.size(); ++i) {
        const fs::path include = folder / text.scene.includes[i].path;
        if (!is_there(include)) {
            missing.push_back({file, text.include_places[i], text.scene.includes[i].path});
        } else if (is_gltf(include) && seen.insert(fs::weakly_canonical(include, error)).second) {
            try {
                add_gltf_files(include, limits, missing);
            } catch (const InputError&) {  // the other includes may miss files too
            }
        }
    }
}

}  // namespace

std::vector<MissingFile> list_missing_files(const fs::path& path, const LoadLimits& limits) {
    std::vector<MissingFile> missing;
    try {
        if (is_gltf(path)) add_gltf_files(path, limits, missing);
        if (lower_extension(path) == ".json") add_scene_files(path, limits, missing);
    } catch (const InputError&) {  // loading says what is wrong with the file
    }
    return missing;
}

}  // namespace aleph
