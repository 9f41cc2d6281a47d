// Films: their frames, rate, size and colours; what is refused, and what is left behind.

#include "tests/render/cli/answers.h"
#include "tests/support/film_programs.h"

namespace aleph {
namespace {

/// A coloured box that passes coloured walls in nine frames.
void write_passing_box(const fs::path& path) {
    std::ofstream(path) << R"({"aleph": 1, "exposure": 1, "fps": "30000/1001", "frames": [1, 9], "nodes": [
        {"translation": [0, 1, 5], "camera": {"fov": 40}}, {"translation": [0, 3, 2], "light": {"type": "point", "intensity": 30}},
        {"shape": {"type": "quad", "size": [9, 9]}, "rotation": {"axis": [1, 0, 0], "degrees": -90},
         "material": {"base_color": [0.7, 0.2, 0.1]}},
        {"shape": {"type": "quad", "size": [9, 9]}, "translation": [0, 0, -2], "material": {"base_color": [0.1, 0.2, 0.8]}},
        {"shape": {"type": "box", "size": [1, 1, 1]}, "translation": {"keys": [[1, [-1, 0.5, 0]], [9, [1, 0.5, 0]]]},
         "material": {"base_color": [0.1, 0.8, 0.2]}}]})";
}

class Films : public ProgramTest {
  protected:
    Films() {
        write_passing_box(folder_ / "scene.json");
        fs::create_directory(folder_ / "out");
    }

    Words words(const std::string& command, const std::string& output, const Words& more = {}) const {
        return joined({command, folder_ / "scene.json", "-o", folder_ / "out" / output, "-t", "2"}, more);
    }
    Ended render(const std::string& output, const Words& more = {}) const {
        return run(words("render", output, joined({"--size", "64x48", "--gather", "16", "--spp", "4"}, more)));
    }

    /// The frame as a PNG file of the same command.
    ChannelImage png(int frame, const Words& more = {}) const {
        const std::string name = fmt::format("../f{}.png", frame);
        EXPECT_EQ(render(name, joined(more, {"--frames", std::to_string(frame)})).code, 0);
        return read_image(folder_ / "out" / name);
    }
    Words left() const { return names_in(folder_ / "out"); }
};

TEST_F(Films, HasTheFramesOfThePictures) {
    std::vector<ChannelImage> expected;
    for (const int frame : {4, 5, 6}) expected.push_back(png(frame));
    for (const std::string ending : {"mp4", "webm", "gif"}) {
        SCOPED_TRACE(ending);
        const std::string name = "film." + ending;
        expect_answer(render(name, {"--frames", "4-6"}), 0, ": 3 frames of 64x48, 30000/1001 a second\n");
        EXPECT_EQ(left(), Words{name});
        const fs::path film = folder_ / "out" / name;
        const std::vector<ChannelImage> frames = decode_film(film);
        ASSERT_EQ(frames.size(), expected.size());
        for (std::size_t i = 0; i < frames.size(); ++i) expect_alike(frames[i], expected[i], 10.0);
        if (ending == "gif") {
            EXPECT_EQ(probe_film(film, "codec_name,width,height,nb_read_frames"), "gif,64,48,3");
        } else {
            EXPECT_EQ(probe_film(film,
                                 "width,height,pix_fmt,color_range,color_space,color_transfer,color_primaries,"
                                 "r_frame_rate,nb_read_frames"),
                      "64,48,yuv420p,tv,bt709,bt709,bt709,30000/1001,3");
        }
        fs::remove(film);
    }
}

TEST_F(Films, LastsAsLongAsItsFramesWhereSomeAreLeftOut) {
    ASSERT_EQ(render("film.mp4", {"--frames", "1-9x4"}).code, 0);
    EXPECT_EQ(probe_film(folder_ / "out/film.mp4", "r_frame_rate,avg_frame_rate,nb_read_frames"),
              "7500/1001,7500/1001,3");
    ASSERT_EQ(render("one.mov", {"--frames", "5"}).code, 0);
    EXPECT_EQ(probe_film(folder_ / "out/one.mov", "codec_name,r_frame_rate,nb_read_frames"), "h264,30000/1001,1");
}

TEST_F(Films, OddSizesRepeatTheLastColumnAndRow) {
    const Words odd{"--size", "63x47"};
    const Ended ended = render("film.mp4", {"--frames", "5", "--size", "63x47"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("63x47, 30000/1001 a second; the last column or row stands twice"));
    const std::vector<ChannelImage> frames = decode_film(folder_ / "out/film.mp4");
    ASSERT_EQ(frames.size(), 1u);
    ASSERT_EQ(frames[0].find("R")->width, 64);
    ASSERT_EQ(frames[0].find("R")->height, 48);
    expect_alike(frames[0], png(5, odd), 10.0);
    for (const char* channel : {"R", "G", "B"}) {
        EXPECT_NEAR((PicturePartMeans{63, 64, 0, 47}.mean(frames[0], channel)),
                    (PicturePartMeans{62, 63, 0, 47}.mean(frames[0], channel)), 2.0);
        EXPECT_NEAR((PicturePartMeans{0, 63, 47, 48}.mean(frames[0], channel)),
                    (PicturePartMeans{0, 63, 46, 47}.mean(frames[0], channel)), 2.0);
    }
}

TEST_F(Films, OfMapsHasThePicturesOfMaps) {
    // The last frame has the motion of the one before; their pictures have one size.
    ASSERT_EQ(run(words("maps", "maps.mp4", {"--size", "64x48", "--frames", "8-9"})).code, 0);
    ASSERT_EQ(run(words("maps", "../m.png", {"--size", "64x48", "--frames", "9"})).code, 0);
    const std::vector<ChannelImage> frames = decode_film(folder_ / "out/maps.mp4");
    ASSERT_EQ(frames.size(), 2u);
    expect_alike(frames[1], read_image(folder_ / "out/../m.png"), 16.0);  // small letters in colour
    EXPECT_EQ(left(), Words{"maps.mp4"});
}

TEST_F(Films, WhatCannotBeAFilmIsRefusedAndLeavesNothing) {
    const std::vector<std::tuple<std::string, Words, std::string>> cases{
        {"film.mp5", {}, "the extension .mp5 is not known; possible are .exr and .png"},
        {"film.####.mp4", {}, "a film has no frame number"},
        {"film.mp4", {"--aovs"}, "films cannot hold the channels of maps"},
        {"film.mp4", {"--frames", "1-3,5"}, "frame 5 follows frame 3: a film has frames at one distance"},
        {"film.gif", {"--fps", "60"}, "a GIF has at most 50 frames a second, the film 60"},
        {"film.mp4", {"--stats", folder_ / "out/film.mp4"}, "is written twice"},
        {"film.mp4", {"--camera", "nobody"}, "nobody"}};
    for (const auto& [name, more, part] : cases) {
        expect_answer(render(name, more), 2, part);
        EXPECT_EQ(left(), Words{}) << part;
    }
}

}  // namespace
}  // namespace aleph
