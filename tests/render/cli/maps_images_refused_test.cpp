// `aleph maps --images`: the error messages for pictures and options that it cannot use.
// `aleph maps --images`: the files that a pattern names, and the frame that each is compared with.

#include "engine/image/image_file.h"
#include "render/images/image_sequence.h"
#include "render/settings/frame_pattern.h"
#include "tests/render/cli/maps_images.h"

namespace aleph {
namespace {

/// Exit code 2, one line that holds every part.
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

}  // namespace
}  // namespace aleph
