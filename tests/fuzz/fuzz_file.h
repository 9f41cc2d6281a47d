#pragma once
// Readers that take a path get the fuzzer's bytes through a file in memory.

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "engine/base/errors.h"
#include "engine/pose/pose.h"

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

/// Reads the bytes as a file of this name: an InputError or a scene that can be posed.
/// @param append  as append_alembic
template <class Append>
int read_fuzz_file(const char* name, const std::uint8_t* data, std::size_t size, const Append& append) {
    const std::filesystem::path path = fuzz_folder() / name;
    std::ofstream(path, std::ios::binary | std::ios::trunc)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    Scene scene;
    scene.source.includes.push_back({name, no_index});
    try {
        append(path, scene, no_index, 0);
        pose(scene, 0.3);
    } catch (const InputError&) {
    }
    return 0;
}

}  // namespace aleph
