#include "engine/gltf/files.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <charconv>
#include <system_error>

#include "engine/base/errors.h"

namespace aleph {

namespace fs = std::filesystem;

namespace {

constexpr std::uint32_t json_chunk = 0x4e4f534a;    // "JSON"
constexpr std::uint32_t binary_chunk = 0x004e4942;  // "BIN\0"

/// Little-endian, from an offset that was checked.
std::uint32_t read_u32(std::string_view bytes, std::size_t offset) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<std::uint8_t>(bytes[offset + i]);
    return value;
}

constexpr std::array<std::int8_t, 256> make_base64_table() {
    std::array<std::int8_t, 256> table;
    table.fill(-1);
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < alphabet.size(); ++i)
        table[static_cast<std::uint8_t>(alphabet[i])] = static_cast<std::int8_t>(i);
    return table;
}

bool has_scheme(std::string_view uri) {
    if (uri.empty() || !std::isalpha(static_cast<unsigned char>(uri[0]))) return false;
    for (const char c : uri) {
        if (c == ':') return true;
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '+' && c != '-' && c != '.') return false;
    }
    return false;
}

bool is_below(const fs::path& path, const fs::path& folder) {
    auto part = path.begin();
    for (const fs::path& wanted : folder) {
        if (part == path.end() || *part != wanted) return false;
        ++part;
    }
    return part != path.end();
}

}  // namespace

GltfChunks split_gltf(const Bytes& bytes, const std::string& file) {
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    GltfChunks chunks;
    if (all.substr(0, 4) != "glTF") {
        if (file.ends_with(".glb") && all.find_first_not_of(" \t\r\n") != all.find('{'))
            throw InputError(file, "", "this is not a GLB file: it does not begin with \"glTF\"");
        chunks.json = all;
        return chunks;
    }
    const auto fail = [&](const std::string& reason) { throw InputError(file, "GLB container", reason); };
    if (all.size() < 20) fail("the file ends inside its header");
    if (const std::uint32_t version = read_u32(all, 4); version != 2) {
        fail(fmt::format("version {} is not supported, only 2", version));
    }
    if (const std::uint32_t length = read_u32(all, 8); length != all.size()) {
        fail(fmt::format("the header says {} bytes, the file has {}", length, all.size()));
    }
    bool has_json = false;
    for (std::size_t offset = 12; offset < all.size();) {
        if (all.size() - offset < 8) fail(fmt::format("the file ends inside the chunk header at byte {}", offset));
        const std::uint32_t length = read_u32(all, offset);
        const std::uint32_t type = read_u32(all, offset + 4);
        offset += 8;
        if (length > all.size() - offset) {
            fail(fmt::format("the chunk at byte {} claims {} bytes, {} are left", offset - 8, length,
                             all.size() - offset));
        }
        if (length % 4 != 0)
            fail(fmt::format("the chunk at byte {} has {} bytes, no multiple of 4", offset - 8, length));
        const std::string_view content = all.substr(offset, length);
        if (!has_json && type != json_chunk) fail("the first chunk is not JSON");
        if (has_json && type == json_chunk) fail("a second JSON chunk");
        if (type == json_chunk) {
            has_json = true;
            chunks.json = content;
        } else if (type == binary_chunk) {
            if (chunks.has_binary) fail("a second BIN chunk");
            chunks.has_binary = true;
            chunks.binary = content;
        }
        offset += length;
    }
    return chunks;
}

bool is_data_uri(std::string_view uri) {
    return uri.substr(0, 5) == "data:";
}

Bytes decode_data_uri(std::string_view uri, const std::string& file, const std::string& place) {
    static constexpr std::array<std::int8_t, 256> table = make_base64_table();
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) throw InputError(file, place, "the data URI has no comma");
    const std::string_view head = uri.substr(5, comma - 5);
    constexpr std::string_view base64 = ";base64";
    if (head.size() < base64.size() || head.substr(head.size() - base64.size()) != base64) {
        throw InputError(file, place, "only base64 data URIs are supported");
    }
    Bytes bytes;
    std::string_view text = uri.substr(comma + 1);
    for (int i = 0; i < 2 && !text.empty() && text.back() == '='; ++i) text.remove_suffix(1);
    if (text.size() % 4 == 1) throw InputError(file, place, "the data URI's base64 text is cut off");
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int bit_count = 0;
    for (const char c : text) {
        const int value = table[static_cast<std::uint8_t>(c)];
        if (value < 0) throw InputError(file, place, fmt::format("\"{}\" is not base64", printable({&c, 1})));
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            bytes.push_back(static_cast<std::uint8_t>(bits >> bit_count & 0xff));
        }
    }
    return bytes;
}

std::string percent_decode(std::string_view uri, const std::string& file, const std::string& place) {
    std::string decoded;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            decoded += uri[i];
            continue;
        }
        const std::string_view digits = uri.substr(i + 1, 2);
        std::uint8_t byte = 0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
        if (error != std::errc() || end != digits.data() + 2)
            throw InputError(file, place, fmt::format("broken % escape in \"{}\"", printable(uri)));
        decoded += static_cast<char>(byte);
        i += 2;
    }
    return decoded;
}

fs::path resolve_file_uri(std::string_view uri, const fs::path& folder, const std::string& file,
                          const std::string& place) {
    const std::string decoded = percent_decode(uri, file, place);
    const auto fail = [&](const std::string& reason) {
        throw InputError(file, place, fmt::format("\"{}\": {}", printable(decoded), reason));
    };
    if (decoded.empty()) fail("the URI is empty");
    if (decoded[0] == '/') fail("absolute paths are not allowed");
    if (has_scheme(uri)) fail("only relative paths and data URIs are supported");
    for (const char c : decoded) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '\\') fail("backslashes are not allowed");
        if (byte < 0x20 || byte == 0x7f) fail("control characters are not allowed");
    }
    std::error_code error;
    const fs::path base = fs::canonical(folder, error);
    if (error) fail("the file's folder cannot be resolved: " + error.message());
    const fs::path target = fs::weakly_canonical(base / decoded, error);
    if (error) fail("cannot be resolved: " + error.message());
    if (!is_below(target, base)) fail("leads out of the file's folder");
    return target;
}

}  // namespace aleph
