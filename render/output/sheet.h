#pragma once
// Captioned pictures side by side in one file.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/color.h"
#include "engine/base/image.h"
#include "engine/image/image_file.h"

namespace aleph {

/// One captioned picture of a sheet: 8-bit display values in [0, 1].
struct Panel {
    std::string caption;
    Image<Rgb> display;
    std::string low{}, high{};  ///< of the colour scale that stands beside the caption; empty: none
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

}  // namespace aleph
