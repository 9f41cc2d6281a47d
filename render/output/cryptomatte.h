#pragma once
// Cryptomatte: names of objects as numbers in pictures, with a manifest that tells the names (Friedman and Jones 2015,
// specification 1.2.0).

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace aleph {

/// MurmurHash3_x86_32 with seed 0 (Austin Appleby, public domain).
std::uint32_t murmur_hash(std::string_view text);

/// The hash of a name as a float: the same bits, but never NaN, infinite or denormal.
float cryptomatte_id(std::string_view name);

/// {"name": "8 hexadecimal digits", ...}: the names and the bits of their cryptomatte_id.
/// @param names  each once
std::string cryptomatte_manifest(const std::vector<std::string>& names);

/// "cryptomatte/<7 hexadecimal digits of the layer's hash>/", with which the layer's attributes begin.
std::string cryptomatte_prefix(std::string_view layer);

}  // namespace aleph
