#pragma once
// Readers that take a path get the fuzzer's bytes through a file in memory.

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace aleph {

/// A folder of this process's own, in memory where the system has such a place.
inline const std::filesystem::path& fuzz_folder() {
    static const std::filesystem::path folder = [] {
        const std::filesystem::path shared = "/dev/shm";
        const std::filesystem::path base =
            std::filesystem::exists(shared) ? shared : std::filesystem::temp_directory_path();
        const std::filesystem::path made = base / ("aleph-fuzz-" + std::to_string(getpid()));
        std::filesystem::create_directories(made);
        std::atexit([] { std::filesystem::remove_all(fuzz_folder()); });
        return made;
    }();
    return folder;
}

inline std::filesystem::path write_fuzz_file(const char* name, const std::uint8_t* data, std::size_t size) {
    const std::filesystem::path path = fuzz_folder() / name;
    std::ofstream(path, std::ios::binary | std::ios::trunc)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return path;
}

}  // namespace aleph
