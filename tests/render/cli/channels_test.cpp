// The EXR channels of a frame, the table in render/output/README.md and `aleph maps --help` name the same channels.

#include <fmt/ranges.h>

#include "render/cli/commands.h"
#include "render/output/channel_table.h"
#include "render/output/frame_files.h"
#include "tests/support/paths.h"
#include "tests/support/test.h"

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
                   output.motion.path_length, output.motion.validity, output.velocity, output.limits.alpha,
                   output.limits.threshold, output.limits.threshold_noise, output.surface.depth, output.surface.normal,
                   output.surface.albedo, output.effects);
    output.backward = output.motion;
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

/// The rows of the table under "EXR channels".
std::vector<std::string> documented_rows() {
    std::ifstream file(source_folder() / "render" / "output" / "README.md");
    std::vector<std::string> rows;
    bool inside = false;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("## ")) inside = line == "## EXR channels";
        if (inside && line.starts_with("| `")) rows.push_back(line);
    }
    return rows;
}

/// The rows that channel_table makes.
std::vector<std::string> expected_rows() {
    std::vector<std::string> rows;
    for (const ChannelInfo& info : channel_table()) {
        rows.push_back(fmt::format("| `{}` | {} | {} | {} |", fmt::join(info.names, "` `"), info.content, info.range,
                                   info.background));
    }
    return rows;
}

TEST(Channels, TheReadmeListsEveryChannelAndNoOther) {
    EXPECT_EQ(written_channels().size(), 51u);
    std::set<std::string> known;
    for (const ChannelInfo& info : channel_table()) known.insert(info.names.begin(), info.names.end());
    EXPECT_EQ(known, written_channels());
    EXPECT_EQ(documented_rows(), expected_rows());
}

TEST(Channels, TheHelpOfMapsListsEveryChannel) {
    CLI::App app{"test"};
    Command command;
    add_maps_command(app, command);
    std::set<std::string> words;
    std::istringstream help(app.get_subcommand("maps")->help());
    for (std::string word; help >> word;) words.insert(word);
    for (const std::string& name : written_channels()) {
        EXPECT_TRUE(words.contains(name)) << name;
    }
}

TEST(Channels, FilesDescribeTheirOwn) {
    FrameOutput output;
    make_one_pixel(output.limits.threshold, output.motion.displacement);
    const ChannelImage file = make_frame_image(output, true, Scene(), RenderSettings(), 1.0);
    const auto text = [&](const char* key) { return std::get<std::string>(file.metadata.at(key)); };
    EXPECT_NE(text("channel:threshold.Y").find("cd/m2, above 0"), std::string::npos);
    EXPECT_NE(text("channel:forward.v").find("v positive upwards"), std::string::npos);
    EXPECT_FALSE(file.metadata.contains("channel:Z"));
}

}  // namespace
}  // namespace aleph
