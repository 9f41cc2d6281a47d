#include "render/output/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/pixel_loops.h"
#include "engine/image/image_file.h"
#include "engine/image/library.h"

namespace aleph {

namespace {

constexpr int caption_height = 26, scale_width = 60, scale_height = 11, scale_text = 34;
constexpr int scale_room = scale_width + 2 * scale_text + 8;  // with its texts and the margin
const Rgb sheet_color(0.10f, 0.10f, 0.11f);
constexpr int jpeg_quality = 80;

/// @param left,top  so that the picture lies in the sheet
void paste(Image<Rgb>& sheet, const Image<Rgb>& picture, int left, int top) {
    for (int y = 0; y < picture.height; ++y) std::copy_n(&picture(0, y), picture.width, &sheet(left, top + y));
}

/// 0 at the low end of a range, 1 at the high end; 0 for values that are not finite.
float scale_position(double value, const MapRange& range) {
    const double position = range.logarithmic
                                ? std::log(std::max(value, range.low) / range.low) / std::log(range.high / range.low)
                                : (value - range.low) / (range.high - range.low);
    return static_cast<float>(std::isfinite(position) ? std::clamp(position, 0.0, 1.0) : 0.0);
}

/// Low end, colours, high end, in the right part of a caption.
void draw_scale(Image<Rgb>& picture, const Panel& panel) {
    Image<float> positions(scale_width, scale_height);
    for (int y = 0; y < scale_height; ++y)
        for (int x = 0; x < scale_width; ++x) positions(x, y) = static_cast<float>(x) / (scale_width - 1);
    const int bar_right = picture.width - 8 - scale_text, bar_left = bar_right - scale_width;
    const ImageLibrary& library = image_library();
    paste(picture, library.color_scale(positions), bar_left, 8);
    library.draw_text(picture, bar_left - 5, 18, true, panel.low, 12);
    library.draw_text(picture, bar_right + 5, 18, false, panel.high, 12);
}

constexpr int largest_letters = 15, readable_letters = 9, smallest_letters = 7;

/// Size of a caption's letters, so that it fits into so many pixels.
int caption_size(const std::string& caption, int room) {
    int size = largest_letters;
    while (size > smallest_letters && image_library().text_width(caption, size) > room) --size;
    return size;
}

/// A panel with its caption above it, and the scale where both have room. It is a picture of its own, which cuts what
/// does not fit, so that nothing reaches other panels.
Image<Rgb> draw_panel(const Panel& panel, int width, int height) {
    Image<Rgb> picture(width, height + caption_height, sheet_color);
    paste(picture, image_library().resize(panel.display, width, height), 0, caption_height);
    const int beside_scale = width - 16 - scale_room;
    const bool has_scale =
        !panel.low.empty() && image_library().text_width(panel.caption, readable_letters) <= beside_scale;
    const int room = has_scale ? beside_scale : width - 16;
    image_library().draw_text(picture, 8, 19, false, panel.caption, caption_size(panel.caption, room));
    if (has_scale) draw_scale(picture, panel);
    return picture;
}

constexpr int map_columns = 3;
constexpr double highest_elevation = 250.6;  // of the Aleph map: 1 over the least contrast sensitivity

constexpr int spacing = 12;           // pixels
constexpr double least_length = 1.0;  // pixels, of a line that is drawn
const Rgb line_color(1.0f, 0.75f, 0.0f), start_color(1.0f, 0.1f, 0.0f);

void put(Image<Rgb>& picture, double x, double y, const Rgb& color) {
    const int column = static_cast<int>(std::lround(x)), row = static_cast<int>(std::lround(y));
    if (column >= 0 && row >= 0 && column < picture.width && row < picture.height) picture(column, row) = color;
}

}  // namespace

Panel color_panel(const std::string& caption, const Image<Rgb>& linear) {
    Panel panel{caption, linear};
    for (Rgb& pixel : panel.display.pixels) {
        for (int c = 0; c < 3; ++c) {
            pixel[c] = std::isfinite(pixel[c]) ? linear_to_srgb(std::clamp(pixel[c], 0.0f, 1.0f)) : 0.0f;
        }
    }
    return panel;
}

Panel map_panel(const std::string& caption, const Image<float>& map, const MapRange& range) {
    const Image<float> positions = map_pixels([&](float value) { return scale_position(value, range); }, map);
    return {caption, image_library().color_scale(positions), fmt::format("{:g}", range.low),
            fmt::format("{:g}", range.high)};
}

void write_sheet(const std::filesystem::path& path, const std::vector<Panel>& panels, int columns, int width,
                 const PictureTexts& texts) {
    const Image<Rgb>& first = panels.front().display;
    const int height = std::max(1, first.height * width / first.width), count = static_cast<int>(panels.size());
    const int rows = (count + columns - 1) / columns;
    Image<Rgb> sheet(columns * width, rows * (height + caption_height), sheet_color);
    for (int i = 0; i < count; ++i)
        paste(sheet, draw_panel(panels[i], width, height), i % columns * width,
              i / columns * (height + caption_height));
    for (Rgb& pixel : sheet.pixels)
        for (int c = 0; c < 3; ++c) pixel[c] = srgb_to_linear(std::clamp(pixel[c], 0.0f, 1.0f));
    if (path.extension() == ".jpg") {
        write_jpeg(path, sheet, jpeg_quality);
    } else {
        write_png(path, sheet, texts);
    }
}

void write_map_preview(const std::filesystem::path& path, const FrameOutput& output, const PictureTexts& texts) {
    std::vector<Panel> panels{color_panel("estimate", output.estimate)};
    const auto add = [&](const char* caption, const Image<float>& map, const MapRange& range) {
        if (!map.empty()) panels.push_back(map_panel(caption, map, range));
    };
    add("speed, deg/s", output.velocity, {0.1, 100.0, true});
    add("saliency", output.perception.saliency, {0.0, 1.0, false});
    add("Aleph map", output.perception.aleph, {1.0, highest_elevation, true});
    add("threshold, cd/m2", output.limits.threshold, {0.1, 100.0, true});
    add("accuracy", output.limits.alpha, {0.01, 1.0, true});
    write_sheet(path, panels, map_columns, output.estimate.width, texts);
}

void draw_motion(Image<Rgb>& picture, const MotionField& motion) {
    for (int y = spacing / 2; y < picture.height; y += spacing) {
        for (int x = spacing / 2; x < picture.width; x += spacing) {
            const glm::dvec2 way = motion.displacement(x, y) * static_cast<double>(motion_line_frames);
            const double length = std::hypot(way.x, way.y);
            if (!(length >= least_length)) continue;
            const int steps = static_cast<int>(std::ceil(length));  // at most the diagonal, times the frames
            for (int i = 0; i <= steps; ++i) {
                const double part = static_cast<double>(i) / steps;
                put(picture, x + way.x * part, y + way.y * part, line_color);
            }
            for (const int right : {0, 1})
                for (const int below : {0, 1}) put(picture, x + right, y + below, start_color);
        }
    }
}

}  // namespace aleph
