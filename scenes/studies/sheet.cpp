// Drawing panels side by side, with OpenImageIO's colour maps, resizing and text.

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/image/image_file.h"
#include "scenes/studies/study_tools.h"

namespace aleph {

namespace {

constexpr int caption_height = 26;
constexpr const char* caption_font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

OIIO::ImageBuf make_buffer(int width, int height, int channels) {
    return OIIO::ImageBuf(OIIO::ImageSpec(width, height, channels, OIIO::TypeDesc::FLOAT));
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

Panel map_panel(const std::string& caption, const Image<float>& map, double low, double high, bool logarithmic) {
    OIIO::ImageBuf values = make_buffer(map.width, map.height, 1);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const double v = map(x, y);
            const double position =
                logarithmic ? std::log(std::max(v, low) / low) / std::log(high / low) : (v - low) / (high - low);
            const float shown = static_cast<float>(std::isfinite(position) ? std::clamp(position, 0.0, 1.0) : 0.0);
            values.setpixel(x, y, &shown);
        }
    }
    const OIIO::ImageBuf colored = OIIO::ImageBufAlgo::color_map(values, 0, "inferno");
    Panel panel{caption, Image<Rgb>(map.width, map.height)};
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            float pixel[3];
            colored.getpixel(x, y, pixel, 3);
            panel.display(x, y) = Rgb(pixel[0], pixel[1], pixel[2]);
        }
    }
    return panel;
}

Panel records_panel(const std::string& caption, const Image<float>& records) {
    Panel panel{caption, Image<Rgb>(records.width, records.height, Rgb(0.03f))};
    for (int y = 0; y < records.height; ++y) {
        for (int x = 0; x < records.width; ++x) {
            if (records(x, y) <= 0.0f) continue;
            for (int dy = 0; dy <= 1 && y + dy < records.height; ++dy) {
                for (int dx = 0; dx <= 1 && x + dx < records.width; ++dx) {
                    panel.display(x + dx, y + dy) = Rgb(1.0f, 0.85f, 0.4f);
                }
            }
        }
    }
    return panel;
}

void write_sheet(const std::filesystem::path& path, const std::vector<Panel>& panels, int columns, int width) {
    const int source_width = panels.front().display.width, source_height = panels.front().display.height;
    const int height = std::max(1, source_height * width / source_width);
    const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
    OIIO::ImageBuf sheet = make_buffer(columns * width, rows * (height + caption_height), 3);
    OIIO::ImageBufAlgo::fill(sheet, {0.10f, 0.10f, 0.11f});
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const Image<Rgb>& display = panels[i].display;
        const int left = static_cast<int>(i) % columns * width;
        const int top = static_cast<int>(i) / columns * (height + caption_height);
        OIIO::ImageBuf full = make_buffer(display.width, display.height, 3);
        full.set_pixels(OIIO::ROI(0, display.width, 0, display.height, 0, 1, 0, 3), OIIO::TypeDesc::FLOAT,
                        display.pixels.data());
        const OIIO::ImageBuf scaled =
            OIIO::ImageBufAlgo::resize(full, "triangle", 0.0f, OIIO::ROI(0, width, 0, height));
        OIIO::ImageBufAlgo::paste(sheet, left, top + caption_height, 0, 0, scaled);
        // Without the font (another system) the sheet has no captions; the table names the panels too.
        OIIO::ImageBufAlgo::render_text(sheet, left + 8, top + 19, panels[i].caption, 15, caption_font,
                                        {0.92f, 0.92f, 0.90f});
        static_cast<void>(sheet.geterror());
    }
    if (path.extension() == ".jpg") {
        sheet.specmod().attribute("Compression", "jpeg:80");
        if (!sheet.write(path.string(), OIIO::TypeDesc::UINT8)) throw OutputError(path.string(), sheet.geterror());
        return;
    }
    Image<Rgb> picture(sheet.spec().width, sheet.spec().height);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            float pixel[3];
            sheet.getpixel(x, y, pixel, 3);
            for (int c = 0; c < 3; ++c) picture(x, y)[c] = srgb_to_linear(std::clamp(pixel[c], 0.0f, 1.0f));
        }
    }
    write_png(path, picture);
}

}  // namespace aleph
