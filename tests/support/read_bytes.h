#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace aleph {

/// A whole file.
inline std::string read_bytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot open " + path.string());
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The same as numbers.
inline std::vector<std::uint8_t> read_numbers(const std::filesystem::path& path) {
    const std::string bytes = read_bytes(path);
    return {bytes.begin(), bytes.end()};
}

}  // namespace aleph
