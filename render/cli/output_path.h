#pragma once
// Files that the frames are written to: "name.####.exr", "name.%04d.exr", or a folder.

#include <cstddef>
#include <filesystem>
#include <string>

namespace aleph {

/// The file of one frame. A pattern is a file name with one run of '#', or one %d or %0Nd, in the last part of the
/// path. A minus sign counts as a digit (frame -3 in #### is -003). A folder means `folder/<scene>.####.exr`, and an
/// empty pattern the current folder. A pattern is a folder if it ends in '/', is an existing folder, or has no
/// extension.
/// @throws InputError (place "--output") if there are several places for the number, or a '%' without d or 0Nd
std::filesystem::path output_path(const std::string& pattern, const std::string& scene_name, int frame);

/// Called before anything is computed. Refuses a pattern without a number for several frames. Creates the folder of the
/// files if its parent exists.
/// @throws InputError (place "--output"), OutputError naming the missing folder
void prepare_output(const std::string& pattern, const std::string& scene_name, std::size_t frame_count);

}  // namespace aleph
