#pragma once
// A glTF file after validation: raw JSON, tinygltf's typed model, and the bytes that both refer to.

#include <tiny_gltf.h>

#include <filesystem>
#include <string>
#include <vector>

#include "engine/gltf/files.h"
#include "engine/json/json_ref.h"
#include "engine/json/load_limits.h"

namespace aleph {

struct GltfSource {
    std::string file;              ///< what messages call it
    std::filesystem::path folder;  ///< URIs may only name files below it
    nlohmann::json document;     ///< validated; extensions are read from here: tinygltf cuts their integers to 31 bits
    tinygltf::Model model;       ///< without buffers, images, skins, indices, channels, sparse values
    std::vector<Bytes> buffers;  ///< exactly byteLength each
    std::vector<std::string> warnings;

    /// Elements of one of the document's lists; 0 where it has no such list.
    std::size_t count(const char* list) const;
};

/// The object of an extension of an element; null where it has none.
const nlohmann::json* find_extension(const nlohmann::json& element, const char* name);

/// Reads, validates and parses; buffers are loaded, images only located.
/// @throws InputError
GltfSource load_gltf_source(const std::filesystem::path& path, const LoadLimits& limits);

/// An image's PNG or JPEG bytes. @throws InputError
/// @param path  becomes its path relative to the glTF file; stays where the image is embedded
Bytes load_encoded_image(const GltfSource& source, std::size_t image, std::string& path);

}  // namespace aleph
