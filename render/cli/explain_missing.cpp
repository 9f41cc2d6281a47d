// Files that a scene names and that are not there, all at once.

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "engine/base/errors.h"
#include "engine/scene_file/scene_text.h"
#include "render/cli/explain.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t most_bytes = std::uintmax_t{64} << 20;

/// Empty where it cannot be read or is no text of a sensible size.
std::string read_text(const fs::path& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error) || fs::file_size(path, error) > most_bytes) return {};
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

bool is_there(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

/// What a .glb's first chunk holds; the file is taken as text otherwise.
std::string gltf_text(const fs::path& path) {
    std::string text = read_text(path);
    if (!text.starts_with("glTF")) return text;
    constexpr std::size_t header = 20;
    if (text.size() < header) return {};
    std::uint32_t length = 0;
    for (std::size_t i = 0; i < 4; ++i)
        length |= static_cast<std::uint32_t>(static_cast<unsigned char>(text[12 + i])) << (8 * i);
    return text.substr(header, length);
}

void add_gltf_files(const fs::path& path, std::vector<MissingFile>& missing) {
    const nlohmann::json root = nlohmann::json::parse(gltf_text(path), nullptr, false);
    if (!root.is_object()) return;
    for (const char* kind : {"buffers", "images"}) {
        if (!root.contains(kind) || !root[kind].is_array()) continue;
        for (std::size_t i = 0; i < root[kind].size(); ++i) {
            const nlohmann::json& element = root[kind][i];
            if (!element.is_object() || !element.contains("uri") || !element["uri"].is_string()) continue;
            const std::string uri = element["uri"];
            // Escaped names and other schemes: the reader knows what they mean.
            if (uri.find(':') != std::string::npos || uri.find('%') != std::string::npos) continue;
            if (!is_there(path.parent_path() / uri))
                missing.push_back({path.string(), fmt::format("/{}/{}/uri", kind, i), uri});
        }
    }
}

bool is_gltf(const fs::path& path) {
    const std::string extension = path.extension().string();
    return extension == ".gltf" || extension == ".glb";
}

}  // namespace

std::vector<MissingFile> list_missing_files(const fs::path& path) {
    std::vector<MissingFile> missing;
    if (is_gltf(path)) add_gltf_files(path, missing);
    if (path.extension() != ".json") return missing;
    try {
        const SceneText text = read_scene_text(read_text(path), path.string());
        const fs::path folder = path.parent_path();
        for (std::size_t i = 0; i < text.scene.images.size(); ++i) {
            if (!is_there(folder / text.scene.images[i].path))
                missing.push_back({path.string(), text.image_places[i], text.scene.images[i].path});
        }
        for (std::size_t i = 0; i < text.scene.includes.size(); ++i) {
            const fs::path include = folder / text.scene.includes[i].path;
            if (!is_there(include)) {
                missing.push_back({path.string(), text.include_places[i], text.scene.includes[i].path});
            } else if (is_gltf(include)) {
                add_gltf_files(include, missing);
            }
        }
    } catch (const InputError&) {  // loading says what is wrong with the text
    }
    return missing;
}

}  // namespace aleph
