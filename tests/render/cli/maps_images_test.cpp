// `aleph maps --images`: maps of pictures without a scene.

#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <variant>

#include "engine/image/image_file.h"
#include "motion/picture_motion.h"
#include "render/images/image_sequence.h"
#include "tests/render/cli/maps_images.h"

namespace aleph {
namespace {

float median_of(const Image<float>& image) {
    std::vector<float> values = image.pixels;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

TEST(MapsImages, WritesTheChannelsThatNeedNoGeometry) {
    const Frames frames(1, 3);
    const Ran ran = frames.run();
    ASSERT_EQ(ran.code, 0) << ran.errors;
    EXPECT_EQ(ran.errors, "");
    const ChannelImage maps = frames.maps(2);
    std::vector<std::string> names;
    for (const Channel& channel : maps.channels) names.push_back(channel.name);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(fmt::format("{}", fmt::join(names, " ")),
              "aleph.Y alpha.acc backward.u backward.v backward.valid conspicuity.color conspicuity.intensity "
              "conspicuity.motion conspicuity.orientation estimate.B estimate.G estimate.R forward.u forward.v "
              "motion.valid saliency.Y threshold.Y threshold.noise velocity.image velocity.retinal");
    EXPECT_FALSE(maps.metadata.contains("worldToCamera"));
    EXPECT_EQ((std::get<std::array<int, 2>>(maps.metadata.at("framesPerSecond"))), (std::array<int, 2>{30, 1}));
    for (const Channel& channel : maps.channels) {
        for (const float v : channel.values.pixels) ASSERT_TRUE(std::isfinite(v)) << channel.name;
    }
}

TEST(MapsImages, MotionIsYUpForwardAndBackwardAtTheLastFrame) {
    const Frames frames(1, 3);
    ASSERT_EQ(frames.run({"--fps", "24"}).code, 0);
    for (const int frame : {1, 2, 3}) {
        const ChannelImage maps = frames.maps(frame);
        EXPECT_NEAR(median_of(*maps.find("forward.u")), 4.0, 0.1) << frame;
        EXPECT_NEAR(median_of(*maps.find("forward.v")), -8.0, 0.1) << frame;
        EXPECT_EQ(median_of(*maps.find("motion.valid")), 1.0f) << frame;
        EXPECT_NEAR(median_of(*maps.find("velocity.image")), std::hypot(4.0, 8.0) / 31.0 * 24.0, 0.1) << frame;
        // The picture itself is the estimate.
        EXPECT_EQ(maps.find("estimate.G")->pixels, make_color_image(picture(frame)).channels[1].values.pixels);
    }
}

TEST(MapsImages, EqualsTheStagesByHand) {
    const Frames frames(1, 2);
    ASSERT_EQ(frames.run({"--guide", "full", "--motion", "census"}).code, 0);
    const MotionField field = compute_image_motion(picture(1), picture(2));
    const MotionField back = compute_image_motion(picture(2), picture(1));
    const ChannelImage maps = frames.maps(1), next = frames.maps(2);
    for (std::size_t i = 0; i < field.displacement.size(); ++i) {
        EXPECT_EQ(maps.find("forward.u")->pixels[i], field.displacement.pixels[i].x);
        EXPECT_EQ(maps.find("forward.v")->pixels[i], 0.0 - field.displacement.pixels[i].y);
        EXPECT_EQ(maps.find("backward.u")->pixels[i], 0.0 - field.displacement.pixels[i].x) << "of the first frame";
        EXPECT_EQ(next.find("backward.u")->pixels[i], back.displacement.pixels[i].x);
        EXPECT_EQ(next.find("forward.u")->pixels[i], 0.0 - back.displacement.pixels[i].x);
    }
    EXPECT_EQ(maps.find("saliency.Y"), nullptr);  // guide full has no saliency map
}

TEST(MapsImages, TheSourceOfMotionIsOpticalFlowUnlessAnotherIsNamed) {
    const Frames frames(1, 2);
    const auto source = [&](const Words& more) {
        EXPECT_EQ(frames.run(joined({"--frames", "1"}, more)).code, 0);
        return std::get<std::string>(frames.maps(1).metadata.at("aleph:motion"));
    };
    EXPECT_EQ(source({}), has_flow() ? "flow" : "image");
    const std::vector<float> best = frames.maps(1).find("forward.u")->pixels;
    EXPECT_EQ(source({"--motion", "census"}), "census");
    EXPECT_NE(frames.maps(1).find("forward.u")->pixels, best);
    EXPECT_EQ(source({"--motion", "image"}), "image");
}

TEST(MapsImages, MotionToTheFrameBeforeIsThatOfThisFrameAndNothingMovesAcrossACut) {
    const Frames frames(1, 4);
    testing::internal::CaptureStderr();
    ASSERT_EQ(run_command({"maps", "--images", frames.pattern(), "-o", frames.out(), "--cuts", "3,99"}).code, 0);
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("--cuts: frame 99 lies outside the shot"));
    for (const int frame : {1, 2, 4}) {
        EXPECT_NEAR(median_of(*frames.maps(frame).find("backward.u")), -4.0, 0.1) << frame;
        EXPECT_NEAR(median_of(*frames.maps(frame).find("backward.v")), 8.0, 0.1) << frame;
        EXPECT_EQ(median_of(*frames.maps(frame).find("backward.valid")), 1.0f) << frame;
    }
    const ChannelImage cut = frames.maps(3);
    for (const float v : cut.find("backward.u")->pixels) EXPECT_EQ(v, 0.0f) << "behind a cut";
    for (const float v : cut.find("backward.valid")->pixels) EXPECT_EQ(v, -3.0f);
    EXPECT_EQ(median_of(*frames.maps(2).find("forward.u")), 0.0f);
    EXPECT_EQ(median_of(*frames.maps(2).find("motion.valid")), -3.0f);
    for (const int frame : {1, 3, 4})  // the last one's from the frame before
        EXPECT_NEAR(median_of(*frames.maps(frame).find("forward.u")), 4.0, 0.1) << frame;
}

TEST(MapsImages, ASingleFrameStandsStill) {
    const Frames frames(7, 7);
    ASSERT_EQ(run_maps({"--images", frames.file(7).string(), "-o", (frames.folder / "still.exr").string()}).code, 0);
    const ChannelImage maps = read_image(frames.folder / "still.exr");
    for (const float v : maps.find("velocity.image")->pixels) EXPECT_EQ(v, 0.0f);
    for (const float v : maps.find("motion.valid")->pixels) EXPECT_EQ(v, -3.0f);
    EXPECT_NE(maps.find("saliency.Y"), nullptr);
}

TEST(MapsImages, ExposureAndViewingReachTheMaps) {
    const Frames frames(1, 2);
    const auto threshold = [&](const Words& more) {
        EXPECT_EQ(frames.run(joined({"--frames", "1"}, more)).code, 0);
        return median_of(*frames.maps(1).find("threshold.Y"));
    };
    const float plain = threshold({});
    EXPECT_GT(threshold({"--exposure", "8"}), 2.0f * plain);
    EXPECT_EQ(threshold({"--set", "exposure=8"}), threshold({"--exposure", "8"}));
    EXPECT_GT(threshold({"--set", "viewing.display_white=800"}), 2.0f * plain);
    threshold({"--set", "viewing.pixels_per_degree=62"});
    EXPECT_NEAR(median_of(*frames.maps(1).find("velocity.image")), std::hypot(4.0, 8.0) / 62.0 * 30.0, 0.1);
}

TEST(MapsImages, TheFirstFrameNamesRateAndViewing) {
    const Frames frames(2, 2);
    ChannelImage first = make_color_image(picture(1));
    first.metadata["framesPerSecond"] = std::array<int, 2>{24000, 1001};
    first.metadata["pixelsPerDegree"] = 40.0;
    first.metadata["whiteLuminance"] = 200.0;
    first.metadata["displayPersistence"] = 0.25;
    write_exr(frames.file(1), first);
    ASSERT_EQ(frames.run().code, 0);
    const ChannelImage maps = frames.maps(1);
    EXPECT_NEAR(median_of(*maps.find("velocity.image")), std::hypot(4.0, 8.0) / 40.0 * 24000.0 / 1001.0, 0.1);
    EXPECT_EQ(std::get<double>(maps.metadata.at("whiteLuminance")), 200.0);
    EXPECT_EQ(std::get<double>(maps.metadata.at("displayPersistence")), 0.25);
    ASSERT_EQ(frames.run({"--fps", "30"}).code, 0);
    EXPECT_NEAR(median_of(*frames.maps(1).find("velocity.image")), std::hypot(4.0, 8.0) / 40.0 * 30.0, 0.1);
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
    EXPECT_NEAR(median_of(*maps.find("forward.u")), 4.0, 0.1);
}

TEST(MapsImages, OneChannelIsGrey) {
    const ScratchFolder folder;
    ChannelImage grey;
    grey.channels.push_back({"Y", make_color_image(picture(0)).channels[0].values});
    write_exr(folder / "y.exr", grey);
    const Image<Rgb> loaded = read_picture_frame(folder / "y.exr").color;
    EXPECT_EQ(loaded.pixels, picture(0).pixels);
}

TEST(MapsImages, BadPixelsAreCountedNotSpread) {
    const Frames frames(1, 2);
    Image<Rgb> damaged = picture(1);
    damaged(10, 10) = Rgb(float_nan);
    damaged(40, 30) = Rgb(float_infinity, 0.0f, 0.0f);
    frames.write(1, damaged);
    const std::string stats = (frames.folder / "stats.json").string();
    ASSERT_EQ(frames.run({"--stats", stats}).code, 0);
    const nlohmann::json json = nlohmann::json::parse(read_bytes(stats));
    EXPECT_EQ(json["frames"].size(), 2u);
    EXPECT_EQ(json["frames"][0]["estimate"]["replaced"], 2);
    EXPECT_EQ(json["frames"][0]["rays"]["total"], 0);
    EXPECT_EQ(json["settings"]["motion"], has_flow() ? "flow" : "image");
    EXPECT_EQ(json["settings"]["size"], "72x56");
    for (const char* stage : {"estimate", "motion", "perception", "write", "total"}) {
        EXPECT_GT(json["frames"][0]["seconds"][stage].get<double>(), 0.0) << stage;
    }
    const ChannelImage maps = frames.maps(1);
    for (const float v : maps.find("aleph.Y")->pixels) EXPECT_TRUE(v >= 1.0f && v <= 251.0f);
}

TEST(MapsImages, SameBytesForAnyThreadsOrderAndCompany) {
    const Frames frames(1, 3);
    const auto bytes_of_frame_2 = [&](const Words& more) {
        EXPECT_EQ(frames.run(more).code, 0);
        return read_bytes(frames.folder.path() / "out" / "f-maps.0002.exr");
    };
    for (const char* motion : has_flow() ? std::vector{"image", "flow"} : std::vector{"image"}) {
        const std::string alone = bytes_of_frame_2({"--motion", motion, "--frames", "2", "-t", "1"});
        EXPECT_EQ(alone, bytes_of_frame_2({"--motion", motion, "-t", "2"}));
        EXPECT_EQ(alone, bytes_of_frame_2({"--motion", motion, "--frames", "3,1,2"}));
    }
}

/// The picture as it is, and five maps (MapPreview).
TEST(MapsImages, APngShowsTheMapsToPeople) {
    const Frames frames(1, 2);
    const std::string out = (frames.folder / "preview.####.png").string();
    ASSERT_EQ(run_maps({"--images", frames.pattern(), "-o", out}).code, 0);
    const ChannelImage preview = read_image(frames.folder / "preview.0001.png");
    constexpr int caption = 26;
    ASSERT_EQ(preview.channels[0].values.width, 3 * width);
    ASSERT_EQ(preview.channels[0].values.height, 2 * (height + caption));
    const float expected = linear_to_srgb(std::clamp(picture(1)(30, 20).x, 0.0f, 1.0f));
    EXPECT_NEAR((*preview.find("R"))(30, 20 + caption), expected, 0.6 / 255.0) << "the picture as it is";
}

}  // namespace
}  // namespace aleph
