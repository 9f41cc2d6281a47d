#pragma once
// Where the frames go: "name.####.exr", "name.%04d.exr", or a folder.

#include <cstddef>
#include <filesystem>
#include <string>

namespace aleph {

/// The file of one frame. A pattern is a file name with one run of '#' or one %d or %0Nd, in its last part; the width
/// counts a minus sign (frame -3 in #### is -003). A folder stands for `folder/<scene>.####.exr`, as does an empty
/// pattern for the current one: a pattern is a folder if it ends in '/', is one on the disk, or has no extension.
/// @throws InputError (place "--output") if there are several places for the number, or a '%' that is no number
std::filesystem::path output_path(const std::string& pattern, const std::string& scene_name, int frame);

/// To be called before anything is computed: refuses a pattern without a number for several frames, and creates the
/// folder of the files if only its last part is missing.
/// @throws InputError (place "--output"), OutputError naming the missing folder
void prepare_output(const std::string& pattern, const std::string& scene_name, std::size_t frame_count);

}  // namespace aleph
