#include "engine/base/files.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>
#include <sys/stat.h>

#include <fstream>
#include <system_error>

#include "engine/base/errors.h"

namespace aleph {

namespace fs = std::filesystem;

namespace {

thread_local ReadFiles* read_files = nullptr;

}  // namespace

ReadFiles::ReadFiles() : outer_(read_files) {
    read_files = this;
}

ReadFiles::~ReadFiles() {
    read_files = outer_;
}

void ReadFiles::add(const fs::path& path) {
    paths_.push_back(path);
    states_.push_back(file_state(path));
}

void note_read_file(const fs::path& path) {
    if (read_files != nullptr) read_files->add(path);
}

FileState file_state(const fs::path& path) {
    struct stat found {};
    if (::stat(path.c_str(), &found) != 0) return {};
    return {static_cast<std::int64_t>(found.st_dev), static_cast<std::int64_t>(found.st_ino), found.st_size,
            found.st_mtim.tv_sec, found.st_mtim.tv_nsec};
}

Bytes read_regular_file(const fs::path& path, const std::string& file, const std::string& place,
                        std::uint64_t max_bytes) {
    note_read_file(path);
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    // Without a place, `file` is the one that is read.
    const std::string name = place.empty() ? "" : ": " + printable(path.filename().string());
    if (!fs::exists(status)) throw InputError(file, place, "file not found" + name);
    // Only regular files: a folder reports absurd sizes, a device or pipe has no end.
    if (!fs::is_regular_file(status)) throw InputError(file, place, "not a regular file" + name);
    // The size is that of the file that is open: another program may put a new one in its place.
    std::ifstream stream(path, std::ios::binary | std::ios::ate);
    const std::streamoff end = stream ? std::streamoff(stream.tellg()) : -1;
    if (end < 0) throw InputError(file, place, "cannot be read" + name);
    const std::uintmax_t size = static_cast<std::uintmax_t>(end);
    if (size > max_bytes)
        throw InputError(file, place, fmt::format("has {} bytes, more than {}{}", size, max_bytes, name));
    Bytes bytes(static_cast<std::size_t>(size));
    stream.seekg(0);
    stream.read(reinterpret_cast<char*>(bytes.data()), end);
    if (stream.gcount() != end) throw InputError(file, place, "cannot be read" + name);
    return bytes;
}

std::string read_text(const fs::path& path) {
    const Bytes bytes = read_regular_file(path, path.string(), "");
    return {bytes.begin(), bytes.end()};
}

fs::path code_file() {
    Dl_info info;
    link_map* map = nullptr;
    const auto* const here = reinterpret_cast<const void*>(&code_file);
    const bool found = dladdr1(here, &info, reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP) != 0;
    return found && map != nullptr && map->l_name[0] != '\0' ? map->l_name : "/proc/self/exe";
}

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return extension;
}

}  // namespace aleph
