// `aleph maps --images`: maps of pictures without a scene, and its error messages.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/base/errors.h"
#include "engine/image/image_file.h"
#include "motion/image_motion.h"
#include "render/cli/commands.h"
#include "render/cli/frame_pattern.h"
#include "render/frame_files.h"
#include "render/image_sequence.h"
#include "tests/support/image_patterns.h"
#include "tests/support/paths.h"
#include "tests/support/scratch_folder.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

struct Ran {
    int code = 0;
    std::string errors;
};

/// `aleph maps -q ...` without starting a program.
Ran run_maps(std::vector<std::string> arguments) {
    CLI::App app{"test"};
    Command command;
    app.require_subcommand(0, 1);
    add_maps_command(app, command);
    arguments.insert(arguments.begin(), {"aleph", "maps", "-q"});
    std::vector<const char*> argv;
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    std::ostringstream errors;
    Ran ran;
    ran.code = run_program(app, command, static_cast<int>(argv.size()), argv.data(), errors);
    ran.errors = errors.str();
    return ran;
}

constexpr int width = 72, height = 56;

/// A texture that moves by (4, 8) pixels a frame, y down.
Image<Rgb> picture(int frame) {
    return make_pattern(width, height,
                        [&](int x, int y) { return smooth_texture(x - 4.0 * frame, y - 8.0 * frame, 10.0); });
}

ChannelImage as_channels(const Image<Rgb>& image) {
    ChannelImage file;
    for (int c = 0; c < 3; ++c) {
        Channel channel{std::string(1, "RGB"[c]), Image<float>(image.width, image.height)};
        for (std::size_t i = 0; i < image.size(); ++i) channel.values.pixels[i] = image.pixels[i][c];
        file.channels.push_back(std::move(channel));
    }
    return file;
}

/// A folder with frames f.0001.exr and so on.
struct Frames {
    ScratchFolder folder;
    Frames(int first, int last) {
        for (int frame = first; frame <= last; ++frame) write(frame, picture(frame));
    }
    fs::path file(int frame) const { return folder / insert_number("f.####.exr", {2, 4, 4}, frame); }
    void write(int frame, const Image<Rgb>& image) const { write_exr(file(frame), as_channels(image)); }
    std::string pattern() const { return (folder / "f.####.exr").string(); }
    std::string out() const { return (folder / "out").string(); }
    ChannelImage maps(int frame) const {
        return read_image(folder.path() / "out" / insert_number("f-maps.####.exr", {7, 4, 4}, frame));
    }
};

float median_of(const Image<float>& image) {
    std::vector<float> values = image.pixels;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

TEST(MapsImages, WritesTheChannelsThatNeedNoGeometry) {
    const Frames frames(1, 3);
    const Ran ran = run_maps({"--images", frames.pattern(), "-o", frames.out()});
    ASSERT_EQ(ran.code, 0) << ran.errors;
    EXPECT_EQ(ran.errors, "");
    const ChannelImage maps = frames.maps(2);
    std::vector<std::string> names;
    for (const Channel& channel : maps.channels) names.push_back(channel.name);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, (std::vector<std::string>{"aleph.Y", "alpha.acc", "conspicuity.color", "conspicuity.intensity",
                                               "conspicuity.motion", "conspicuity.orientation", "estimate.B",
                                               "estimate.G", "estimate.R", "forward.u", "forward.v", "motion.valid",
                                               "saliency.Y", "threshold.Y", "velocity.image", "velocity.retinal"}));
    EXPECT_FALSE(maps.metadata.contains("worldToCamera"));
    EXPECT_EQ((std::get<std::array<int, 2>>(maps.metadata.at("framesPerSecond"))), (std::array<int, 2>{30, 1}));
    for (const Channel& channel : maps.channels) {
        for (const float v : channel.values.pixels) ASSERT_TRUE(std::isfinite(v)) << channel.name;
    }
}

