// Pictures and channels of EXR files side by side, with captions: the figures of THESIS.md.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "engine/base/errors.h"
#include "engine/image/image_file.h"
#include "render/cli/support/options.h"
#include "render/compare/compare_luminance.h"
#include "render/output/sheet.h"

namespace aleph {

namespace {

struct SheetOptions {
    std::vector<std::string> panels;
    std::string output;
    std::vector<int> crop;  ///< left, top, width, height in pixels; empty: all of a picture
    int columns = 2, width = 320;
};

/// CAPTION=FILE is the picture of an image file; CAPTION=FILE,CHANNEL,LOW,HIGH a channel in colours from LOW to HIGH.
Panel read_panel(const std::string& text) {
    const std::size_t equals = text.find('=');
    const std::vector<std::string> parts = CLI::detail::split(text.substr(std::min(equals, text.size() - 1) + 1), ',');
    if (equals == std::string::npos || (parts.size() != 1 && parts.size() != 4))
        throw InputError(text, "", "expected CAPTION=FILE or CAPTION=FILE,CHANNEL,LOW,HIGH");
    const std::string caption = text.substr(0, equals);
    const ChannelImage image = read_image(parts[0]);
    if (parts.size() == 1) return color_panel(caption, linear_colour(image));
    const Image<float>* channel = image.find(parts[1]);
    if (!channel) throw InputError(parts[0], "", fmt::format("has no channel {}", parts[1]));
    return map_panel(caption, *channel, {parse_value<double>(parts[2], text), parse_value<double>(parts[3], text)});
}

/// A part of a picture whose pixels stand as often beside each other as they fit into the width.
Image<Rgb> enlarge_part(const Image<Rgb>& whole, const SheetOptions& options) {
    const std::vector<int> all{0, 0, whole.width, whole.height};
    const std::vector<int>& part = options.crop.empty() ? all : options.crop;
    if (part[0] < 0 || part[1] < 0 || part[2] < 1 || part[3] < 1 || part[2] > whole.width - part[0] ||
        part[3] > whole.height - part[1])
        throw InputError("", "--crop", fmt::format("is not within {}x{} pixels", whole.width, whole.height));
    const int times = std::max(1, options.width / part[2]);
    Image<Rgb> enlarged(part[2] * times, part[3] * times);
    for (int y = 0; y < enlarged.height; ++y)
        for (int x = 0; x < enlarged.width; ++x) enlarged(x, y) = whole(part[0] + x / times, part[1] + y / times);
    return enlarged;
}

int run_sheet(const SheetOptions& options) {
    std::vector<Panel> panels;
    for (const std::string& text : options.panels) {
        panels.push_back(read_panel(text));
        panels.back().display = enlarge_part(panels.back().display, options);
    }
    write_sheet(options.output, panels, options.columns, options.width);
    return exit_done;
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{"Draws pictures and channels of EXR files side by side, with captions."};
    aleph::SheetOptions options;
    app.add_option("panels", options.panels, "CAPTION=FILE, or CAPTION=FILE,CHANNEL,LOW,HIGH")->required();
    app.add_option("-o,--output", options.output, "file of the sheet, .jpg or .png")->required();
    app.add_option("--columns", options.columns)->check(CLI::Range(1, 16))->capture_default_str();
    app.add_option("--width", options.width, "of a panel in pixels")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str();
    app.add_option("--crop", options.crop, "LEFT,TOP,WIDTH,HEIGHT of the pixels to show")->delimiter(',')->expected(4);
    return aleph::run_program(
        app, [&] { return aleph::run_sheet(options); }, argc, argv, std::cerr);
}
