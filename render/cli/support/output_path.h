#pragma once
// Files that a command writes: those of the frames, "name.####.exr", "name.%04d.exr" or a folder; and outputs that
// would replace a file which the same command reads or writes.

#include <filesystem>
#include <string>
#include <vector>

namespace aleph {

/// Returns whether a path names a film: .mp4, .mov, .webm or .gif in any case, and no folder.
bool names_film(const std::string& path);

enum class OutputFormat { exr, png };

/// Throws an InputError of --output that names the pattern.
[[noreturn]] void refuse_pattern(const std::string& pattern, const std::string& reason);

/// The file of one frame. A pattern is a file name with one run of '#', or one %d or %0Nd, in the last part of the
/// path. A minus sign counts as a digit (frame -3 in #### is -003). A folder means `folder/<scene>.####.exr`, and an
/// empty pattern the current folder. A pattern is a folder if it ends in '/', is an existing folder, or has no
/// extension.
/// @throws InputError (place "--output") if there are several places for the number, a '%' without d or 0Nd, or an
/// extension other than .exr and .png (in any case); also for "-"
std::filesystem::path output_path(const std::string& pattern, const std::string& scene_name, int frame);

/// The format that the extension of an output_path means.
OutputFormat output_format(const std::filesystem::path& path);

/// The files of several frames. Refuses a pattern without a number for more than one.
/// @throws InputError (place "--output")
std::vector<std::filesystem::path> output_paths(const std::string& pattern, const std::string& scene_name,
                                                const std::vector<int>& frames);

struct OutputFile {
    std::filesystem::path path;  ///< empty: none
    std::string option;          ///< that names it, for messages
};

/// Called before anything is written. Files are the same by identity: another spelling of a path, a symbolic link, and
/// for files that are read a hard link too. Writing one of two hard links leaves the other as it is, so outputs that
/// are hard links of each other are allowed.
/// @param inputs  files that the command reads; empty paths are left out
/// @throws InputError (place: the option)
void refuse_overwriting(const std::vector<std::filesystem::path>& inputs, const std::vector<OutputFile>& outputs);

}  // namespace aleph
