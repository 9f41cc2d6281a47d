// The EXR channels of a frame, the table in render/README.md and `aleph maps --help` name the same channels.

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "render/cli/commands.h"
#include "render/frame_files.h"
#include "tests/support/paths.h"

namespace aleph {
namespace {

template <class... Images>
void make_one_pixel(Images&... images) {
    ((images = std::remove_reference_t<decltype(images)>(1, 1)), ...);
}

/// All channels that a file can have.
std::set<std::string> written_channels() {
    FrameOutput output;
    make_one_pixel(output.shaded.color, output.shaded.coverage, output.shaded.variance, output.shaded.samples,
                   output.shaded.records, output.shaded.invalid_samples, output.shaded.cache_count,
                   output.shaded.cache_radius, output.hits, output.estimate, output.motion.displacement,
                   output.motion.path_length, output.motion.validity, output.velocity, output.alpha, output.threshold,
                   output.threshold_flicker, output.depth, output.normal);
    make_one_pixel(output.shaded.errors.total);
    for (Image<float>& cause : output.shaded.errors.by_cause) make_one_pixel(cause);
    PerceptionMaps& maps = output.perception;
    make_one_pixel(maps.aleph, maps.retinal_velocity, maps.saliency, maps.conspicuity_intensity, maps.conspicuity_color,
                   maps.conspicuity_orientation, maps.conspicuity_motion);
    std::set<std::string> names;
    for (const Channel& channel : make_frame_image(output, true, Scene(), RenderSettings(), 1.0).channels) {
        names.insert(channel.name);
    }
    return names;
}

/// The names in the first column of the table under "EXR channels".
std::set<std::string> documented_channels() {
    std::ifstream file(source_folder() / "render" / "README.md");
    std::set<std::string> names;
    bool inside = false;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("## ")) inside = line == "## EXR channels";
        if (!inside || !line.starts_with("| `")) continue;
        const std::string column = line.substr(0, line.find(" | "));
        const std::regex name("`([^`]+)`");
        for (std::sregex_iterator match(column.begin(), column.end(), name), end; match != end; ++match) {
            names.insert((*match)[1]);
        }
    }
    return names;
}

TEST(Channels, TheReadmeListsEveryChannelAndNoOther) {
    EXPECT_EQ(written_channels().size(), 38u);
    EXPECT_EQ(documented_channels(), written_channels());
}

TEST(Channels, TheHelpOfMapsListsEveryChannel) {
    CLI::App app{"test"};
    Command command;
    add_maps_command(app, command);
    std::set<std::string> words;
    std::istringstream help(app.get_subcommand("maps")->help());
    for (std::string word; help >> word;) words.insert(word);
    for (const std::string& name : written_channels()) {
        if (name == "variance.Y") continue;  // the path tracer's
        EXPECT_TRUE(words.contains(name)) << name;
    }
}

}  // namespace
}  // namespace aleph
