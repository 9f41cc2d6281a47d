#pragma once
// File names with a frame number in them: name.####.exr, name.%04d.exr.

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace aleph {

/// The place of the frame number in a file name: a run of '#', %d or %0Nd.
struct NumberField {
    std::size_t begin, length;
    int width;  ///< digits at least; a minus sign counts
};

/// @param option  what messages call the pattern's origin
/// @throws InputError (place `option`) if there are several places for the number, or a '%' that is no number
std::optional<NumberField> find_number_field(const std::string& name, const std::string& option);

/// The name with the number in it.
std::string insert_number(const std::string& name, const NumberField& field, int frame);

/// The files on the disk that a pattern names, by frame; the number stands in the pattern's last part. A name without a
/// number is frame 0.
/// @throws InputError (place "--images") where nothing fits, saying what does if that is easy to see
std::map<std::int64_t, std::filesystem::path> find_frame_files(const std::string& pattern);

}  // namespace aleph
