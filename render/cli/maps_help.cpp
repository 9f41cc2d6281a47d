#include "render/cli/maps_help.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "render/output/channel_table.h"

namespace aleph {

namespace {

constexpr std::size_t line_length = 112, indent = 27;

/// "  NAMES    HELP", in lines of at most line_length.
std::string format_channel(const ChannelInfo& info) {
    std::string text = fmt::format("  {}", fmt::join(info.names, " "));
    std::size_t column = text.size();
    const auto new_line = [&] {
        text += "\n" + std::string(indent, ' ');
        column = indent;
    };
    if (column + 1 > indent) {
        new_line();
    } else {
        text.append(indent - column, ' ');
        column = indent;
    }
    for (std::size_t begin = 0; begin < info.help.size();) {
        const std::size_t end = std::min(info.help.find(' ', begin), info.help.size());
        if (column > indent && column + 1 + end - begin > line_length) new_line();
        if (column > indent) text += ' ', ++column;
        text += info.help.substr(begin, end - begin);
        column += end - begin;
        begin = end + 1;
    }
    return text + "\n";
}

constexpr const char* after_channels =
    "\n"
    "With --images, framesPerSecond, whiteLuminance, pixelsPerDegree and displayPersistence come from the first EXR\n"
    "file if it has them. --fps and --set viewing.KEY=N override them; KEY is display_white, pixels_per_degree or\n"
    "persistence. Motion and depth come from the files that hold them. Else motion is found by comparison, by optical\n"
    "flow where the program was built with it (--motion names another way): it is unreliable without detail in the\n"
    "picture, and the faster things move. Pixels whose motion is not confirmed from the other picture count as still.\n"
    "\n"
    "Examples:\n"
    "  aleph maps scenes/pool/scene.json --frames 20 -o maps.exr\n"
    "  aleph maps scenes/pool/scene.json --frames 20 -o maps.png      six maps in one picture, to look at\n"
    "  aleph maps --images 'shot/frame.####.png' --fps 24 -o maps/\n"
    "  aleph maps scenes/pool/scene.json -o motion.####.flo           motion in Middlebury's format\n"
    "  aleph maps --images 'shot/frame.####.png' --motion census -o maps/   motion as the thesis finds it\n"
    "  aleph maps --images 'quick.####.exr' --importance -o importance.####.png\n"
    "  aleph maps --images 'blender.####.exr' --layer ViewLayer.Combined -o maps/\n"
    "  aleph compare guided.exr dense.exr --threshold maps.exr      which differences would a viewer see?";

}  // namespace

std::string maps_footer() {
    std::string text = "EXR channels (render: only of `aleph render`; scene: not with --images):\n";
    for (const ChannelInfo& info : channel_table()) text += format_channel(info);
    return text + after_channels;
}

}  // namespace aleph
