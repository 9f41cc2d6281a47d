// `aleph maps --images`: pictures of other programs, with layers, motion and depth of their own; the files that a
// pattern names; and what is refused.

#include "engine/image/image_file.h"
#include "render/images/image_sequence.h"
#include "render/settings/frame_pattern.h"
#include "tests/render/cli/maps_images.h"

namespace aleph {
namespace {

void add_flat(ChannelImage& file, const std::string& name, float value) {
    file.channels.push_back({name, Image<float>(width, height, value)});
}

ChannelImage in_layer(const std::string& layer, int frame) {
    ChannelImage file = make_color_image(picture(frame));
    for (Channel& channel : file.channels) channel.name = layer + '.' + channel.name;
    return file;
}

/// A frame as Blender writes it: something that moves 3 pixels to the right and 2 up, before a far background.
ChannelImage blender_frame(int frame) {
    ChannelImage file = in_layer("ViewLayer.Combined", frame);
    for (const auto& [name, value] : {std::pair("Vector.X", -1.0f),
                                      {"Vector.Y", 7.0f},
                                      {"Vector.Z", -3.0f},
                                      {"Vector.W", -2.0f},
                                      {"Depth.Z", 5.0f}})
        add_flat(file, std::string("ViewLayer.") + name, value);
    return file;
}

Image<float>& channel(ChannelImage& file, const std::string& name) {
    return const_cast<Image<float>&>(*file.find(name));
}

template <class Make>
Ran maps_of(const Frames& frames, const Make& make, const Words& options = {}) {
    for (const int frame : {1, 2}) write_exr(frames.file(frame), make(frame));
    return frames.run(options);
}

TEST(MapsLayers, BlendersPassesAreReadWithTheirSigns) {
    const Frames frames(1, 0);
    const Ran ran = maps_of(frames, [](int frame) {
        ChannelImage file = blender_frame(frame);
        channel(file, "ViewLayer.Vector.Z")(0, 0) = channel(file, "ViewLayer.Vector.W")(0, 0) = 0.0f;
        channel(file, "ViewLayer.Depth.Z")(0, 0) = 1e10f;
        channel(file, "ViewLayer.Vector.Z")(5, 5) = float_nan;
        return file;
    });
    ASSERT_EQ(ran.code, 0) << ran.errors;
    for (const int frame : {1, 2}) {
        const ChannelImage maps = frames.maps(frame);
        const auto at = [&](const char* name, int x, int y) { return (*maps.find(name))(x, y); };
        EXPECT_EQ(at("forward.u", 30, 30), 3.0f);
        EXPECT_EQ(at("forward.v", 30, 30), 2.0f);
        EXPECT_EQ(at("motion.valid", 30, 30), 1.0f);
        EXPECT_EQ(at("Z", 30, 30), 5.0f);
        EXPECT_EQ(at("motion.valid", 0, 0), 0.0f) << "background";
        EXPECT_EQ(at("motion.valid", 5, 5), -3.0f) << "not a number";
        EXPECT_EQ(at("forward.u", 5, 5), 0.0f);
        EXPECT_EQ(at("motion.valid", width - 1, 30), -2.0f) << "leaves the picture";
        EXPECT_EQ(maps.find("estimate.G")->pixels, make_color_image(picture(frame)).channels[1].values.pixels);
        EXPECT_NEAR(at("velocity.image", 30, 30), std::hypot(3.0, 2.0) / 31.0 * 30.0, 1e-4);
        EXPECT_THAT(std::get<std::string>(maps.metadata.at("motion:definition")), HasSubstr("the picture's file"));
    }
}

TEST(MapsLayers, OurOwnMotionComesBackAsItWas) {
    const Frames frames(1, 0);
    const auto own = [](int frame) {
        ChannelImage file = make_color_image(picture(frame));
        for (const auto& [name, value] : {std::pair("forward.u", 1.25f),
                                          {"forward.v", -0.5f},
                                          {"motion.valid", 1.0f},
                                          {"backward.u", -1.5f},
                                          {"backward.v", 0.25f},
                                          {"backward.valid", -4.0f}})
            add_flat(file, name, value);
        channel(file, "motion.valid")(3, 4) = -4.0f;
        add_flat(file, "Z", 2.0f);
        return file;
    };
    ASSERT_EQ(maps_of(frames, own, {"--cuts", "2"}).code, 0);
    const ChannelImage cut = frames.maps(1), maps = frames.maps(2);
    for (const char* name : {"forward.u", "forward.v", "motion.valid", "Z"}) {
        EXPECT_EQ(maps.find(name)->pixels, own(2).find(name)->pixels) << name;
    }
    for (const char* name : {"backward.u", "backward.v", "backward.valid"}) {
        EXPECT_EQ((*maps.find(name))(9, 9), name == std::string("backward.valid") ? -3.0f : 0.0f) << "behind a cut";
        EXPECT_EQ(cut.find(name)->pixels, own(1).find(name)->pixels) << name;
    }
    EXPECT_EQ((*cut.find("forward.u"))(9, 9), 0.0f);
    EXPECT_EQ((*cut.find("motion.valid"))(9, 9), -3.0f) << "a cut has no motion";
}

/// A path may be longer than the way from end to end: the speed tells it, as a share of the file's own frame rate.
TEST(MapsLayers, SpeedsOfOurOwnFilesComeBackAsTheyWere) {
    const Frames frames(1, 0);
    const auto own = [](int frame) {
        ChannelImage file = make_color_image(picture(frame));
        for (const auto& [name, value] :
             {std::pair("forward.u", 0.0f), {"forward.v", 0.5f}, {"motion.valid", 1.0f}, {"velocity.image", 51.5f}})
            add_flat(file, name, value);
        channel(file, "velocity.image")(2, 3) = float_nan;
        file.metadata["framesPerSecond"] = std::array<int, 2>{24000, 1001};
        file.metadata["pixelsPerDegree"] = 27.3;
        return file;
    };
    ASSERT_EQ(maps_of(frames, own).code, 0);
    const Image<float> speeds = *frames.maps(1).find("velocity.image");
    EXPECT_EQ(speeds(30, 30), 51.5f);
    EXPECT_NEAR(speeds(2, 3), 0.5 / 27.3 * 24000.0 / 1001.0, 1e-6) << "not a number";
    const auto without = [&](int frame) {
        ChannelImage file = own(frame);
        file.metadata.erase("pixelsPerDegree");
        return file;
    };
    const Frames others(1, 0);
    ASSERT_EQ(maps_of(others, without).code, 0);
    EXPECT_LT((*others.maps(1).find("velocity.image"))(30, 30), 1.0f);
}

TEST(MapsLayers, FramesWithMotionMayHaveGaps) {
    const Frames frames(1, 0);
    for (const int frame : {1, 5}) write_exr(frames.file(frame), blender_frame(frame));
    EXPECT_EQ(frames.run().code, 0);
    expect_answer(frames.run({"--motion-layer", "none"}), 2, "frames 2 to 4 are missing");
}

TEST(MapsLayers, NoneComparesThePictures) {
    const Frames frames(1, 0);
    ASSERT_EQ(maps_of(frames, blender_frame, {"--motion-layer", "none", "--depth-layer", "none"}).code, 0);
    const ChannelImage maps = frames.maps(1);
    EXPECT_NEAR((*maps.find("forward.u"))(36, 28), 4.0, 0.2);
    EXPECT_NEAR((*maps.find("forward.v"))(36, 28), -8.0, 0.2);
    EXPECT_EQ(maps.find("Z"), nullptr);
}

TEST(MapsLayers, LayersAreChosenByName) {
    const Frames frames(1, 0);
    const auto several = [](int frame) {
        ChannelImage file = blender_frame(frame);
        for (Channel& other : in_layer("Other.Combined", frame + 7).channels) file.channels.push_back(other);
        for (const char* c : {"X", "Y", "Z", "W"}) add_flat(file, std::string("Other.Speed.") + c, 1.0f);
        return file;
    };
    expect_answer(maps_of(frames, several), 2,
                  "several layers hold colour: Other.Combined, ViewLayer.Combined; choose one with "
                  "--layer");
    ASSERT_EQ(maps_of(frames, several, {"--layer", "Other.Combined", "--motion-layer", "Other.Speed"}).code, 0);
    EXPECT_EQ(frames.maps(1).find("estimate.R")->pixels, make_color_image(picture(8)).channels[0].values.pixels);
    EXPECT_EQ((*frames.maps(1).find("forward.u"))(30, 30), -1.0f);
}

TEST(MapsLayers, WhatIsNotThereIsRefused) {
    const Frames frames(1, 0);
    const auto refused = [&](const Words& options, const std::string& message) {
        expect_answer(maps_of(frames, blender_frame, options), 2, message);
        EXPECT_FALSE(std::filesystem::exists(frames.out())) << "written before the layer was looked for";
    };
    refused({"--layer", "ViewLayer.Combind"}, "did you mean \"ViewLayer.Combined\"");
    refused({"--layer", "ViewLayer.Depth"}, "a frame needs channels R, G and B, or Y");
    refused({"--motion-layer", "ViewLayer.Depth"}, "motion needs channels u and v, or X, Y, Z and W");
    refused({"--depth-layer", "ViewLayer.Combined"}, "depth needs a channel Z");
}

TEST(MapsLayers, AFrameWithoutMotionAmongFramesWithIt) {
    const Frames frames(1, 0);
    const auto make = [](int frame) { return frame == 1 ? blender_frame(1) : in_layer("ViewLayer.Combined", 2); };
    expect_answer(maps_of(frames, make), 2, "f.0002.exr: this frame has no motion");
}

void expect_refusal(const std::vector<std::string>& arguments, const std::vector<std::string>& parts) {
    const Ran ran = run_maps(arguments);
    EXPECT_EQ(ran.code, 2) << ran.errors;
    EXPECT_EQ(std::count(ran.errors.begin(), ran.errors.end(), '\n'), 1) << ran.errors;
    for (const std::string& part : parts) EXPECT_THAT(ran.errors, HasSubstr(part));
}

TEST(MapsImages, GapsAreRefusedByName) {
    const Frames frames(1, 4);
    fs::remove(frames.file(3));
    const std::string out = frames.out();
    expect_refusal({"--images", frames.pattern(), "-o", out},
                   {"frame 3 is missing", "f.0002.exr", "f.0004.exr", "--cuts 4"});
    expect_refusal({"--images", frames.pattern(), "-o", out, "--frames", "1-3"}, {"frame 3 is"});
    expect_refusal({"--images", frames.pattern(), "-o", out, "--frames", "9"}, {"frame 9 is not there", "from 1 to 4"});
    EXPECT_FALSE(fs::exists(out));
    for (const char* stretch : {"1", "1-2", "4"}) EXPECT_EQ(frames.run({"--frames", stretch}).code, 0) << stretch;
    EXPECT_EQ(frames.run({"--cuts", "4"}).code, 0);
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
    for (const char* source : {"model", "raster"})
        expect_refusal({"--images", pattern, "--motion", source}, {"motion", source, "needs a scene"});
    expect_refusal({"--images", pattern, "--size", "64x48"}, {"size", "needs a scene"});
    expect_refusal({"--images", pattern, "--camera", "main"}, {"--camera"});
    expect_refusal({"--images", pattern, "--exposure", "0"}, {"--exposure"});
    expect_refusal({"--images", pattern, "--cuts", "x"}, {"--cuts"});
    expect_refusal({"--images", pattern, "--fps", "0"}, {"--fps"});
    expect_refusal({"--images", pattern, "-o", "maps.####.hdr"}, {"possible are .exr and .png"});
    expect_refusal({"--images", pattern, "-o", pattern}, {"--output", "is read by this command"});
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

TEST(MapsImages, FindsFilesByPattern) {
    const ScratchFolder folder;
    for (const char* name : {"f.0001.exr", "f.0010.exr", "f.-003.exr", "f.12345.exr", "f.00011.exr", "f.1.exr",
                             "f.0002.exr.part", "g.0001.exr", "f.x.exr", "f..exr"}) {
        std::ofstream(folder / name) << "x";
    }
    std::vector<std::int64_t> numbers;
    for (const auto& [number, path] : find_frame_files((folder / "f.####.exr").string())) {
        numbers.push_back(number);
        EXPECT_TRUE(fs::exists(path));
    }
    EXPECT_EQ(numbers, (std::vector<std::int64_t>{-3, 1, 10, 12345}));
    EXPECT_EQ(find_frame_files((folder / "f.%d.exr").string()).size(), 2u);  // 1 and 12345
}

TEST(MapsImages, TheOtherFrameOfAFrame) {
    FrameFiles files;
    for (const int frame : {1, 2, 3, 10, 11}) files[frame] = "f";
    const std::vector<std::int64_t> cuts = {10};
    EXPECT_EQ(find_other_frame(files, cuts, 1), OtherFrame::next);
    EXPECT_EQ(find_other_frame(files, cuts, 3), OtherFrame::none);
    EXPECT_EQ(find_other_frame(files, cuts, 11), OtherFrame::previous);
    EXPECT_EQ(find_other_frame(files, {}, 3), OtherFrame::previous) << "before a gap";
    EXPECT_EQ(find_other_frame(files, {}, 10), OtherFrame::next) << "behind a gap";
    EXPECT_EQ(find_other_frame({{1, "f"}, {5, "f"}}, {}, 1), OtherFrame::none);
    EXPECT_EQ(find_other_frame(files, {2, 3}, 2), OtherFrame::none);
    EXPECT_THROW(find_other_frame(files, cuts, 4), InputError);
    EXPECT_THROW(find_other_frame({}, cuts, 4), InputError);
    EXPECT_EQ(find_other_frame({{5, "f"}}, {}, 5), OtherFrame::none);
}

TEST(MapsImages, AGapIsRefusedWhereFramesOfBothSidesAreAsked) {
    FrameFiles files;
    for (const int frame : {1, 2, 3, 10, 11}) files[frame] = "f";
    EXPECT_NO_THROW(refuse_gaps(files, {}, {1, 2, 3}));
    EXPECT_NO_THROW(refuse_gaps(files, {10}, {1, 2, 3, 10, 11}));
    EXPECT_THAT(find_refusal([&] {
                    refuse_gaps(files, {}, {1, 2, 3, 10, 11});
                }).message,
                HasSubstr("frames 4 to 9 are missing"));
    EXPECT_THROW(refuse_gaps(files, {}, {4}), InputError);
}

TEST(MapsOfAScene, HaveNoLayers) {
    for (const char* option : {"--layer", "--motion-layer", "--depth-layer"})
        expect_answer(run_command({"maps", (source_folder() / "scenes/cornell/scene.json").string(), option, "x"}), 2,
                      std::string(option) + ": a scene has no layers");
}

}  // namespace
}  // namespace aleph