TEST(MapsImages, MotionIsYUpForwardAndBackwardAtTheLastFrame) {
    const Frames frames(1, 3);
    ASSERT_EQ(run_maps({"--images", frames.pattern(), "-o", frames.out(), "--fps", "24"}).code, 0);
    for (const int frame : {1, 2, 3}) {
        const ChannelImage maps = frames.maps(frame);
        EXPECT_EQ(median_of(*maps.find("forward.u")), 4.0f) << frame;
        EXPECT_EQ(median_of(*maps.find("forward.v")), -8.0f) << frame;
        EXPECT_EQ(median_of(*maps.find("motion.valid")), 1.0f) << frame;
        EXPECT_NEAR(median_of(*maps.find("velocity.image")), std::hypot(4.0, 8.0) / 31.0 * 24.0, 1e-4) << frame;
        // The picture itself is the estimate.
        EXPECT_EQ(maps.find("estimate.G")->pixels, as_channels(picture(frame)).channels[1].values.pixels);
    }
}

TEST(MapsImages, EqualsTheStagesByHand) {
    const Frames frames(1, 2);
    ASSERT_EQ(run_maps({"--images", frames.pattern(), "-o", frames.out(), "--guide", "full"}).code, 0);
    const MotionField field = compute_image_motion(picture(1), picture(2));
    const ChannelImage maps = frames.maps(1);
    for (std::size_t i = 0; i < field.displacement.size(); ++i) {
        EXPECT_EQ(maps.find("forward.u")->pixels[i], field.displacement.pixels[i].x);
        EXPECT_EQ(maps.find("forward.v")->pixels[i], 0.0 - field.displacement.pixels[i].y);
    }
    EXPECT_EQ(maps.find("saliency.Y"), nullptr);  // guide full has no saliency map
}

TEST(MapsImages, ASingleFrameStandsStill) {
    const Frames frames(7, 7);
    ASSERT_EQ(run_maps({"--images", frames.file(7).string(), "-o", (frames.folder / "still.exr").string()}).code, 0);
    const ChannelImage maps = read_image(frames.folder / "still.exr");
    for (const float v : maps.find("velocity.image")->pixels) EXPECT_EQ(v, 0.0f);
    for (const float v : maps.find("motion.valid")->pixels) EXPECT_EQ(v, -3.0f);
    EXPECT_NE(maps.find("saliency.Y"), nullptr);
}

TEST(MapsImages, NothingMovesAcrossACut) {
    const Frames frames(1, 4);
    const Ran ran = run_maps({"--images", frames.pattern(), "-o", frames.out(), "--cuts", "3"});
    ASSERT_EQ(ran.code, 0) << ran.errors;
    EXPECT_EQ(median_of(*frames.maps(1).find("forward.u")), 4.0f);
    EXPECT_EQ(median_of(*frames.maps(2).find("forward.u")), 0.0f);
    EXPECT_EQ(median_of(*frames.maps(2).find("motion.valid")), -3.0f);
    EXPECT_EQ(median_of(*frames.maps(3).find("forward.u")), 4.0f);
    EXPECT_EQ(median_of(*frames.maps(4).find("forward.u")), 4.0f);  // from the frame before
}

TEST(MapsImages, ExposureAndViewingReachTheMaps) {
    const Frames frames(1, 2);
    const auto threshold = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {"--images", frames.pattern(), "--frames", "1", "-o", frames.out()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Ran ran = run_maps(arguments);
        EXPECT_EQ(ran.code, 0) << ran.errors;
        return median_of(*frames.maps(1).find("threshold.Y"));
    };
    const float plain = threshold({});
    EXPECT_GT(threshold({"--exposure", "8"}), 2.0f * plain);
    EXPECT_EQ(threshold({"--set", "exposure=8"}), threshold({"--exposure", "8"}));
    EXPECT_GT(threshold({"--set", "viewing.display_white=800"}), 2.0f * plain);
    threshold({"--set", "viewing.pixels_per_degree=62"});
    EXPECT_NEAR(median_of(*frames.maps(1).find("velocity.image")), std::hypot(4.0, 8.0) / 62.0 * 30.0, 1e-4);
}

