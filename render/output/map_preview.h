#pragma once
// The maps of a frame as one picture that people can look at, and its motion drawn on a picture.

#include <filesystem>

#include "engine/image/image_file.h"
#include "render/frame/frame_output.h"

namespace aleph {

/// Writes the quick estimate (or the picture), speed, saliency, Aleph map, visible threshold and accuracy side by side,
/// as far as the frame has them: three in a row, each at its own size, with its name and its scale. The scales are the
/// same for all frames, so that pictures can be compared.
/// @throws OutputError naming the file
void write_map_preview(const std::filesystem::path& path, const FrameOutput& output, const PictureTexts& texts = {});

/// Frames that each line takes at its pixel's present speed.
inline constexpr int motion_line_frames = 4;

/// Draws lines from every 12th pixel in both directions to where its surface point is after so many frames; a square of
/// 2 pixels is at their beginning. Pixels without motion have none.
/// @param picture  linear RGB, of the motion's size
void draw_motion(Image<Rgb>& picture, const MotionField& motion);

}  // namespace aleph
