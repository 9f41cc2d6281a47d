#pragma once
// File names that contain a frame number: name.####.exr, name.%04d.exr.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace aleph {

/// The file of each frame, by frame number.
using FrameFiles = std::map<std::int64_t, std::filesystem::path>;

/// The place of the frame number in a file name: a run of '#', %d or %0Nd.
struct NumberField {
    std::size_t begin, length;
    int width;  ///< least number of characters, a minus sign included
};

/// @param option  the option that the pattern comes from, for messages
/// @throws InputError (place `option`) if there are several places for the number, or a '%' without d or 0Nd
std::optional<NumberField> find_number_field(const std::string& name, const std::string& option);

/// The name with the number in it.
std::string insert_number(const std::string& name, const NumberField& field, int frame);

/// The existing files that fit a pattern, by frame; the number is in the last part of the path. A name without a number
/// is frame 0.
/// @throws InputError (place `option`) if no file fits, with the name of one that nearly does
FrameFiles find_frame_files(const std::string& pattern, const std::string& option = "--images");

/// The numbered pictures of a folder (EXR, PNG, JPEG, HDR by extension), by frame. The frame is the last number of the
/// name; a minus before it is its sign at the beginning of the name and behind '.' or '_'.
/// @throws InputError (place `option`) if there are none, or if their names belong to several sequences
FrameFiles find_folder_frames(const std::string& folder, const std::string& option);

}  // namespace aleph
