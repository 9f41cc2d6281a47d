// The EXR channels of a frame, the table in render/output/README.md and `aleph maps --help` name the same channels.
// Files for other programs: Cryptomatte, importance as one picture.

#include <fmt/ranges.h>
#include <bit>
#include <nlohmann/json.hpp>

#include "engine/pose/pose.h"
#include "render/cli/commands.h"
#include "render/cli/support/options.h"
#include "render/output/channel_table.h"
#include "render/output/frame_files.h"
#include "render/surface/node_paths.h"
#include "tests/support/paths.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

template <class... Images>
void make_one_pixel(Images&... images) {
    ((images = std::remove_reference_t<decltype(images)>(1, 1)), ...);
}

std::set<std::string> written_channels() {
    FrameOutput output;
    make_one_pixel(output.shaded.color, output.shaded.coverage, output.shaded.variance, output.shaded.samples,
                   output.shaded.records, output.shaded.invalid_samples, output.shaded.cache_count,
                   output.shaded.cache_radius, output.hits, output.estimate, output.motion.displacement,
                   output.motion.path_length, output.motion.validity, output.velocity, output.limits.alpha,
                   output.limits.threshold, output.limits.threshold_noise, output.surface.depth, output.surface.normal,
                   output.surface.albedo, output.surface.effects);
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

TEST(Cryptomatte, HashesAreMurmur3) {
    EXPECT_EQ(murmur_hash(""), 0u);
    EXPECT_EQ(murmur_hash("hello"), 0x248bfa47u);
    EXPECT_EQ(murmur_hash("hello, world"), 0x149bbb7fu);
    EXPECT_EQ(murmur_hash("The quick brown fox jumps over the lazy dog."), 0xd5c48bfcu);
}

TEST(Cryptomatte, IdsAreNormalFloats) {
    EXPECT_EQ(cryptomatte_id("hello"), 6.0705627102400005616e-17f);
    for (int i = 0; i < 2000; ++i) EXPECT_TRUE(std::isnormal(cryptomatte_id(std::to_string(i)))) << i;
}

TEST(Cryptomatte, FilesNameTheObjectsOfTheirPixels) {
    Scene scene;
    scene.meshes.resize(1);
    Node node{.name = "table"};
    scene.nodes.push_back(node);
    node.meshes = {0};
    node.parent = 0;
    node.name = "cup";
    scene.nodes.push_back(node);
    FrameOutput output;
    output.hits = Image<Hit>(2, 1);
    output.hits.pixels[1].instance = 0;
    const ChannelImage file = make_frame_image(output, true, scene, RenderSettings(), 1.0);
    EXPECT_EQ(file.find("CryptoObject00.r")->pixels, (std::vector<float>{0.0f, cryptomatte_id("/table/cup")}));
    EXPECT_EQ(file.find("CryptoObject00.g")->pixels, (std::vector<float>{0.0f, 1.0f}));
    const std::string prefix = cryptomatte_prefix("CryptoObject");
    EXPECT_EQ(prefix.size(), std::string("cryptomatte/1234567/").size());
    const auto text = [&](const char* key) { return std::get<std::string>(file.metadata.at(prefix + key)); };
    EXPECT_EQ(text("name"), "CryptoObject");
    EXPECT_EQ(text("hash"), "MurmurHash3_32");
    EXPECT_EQ(text("conversion"), "uint32_to_float32");
    const auto manifest = nlohmann::json::parse(text("manifest"));
    ASSERT_EQ(manifest.size(), 1u);
    const auto bits = static_cast<std::uint32_t>(std::stoul(manifest["/table/cup"].get<std::string>(), nullptr, 16));
    EXPECT_EQ(std::bit_cast<float>(bits), file.find("CryptoObject00.r")->pixels[1]);
}

TEST(Importance, IsOneWhereViewersAreStrictest) {
    Image<float> aleph(3, 1);
    aleph.pixels = {1.0f, 4.0f, 250.6f};
    const Image<float> importance = make_importance(aleph);
    EXPECT_EQ(importance.pixels, (std::vector<float>{1.0f, 0.25f, 1.0f / 250.6f}));
}

}  // namespace
}  // namespace aleph
