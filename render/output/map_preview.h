#pragma once
// The maps of a frame as one picture that people can look at.

#include <filesystem>

#include "engine/image/image_file.h"
#include "render/frame/frame_output.h"

namespace aleph {

/// Writes the quick estimate (or the picture), speed, saliency, Aleph map, visible threshold and accuracy side by side,
/// as far as the frame has them: three in a row, each at its own size, with its name and its scale. The scales are the
/// same for all frames, so that pictures can be compared.
/// @throws OutputError naming the file
void write_map_preview(const std::filesystem::path& path, const FrameOutput& output, const PictureTexts& texts = {});

}  // namespace aleph
