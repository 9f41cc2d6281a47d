#include "render/output/sheet.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/image/image_file.h"

namespace aleph {

namespace {

constexpr int caption_height = 26, scale_width = 60, scale_height = 11, scale_text = 34;
constexpr const char* caption_font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

OIIO::ImageBuf make_buffer(int width, int height, int channels) {
    return OIIO::ImageBuf(OIIO::ImageSpec(width, height, channels, OIIO::TypeDesc::FLOAT));
}

Image<Rgb> to_image(const OIIO::ImageBuf& buffer) {
    Image<Rgb> image(buffer.spec().width, buffer.spec().height);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            float pixel[3];
            buffer.getpixel(x, y, pixel, 3);
            image(x, y) = Rgb(pixel[0], pixel[1], pixel[2]);
        }
    }
    return image;
}

/// 0 at the low end of a range, 1 at the high end; 0 for values that are not finite.
float scale_position(double value, const MapRange& range) {
    const double position = range.logarithmic
                                ? std::log(std::max(value, range.low) / range.low) / std::log(range.high / range.low)
                                : (value - range.low) / (range.high - range.low);
    return static_cast<float>(std::isfinite(position) ? std::clamp(position, 0.0, 1.0) : 0.0);
}

/// Display values: OpenImageIO gives linear ones, in which the scale would be darker and not uniform.
OIIO::ImageBuf color_scale(const OIIO::ImageBuf& positions) {
    OIIO::ImageBuf colors = OIIO::ImageBufAlgo::color_map(positions, 0, "inferno");
    for (OIIO::ImageBuf::Iterator<float> pixel(colors); !pixel.done(); ++pixel)
        for (int c = 0; c < 3; ++c) pixel[c] = linear_to_srgb(std::clamp(static_cast<float>(pixel[c]), 0.0f, 1.0f));
    return colors;
}

void draw_text(OIIO::ImageBuf& sheet, int x, int y, const std::string& text, int size,
               OIIO::ImageBufAlgo::TextAlignX align) {
    // Without the font the sheet has no captions.
    OIIO::ImageBufAlgo::render_text(sheet, x, y, text, size, caption_font, {0.92f, 0.92f, 0.90f}, align);
    static_cast<void>(sheet.geterror());
}

/// Low end, colours, high end, in the right part of a caption. @param right,top  of the caption
void draw_scale(OIIO::ImageBuf& sheet, const Panel& panel, int right, int top) {
    if (panel.low.empty()) return;
    OIIO::ImageBuf positions = make_buffer(scale_width, scale_height, 1);
    for (int y = 0; y < scale_height; ++y) {
        for (int x = 0; x < scale_width; ++x) {
            const float position = static_cast<float>(x) / (scale_width - 1);
            positions.setpixel(x, y, &position);
        }
    }
    const int bar_right = right - 8 - scale_text, bar_left = bar_right - scale_width;
    OIIO::ImageBufAlgo::paste(sheet, bar_left, top + 8, 0, 0, color_scale(positions));
    draw_text(sheet, bar_left - 5, top + 18, panel.low, 12, OIIO::ImageBufAlgo::TextAlignX::Right);
    draw_text(sheet, bar_right + 5, top + 18, panel.high, 12, OIIO::ImageBufAlgo::TextAlignX::Left);
}

/// Size of a caption's letters, so that it fits into so many pixels.
int caption_size(const std::string& caption, int room) {
    int size = 15;
    while (size > 7 && OIIO::ImageBufAlgo::text_size(caption, size, caption_font).width() > room) --size;
    return size;
}

/// Draws a panel with its caption above it. @param left,top  of the caption
void draw_panel(OIIO::ImageBuf& sheet, const Panel& panel, int left, int top, int width, int height) {
    const Image<Rgb>& display = panel.display;
    OIIO::ImageBuf full = make_buffer(display.width, display.height, 3);
    full.set_pixels(OIIO::ROI(0, display.width, 0, display.height, 0, 1, 0, 3), OIIO::TypeDesc::FLOAT,
                    display.pixels.data());
    const OIIO::ImageBuf scaled = OIIO::ImageBufAlgo::resize(full, "triangle", 0.0f, OIIO::ROI(0, width, 0, height));
    OIIO::ImageBufAlgo::paste(sheet, left, top + caption_height, 0, 0, scaled);
    const int room = width - 16 - (panel.low.empty() ? 0 : scale_width + 2 * scale_text + 8);
    draw_text(sheet, left + 8, top + 19, panel.caption, caption_size(panel.caption, room),
              OIIO::ImageBufAlgo::TextAlignX::Left);
    draw_scale(sheet, panel, left + width, top);
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
    OIIO::ImageBuf positions = make_buffer(map.width, map.height, 1);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const float position = scale_position(map(x, y), range);
            positions.setpixel(x, y, &position);
        }
    }
    return {caption, to_image(color_scale(positions)), fmt::format("{:g}", range.low), fmt::format("{:g}", range.high)};
}

void write_sheet(const std::filesystem::path& path, const std::vector<Panel>& panels, int columns, int width,
                 const PictureTexts& texts) {
    const Image<Rgb>& first = panels.front().display;
    const int height = std::max(1, first.height * width / first.width), count = static_cast<int>(panels.size());
    const int rows = (count + columns - 1) / columns;
    OIIO::ImageBuf sheet = make_buffer(columns * width, rows * (height + caption_height), 3);
    OIIO::ImageBufAlgo::fill(sheet, {0.10f, 0.10f, 0.11f});
    for (int i = 0; i < count; ++i)
        draw_panel(sheet, panels[i], i % columns * width, i / columns * (height + caption_height), width, height);
    if (path.extension() == ".jpg") {
        sheet.specmod().attribute("Compression", "jpeg:80");
        if (!sheet.write(path.string(), OIIO::TypeDesc::UINT8)) throw OutputError(path.string(), sheet.geterror());
        return;
    }
    Image<Rgb> picture = to_image(sheet);
    for (Rgb& pixel : picture.pixels)
        for (int c = 0; c < 3; ++c) pixel[c] = srgb_to_linear(std::clamp(pixel[c], 0.0f, 1.0f));
    write_png(path, picture, texts);
}

}  // namespace aleph
