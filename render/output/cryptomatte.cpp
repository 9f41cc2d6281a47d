#include "render/output/cryptomatte.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>

namespace aleph {

namespace {

std::uint32_t scramble(std::uint32_t block) {
    return std::rotl(block * 0xcc9e2d51u, 15) * 0x1b873593u;
}

}  // namespace

std::uint32_t murmur_hash(std::string_view text) {
    std::uint32_t hash = 0;
    std::size_t at = 0;
    for (; at + 4 <= text.size(); at += 4) {
        std::uint32_t block = 0;
        for (int byte = 3; byte >= 0; --byte) block = block << 8 | static_cast<unsigned char>(text[at + byte]);
        hash = std::rotl(hash ^ scramble(block), 13) * 5u + 0xe6546b64u;
    }
    std::uint32_t rest = 0;
    for (std::size_t byte = text.size(); byte > at; --byte)
        rest = rest << 8 | static_cast<unsigned char>(text[byte - 1]);
    hash ^= scramble(rest) ^ static_cast<std::uint32_t>(text.size());
    hash = (hash ^ hash >> 16) * 0x85ebca6bu;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
    return hash ^ hash >> 16;
}

float cryptomatte_id(std::string_view name) {
    std::uint32_t bits = murmur_hash(name);
    const std::uint32_t exponent = bits >> 23 & 255;
    if (exponent == 0 || exponent == 255) bits ^= 1u << 23;
    return std::bit_cast<float>(bits);
}

std::string cryptomatte_manifest(const std::vector<std::string>& names) {
    std::string manifest = "{";
    for (const std::string& name : names) {
        if (manifest.size() > 1) manifest += ',';
        manifest += nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
        manifest += fmt::format(":\"{:08x}\"", std::bit_cast<std::uint32_t>(cryptomatte_id(name)));
    }
    return manifest + '}';
}

std::string cryptomatte_prefix(std::string_view layer) {
    return fmt::format("cryptomatte/{}/", fmt::format("{:08x}", murmur_hash(layer)).substr(0, 7));
}

}  // namespace aleph
