#pragma once
// Whole files in memory.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace aleph {

using Bytes = std::vector<std::uint8_t>;

/// Size of the largest file that is read, bytes: 2 GiB less one, so that sizes fit in 31 bits.
inline constexpr std::uint64_t max_file_bytes = 0x7fffffff;

/// Reads a regular file (not a folder or a device) of at most max_file_bytes.
/// @param file, place  what an error message names
/// @throws InputError
Bytes read_regular_file(const std::filesystem::path& path, const std::string& file, const std::string& place);

/// The ending of a file's name in lower case: ".abc" of "Shot.ABC". Empty where there is none.
std::string lower_extension(const std::filesystem::path& path);

}  // namespace aleph
