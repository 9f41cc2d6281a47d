#pragma once
// Files that the frames are written to: "name.####.exr", "name.%04d.exr", or a folder.

#include <filesystem>
#include <string>
#include <vector>

namespace aleph {

/// Returns whether a path names a film: .mp4, .mov, .webm or .gif in any case, and no folder.
bool names_film(const std::string& path);

enum class OutputFormat { exr, png };

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

}  // namespace aleph