TEST(MapsImages, TheFirstFrameNamesRateAndViewing) {
    const Frames frames(2, 2);
    ChannelImage first = as_channels(picture(1));
    first.metadata["framesPerSecond"] = std::array<int, 2>{24000, 1001};
    first.metadata["pixelsPerDegree"] = 40.0;
    first.metadata["whiteLuminance"] = 200.0;
    write_exr(frames.file(1), first);
    ASSERT_EQ(run_maps({"--images", frames.pattern(), "-o", frames.out()}).code, 0);
    const ChannelImage maps = frames.maps(1);
    EXPECT_NEAR(median_of(*maps.find("velocity.image")), std::hypot(4.0, 8.0) / 40.0 * 24000.0 / 1001.0, 1e-4);
    EXPECT_EQ(std::get<double>(maps.metadata.at("whiteLuminance")), 200.0);
    ASSERT_EQ(run_maps({"--images", frames.pattern(), "-o", frames.out(), "--fps", "30"}).code, 0);
    EXPECT_NEAR(median_of(*frames.maps(1).find("velocity.image")), std::hypot(4.0, 8.0) / 40.0 * 30.0, 1e-4);
}

TEST(MapsImages, PngIsDecodedFromSrgb) {
    const Frames frames(1, 2);
    const ScratchFolder folder;
    for (const int frame : {1, 2}) {
        write_png(folder / ("g.00" + std::to_string(frame) + ".png"), picture(frame));
    }
    const Ran ran = run_maps({"--images", (folder / "g.%03d.png").string(), "-o", (folder / "m.#.exr").string()});
    ASSERT_EQ(ran.code, 0) << ran.errors;
    const ChannelImage maps = read_image(folder / "m.1.exr");
    const Image<Rgb> truth = picture(1);
    for (std::size_t i = 0; i < truth.size(); ++i) {
        EXPECT_NEAR(maps.find("estimate.R")->pixels[i], truth.pixels[i].x, 5e-3);
    }
    EXPECT_EQ(median_of(*maps.find("forward.u")), 4.0f);
}

TEST(MapsImages, OneChannelIsGrey) {
    const ScratchFolder folder;
    ChannelImage grey;
    grey.channels.push_back({"Y", as_channels(picture(0)).channels[0].values});
    write_exr(folder / "y.exr", grey);
    const Image<Rgb> loaded = load_linear_frame(folder / "y.exr");
    EXPECT_EQ(loaded.pixels, picture(0).pixels);
}

TEST(MapsImages, BadPixelsAreCountedNotSpread) {
    const Frames frames(1, 2);
    Image<Rgb> damaged = picture(1);
    damaged(10, 10) = Rgb(NAN);
    damaged(40, 30) = Rgb(INFINITY, 0.0f, 0.0f);
    frames.write(1, damaged);
    const std::string stats = (frames.folder / "stats.json").string();
    ASSERT_EQ(run_maps({"--images", frames.pattern(), "-o", frames.out(), "--stats", stats}).code, 0);
    std::ifstream stream(stats);
    const nlohmann::json json = nlohmann::json::parse(stream);
    EXPECT_EQ(json["frames"].size(), 2u);
    EXPECT_EQ(json["frames"][0]["estimate"]["replaced"], 2);
    EXPECT_EQ(json["frames"][0]["rays"]["total"], 0);
    EXPECT_EQ(json["settings"]["motion"], "image");
    EXPECT_EQ(json["settings"]["size"], "72x56");
    for (const char* stage : {"estimate", "motion", "perception", "write", "total"}) {
        EXPECT_GT(json["frames"][0]["seconds"][stage].get<double>(), 0.0) << stage;
    }
    const ChannelImage maps = frames.maps(1);
    for (const float v : maps.find("aleph.Y")->pixels) EXPECT_TRUE(v >= 1.0f && v <= 251.0f);
}

TEST(MapsImages, SameBytesForAnyThreadsOrderAndCompany) {
    const Frames frames(1, 3);
    const auto bytes_of_frame_2 = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {"--images", frames.pattern(), "-o", frames.out()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_EQ(run_maps(arguments).code, 0);
        std::ifstream stream(frames.folder.path() / "out" / "f-maps.0002.exr", std::ios::binary);
        std::ostringstream text;
        text << stream.rdbuf();
        return text.str();
    };
    const std::string alone = bytes_of_frame_2({"--frames", "2", "-t", "1"});
    EXPECT_EQ(alone, bytes_of_frame_2({"-t", "2"}));
    EXPECT_EQ(alone, bytes_of_frame_2({"--frames", "3,1,2"}));
}

