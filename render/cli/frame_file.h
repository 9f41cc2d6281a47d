#pragma once
// The file of one frame, and what lies beside it while the frame is made.

#include <filesystem>
#include <string>

#include "render/cli/frame_writer.h"

namespace aleph {

/// Writes a frame, and adds the time for it to the frame's statistics.
/// @param importance   one picture in place of the maps
/// @param fingerprint  kept in the file
/// @throws OutputError
void write_frame(const std::filesystem::path& path, const FrameJob& job, FrameOutput& output, bool maps,
                 bool importance, const std::string& fingerprint);

/// Writes the picture so far beside the frame's file, as "name.0020.partial.exr", with the frame's fingerprint.
/// @param window  that is kept of it
/// @throws OutputError
void write_partial(const std::filesystem::path& file, const Image<Rgb>& color, const std::optional<PictureArea>& window,
                   const std::string& fingerprint);
/// Removes the picture so far, unless it is a file of somebody else, and the state of a frame that is finished.
void remove_unfinished(const std::filesystem::path& file);

}  // namespace aleph
