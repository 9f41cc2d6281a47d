#pragma once
// The binary container of glTF files (.glb), and the files and data that URIs name.

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/base/files.h"

namespace aleph {

/// The JSON text of a .gltf, or the chunks of a .glb; views into the file's bytes.
struct GltfChunks {
    std::string_view json;
    bool has_binary = false;
    std::string_view binary;  ///< the BIN chunk
};

/// Tells text and container apart by the first bytes, not by the name. Checks version, length and chunk table.
/// @throws InputError
GltfChunks split_gltf(const Bytes& bytes, const std::string& file);

/// True for "data:...".
bool is_data_uri(std::string_view uri);

/// Decodes a base64 data URI. @throws InputError
Bytes decode_data_uri(std::string_view uri, const std::string& file, const std::string& place);

/// Replaces escapes such as "%20" by their bytes. @throws InputError for a broken escape
std::string percent_decode(std::string_view uri, const std::string& file, const std::string& place);

/// The file that a relative URI names. Absolute paths, schemes, backslashes and control characters are refused, and so
/// are paths that lead out of `folder` after ".." and symbolic links are resolved.
/// @throws InputError
std::filesystem::path resolve_file_uri(std::string_view uri, const std::filesystem::path& folder,
                                       const std::string& file, const std::string& place);

}  // namespace aleph
