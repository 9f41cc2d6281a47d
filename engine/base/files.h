#pragma once
// Whole files in memory.

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace aleph {

using Bytes = std::vector<std::uint8_t>;

/// Size of the largest file that is read, bytes: 2 GiB less one, so that sizes fit in 31 bits.
inline constexpr std::uint64_t max_file_bytes = 0x7fffffff;

/// Reads a regular file (not a folder or a device) of at most so many bytes.
/// @param file, place  what an error message names
/// @throws InputError
Bytes read_regular_file(const std::filesystem::path& path, const std::string& file, const std::string& place,
                        std::uint64_t max_bytes = max_file_bytes);

/// The bytes of read_regular_file as text.
/// @throws InputError naming the path
std::string read_text(const std::filesystem::path& path);

/// The state of a file: device, number, size, and the time of its last change in s and ns. All 0: there is no
/// file.
using FileState = std::array<std::int64_t, 5>;

/// Links are followed.
FileState file_state(const std::filesystem::path& path);

/// The files that this thread reads, or looks for in vain, with read_regular_file while the object exists: so that no
/// output replaces them, and to see when they change. Another such object within its lifetime records in its place.
class ReadFiles {
  public:
    ReadFiles();
    ~ReadFiles();
    ReadFiles(const ReadFiles&) = delete;
    ReadFiles& operator=(const ReadFiles&) = delete;

    const std::vector<std::filesystem::path>& paths() const { return paths_; }
    /// The state of each path, before it was read.
    const std::vector<FileState>& states() const { return states_; }
    void add(const std::filesystem::path& path);

  private:
    std::vector<std::filesystem::path> paths_;
    std::vector<FileState> states_;
    ReadFiles* outer_;
};

/// Records a file that is read, or looked for, by other means.
void note_read_file(const std::filesystem::path& path);

/// The file that holds this code: the program, or the Python module.
std::filesystem::path code_file();

/// The ending of a file's name in lower case: ".abc" of "Shot.ABC". Empty where there is none.
std::string lower_extension(const std::filesystem::path& path);

}  // namespace aleph
