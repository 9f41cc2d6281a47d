#pragma once
// Pictures to look at: captioned ones side by side in one file, the maps of a frame, motion drawn on a picture.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/color.h"
#include "engine/base/image.h"
#include "engine/image/image_file.h"
#include "render/frame/frame_output.h"

namespace aleph {

/// One captioned picture of a sheet: 8-bit display values in [0, 1].
struct Panel {
    std::string caption;
    Image<Rgb> display;
    std::string low{}, high{};  ///< ends of the colour scale, beside captions that leave room for it; empty: none
};

Panel color_panel(const std::string& caption, const Image<Rgb>& linear);

/// Values of a map that get the first and the last colour of the scale.
struct MapRange {
    double low = 0.0, high = 1.0;
    bool logarithmic = false;
};

/// A map in a perceptually uniform colour scale, which is drawn with the ends of the range.
Panel map_panel(const std::string& caption, const Image<float>& map, const MapRange& range);

/// Writes panels in rows of `columns`, each `width` pixels wide, with captions: a JPEG if the path ends in .jpg, else a
/// PNG.
/// @throws OutputError if the file cannot be written
void write_sheet(const std::filesystem::path& path, const std::vector<Panel>& panels, int columns, int width,
                 const PictureTexts& texts = {});

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
