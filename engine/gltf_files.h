#pragma once
// Bytes of glTF files: whole files, the binary container, and what a URI may refer to.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace aleph {

using Bytes = std::vector<std::uint8_t>;

/// Largest file that is read, bytes: 2 GiB less one, so that sizes fit 31 bits everywhere.
inline constexpr std::uint64_t max_gltf_file_bytes = 0x7fffffff;

/// Reads a regular file (no folder, no device) of at most max_gltf_file_bytes.
/// @param file, place  what an error names
/// @throws InputError
Bytes read_regular_file(const std::filesystem::path& path, const std::string& file, const std::string& place);

/// The JSON text of a .gltf, or the chunks of a .glb; views into the file's bytes.
struct GltfChunks {
    std::string_view json;
    bool has_binary = false;
    std::string_view binary;  ///< the BIN chunk
};

/// Splits by the file's first bytes, not by its name. A container's version, length and chunk table are checked.
/// @throws InputError
GltfChunks split_gltf(const Bytes& bytes, const std::string& file);

/// True for "data:...".
bool is_data_uri(std::string_view uri);

struct DataUri {
    std::string media_type;
    Bytes bytes;
};

/// Decodes a base64 data URI. @throws InputError
DataUri decode_data_uri(std::string_view uri, const std::string& file, const std::string& place);

/// "%20" and the like become bytes. @throws InputError for a broken escape
std::string percent_decode(std::string_view uri, const std::string& file, const std::string& place);

/// The file that a relative URI means. Refused: absolute paths, schemes, backslashes, control characters, and whatever
/// leaves `folder` once "..", and symbolic links are resolved.
/// @throws InputError
std::filesystem::path resolve_file_uri(std::string_view uri, const std::filesystem::path& folder,
                                       const std::string& file, const std::string& place);

}  // namespace aleph