/// Exit code 2, one line that holds every part.
void expect_refusal(const std::vector<std::string>& arguments, const std::vector<std::string>& parts) {
    const Ran ran = run_maps(arguments);
    EXPECT_EQ(ran.code, 2) << ran.errors;
    EXPECT_EQ(std::count(ran.errors.begin(), ran.errors.end(), '\n'), 1) << ran.errors;
    for (const std::string& part : parts)
        EXPECT_NE(ran.errors.find(part), std::string::npos) << part << ": " << ran.errors;
}

TEST(MapsImages, GapsAreRefusedByName) {
    const Frames frames(1, 4);
    fs::remove(frames.file(3));
    const std::string out = frames.out();
    expect_refusal({"--images", frames.pattern(), "-o", out},
                   {"frame 3 is missing", "f.0002.exr", "f.0004.exr", "--cuts 4"});
    expect_refusal({"--images", frames.pattern(), "-o", out, "--frames", "2"}, {"frame 3 is missing"});
    expect_refusal({"--images", frames.pattern(), "-o", out, "--frames", "1-3"}, {"frame 3 is"});
    expect_refusal({"--images", frames.pattern(), "-o", out, "--frames", "9"}, {"frame 9 is not there", "from 1 to 4"});
    EXPECT_FALSE(fs::exists(out));
    EXPECT_EQ(run_maps({"--images", frames.pattern(), "-o", out, "--frames", "1"}).code, 0);
    EXPECT_EQ(run_maps({"--images", frames.pattern(), "-o", out, "--cuts", "4"}).code, 0);
}

TEST(MapsImages, SizesMustAgree) {
    const Frames frames(1, 2);
    frames.write(3, make_pattern(20, 10, [](int, int) { return 0.5; }));
    expect_refusal({"--images", frames.pattern(), "-o", frames.out()}, {"f.0003.exr", "20x10", "f.0001.exr", "72x56"});
}

TEST(MapsImages, RefusesWhatItCannotMean) {
    const Frames frames(1, 2);
    const std::string pattern = frames.pattern(), folder = frames.folder.path().string();
    expect_refusal({}, {"--images"});
    expect_refusal({"--images", pattern, "scene.json"}, {"--images", "quotes"});
    expect_refusal({"--images", frames.file(1).string(), frames.file(2).string()}, {"quotes"});
    expect_refusal({"--images", folder}, {"folder", "name.####.exr"});
    expect_refusal({"--images", folder + "/g.####.exr"}, {"no file fits"});
    expect_refusal({"--images", folder + "/f.##.exr"}, {"f.0001.exr would"});
    expect_refusal({"--images", folder + "/none.exr"}, {"no such file"});
    expect_refusal({"--images", "/no/such/f.####.exr"}, {"no such folder"});
    expect_refusal({"--images", folder + "/f.%x.exr"}, {"after '%'"});
    expect_refusal({"--images", pattern, "--motion", "model"}, {"motion", "needs a scene"});
    expect_refusal({"--images", pattern, "--size", "64x48"}, {"size", "needs a scene"});
    expect_refusal({"--images", pattern, "--camera", "main"}, {"--camera"});
    expect_refusal({"--images", pattern, "--exposure", "0"}, {"--exposure"});
    expect_refusal({"--images", pattern, "--cuts", "x"}, {"--cuts"});
    expect_refusal({"--images", pattern, "--fps", "0"}, {"--fps"});
    expect_refusal({"--images", pattern, "-o", "maps.####.png"}, {"write .exr"});
    expect_refusal({"--images", pattern, "-o", pattern}, {"pictures themselves"});
    expect_refusal({"scene.json", "--cuts", "3"}, {"--cuts"});
}

TEST(MapsImages, UnreadablePicturesAreNamed) {
    const Frames frames(1, 2);
    std::ofstream(frames.file(2)) << "not a picture";
    expect_refusal({"--images", frames.pattern(), "-o", frames.out()}, {"f.0002.exr"});
    ChannelImage depth;
    depth.channels.push_back({"Z", Image<float>(width, height)});
    write_exr(frames.file(2), depth);
    expect_refusal({"--images", frames.pattern(), "-o", frames.out()}, {"f.0002.exr", "channels R, G and B"});
}

}  // namespace
}  // namespace aleph
