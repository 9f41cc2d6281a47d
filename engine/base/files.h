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

/// The files that this thread reads with read_regular_file while the object exists, so that no output replaces them.
/// Another such object within its lifetime records in its place.
class ReadFiles {
  public:
    ReadFiles();
    ~ReadFiles();
    ReadFiles(const ReadFiles&) = delete;
    ReadFiles& operator=(const ReadFiles&) = delete;

    const std::vector<std::filesystem::path>& paths() const { return paths_; }
    void add(const std::filesystem::path& path) { paths_.push_back(path); }

  private:
    std::vector<std::filesystem::path> paths_;
    ReadFiles* outer_;
};

/// The ending of a file's name in lower case: ".abc" of "Shot.ABC". Empty where there is none.
std::string lower_extension(const std::filesystem::path& path);

}  // namespace aleph
