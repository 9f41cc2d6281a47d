// Films: their frames, rate, size and colours; what is refused, and what is left behind. Films whose render is stopped
// or killed, is divided among processes, or whose ffmpeg fails.

#include "tests/render/cli/answers.h"
#include "tests/support/film_programs.h"

namespace aleph {
namespace {

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

class StoppedFilm : public ProgramTest {
  protected:
    StoppedFilm() {
        write_sliding_box(folder_ / "scene.json");
        fs::create_directories(frames_);
    }

    Words words(const std::string& output, const Words& more = {}) const {
        const Words words{"render", folder_ / "scene.json", "-o", folder_ / "out" / output, "-t", "1"};
        return joined(joined(words, {"--frames", "1-6", "--size", "32x24", "--gather", "16", "--spp", "1"}), more);
    }

    const fs::path frames_ = folder_ / "out/.film.mp4.frames";
};

ino_t inode_of(const fs::path& file) {
    struct stat status {};
    return ::stat(file.c_str(), &status) == 0 ? status.st_ino : 0;
}

TEST_F(StoppedFilm, KilledAnywhereAResumedRenderCompletesIt) {
    ASSERT_EQ(run(words("whole.mp4", {"-q"})).code, 0);
    const std::string whole = read_bytes(folder_ / "out/whole.mp4");
    fs::remove(folder_ / "out/whole.mp4");
    for (int event = 1; event <= 21; event += 10) {
        SCOPED_TRACE(event);
        fs::remove(folder_ / "out/film.mp4");
        fs::create_directories(frames_);
        ino_t first = 0;
        {
            FolderEvents events(frames_);
            StartedProgram program(words("film.mp4", {"--resume"}), folder_ / "log");
            events.wait(IN_CREATE | IN_MOVED_TO, event, program);
            program.send(SIGKILL);
            program.wait();
            first = inode_of(frames_ / "frame.0001.png");
        }
        if (first != 0) {  // an ffmpeg that ends at once shows which frames are there, and keeps them
            write_fake_ffmpeg(folder_ / "bin", "exit 1");
            const ScopedPath path(folder_ / "bin");
            EXPECT_EQ(run(words("film.mp4", {"--resume"})).code, 1);
            EXPECT_EQ(inode_of(frames_ / "frame.0001.png"), first);
        }
        ASSERT_EQ(run(words("film.mp4", {"--resume"})).code, 0);
        EXPECT_TRUE(read_bytes(folder_ / "out/film.mp4") == whole);
        EXPECT_EQ(names_in(folder_ / "out"), Words{"film.mp4"});
    }
    const ino_t before = inode_of(folder_ / "out/film.mp4");
    expect_answer(run(words("film.mp4", {"--resume"})), 0, "film.mp4 is finished");
    EXPECT_EQ(inode_of(folder_ / "out/film.mp4"), before);
    EXPECT_EQ(names_in(folder_ / "out"), Words{"film.mp4"});
    // A film that is cut is made again.
    fs::resize_file(folder_ / "out/film.mp4", whole.size() - 1);
    ASSERT_EQ(run(words("film.mp4", {"--resume"})).code, 0);
    EXPECT_TRUE(read_bytes(folder_ / "out/film.mp4") == whole);
}

TEST_F(StoppedFilm, ASignalKeepsTheFrames) {
    FolderEvents events(frames_);
    StartedProgram program(words("film.mp4", {"--resume", "--frames", "1-5000"}), folder_ / "log");
    ASSERT_TRUE(events.wait(IN_MOVED_TO, 2, program));
    program.send(SIGTERM);
    EXPECT_EQ(program.wait().code, 75);
    EXPECT_EQ(names_in(folder_ / "out"), Words{".film.mp4.frames"});
    EXPECT_TRUE(fs::exists(frames_ / "frame.0001.png"));
}

TEST_F(StoppedFilm, ProcessesDivideTheFramesAndMakeOneFilm) {
    ASSERT_EQ(run(words("whole.gif", {"-q"})).code, 0);
    const Words both = words("film.gif", {"-q", "--resume"});
    StartedProgram one(both, folder_ / "log1"), other(both, folder_ / "log2");
    for (StartedProgram* each : {&one, &other}) EXPECT_EQ(each->wait().code, 0);
    EXPECT_TRUE(read_bytes(folder_ / "out/film.gif") == read_bytes(folder_ / "out/whole.gif"));
    Words left = names_in(folder_ / "out");
    std::erase(left, ".film.gif.frames");  // empty: whether it stays depends on who ends last
    EXPECT_EQ(left, (Words{".film.mp4.frames", "film.gif", "whole.gif"}));
}

TEST_F(StoppedFilm, AnFfmpegThatFailsIsQuotedAndTheFramesAreKept) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"echo 'Unknown encoder' >&2; exit 1", "ffmpeg: failed with exit code 1: Unknown encoder; the frames are kept"},
        {"cat >&2 </dev/null; while read -r line; do :; done; printf 'a\\033[31m\\377%0100000d' 7 >&2; exit 3",
         "failed with exit code 3: "},
        {"while read -r line; do :; done", "ffmpeg: wrote no film; the frames are kept"},
        {"kill -9 $$", "ffmpeg: was ended by a signal"}};
    for (const auto& [script, part] : cases) {
        SCOPED_TRACE(script);
        write_fake_ffmpeg(folder_ / "bin", script);
        const ScopedPath path(folder_ / "bin");
        const Ended ended = run(words("film.mp4", {"-q"}));
        EXPECT_EQ(ended.code, 1);
        EXPECT_THAT(ended.err, HasSubstr(part));
        EXPECT_LT(ended.err.size(), 5000u);
        EXPECT_EQ(ended.err.find('\033'), std::string::npos);
        EXPECT_EQ(names_in(folder_ / "out"), Words{".film.mp4.frames"});
        EXPECT_EQ(names_in(frames_).size(), 6u);
    }
    ASSERT_EQ(run(words("film.mp4", {"-q", "--resume"})).code, 0);
    EXPECT_EQ(probe_film(folder_ / "out/film.mp4", "nb_read_frames"), "6");
}

TEST_F(StoppedFilm, AnFfmpegThatHangsIsKilledByASignal) {
    fs::create_directory(folder_ / "started");
    const ScopedPath path(folder_ / "bin");
    write_fake_ffmpeg(folder_ / "bin", fmt::format("PATH={}; echo $$ >'{}'; mv '{}' '{}'; exec sleep 100000",
                                                   path.before(), (folder_ / "id").string(), (folder_ / "id").string(),
                                                   (folder_ / "started/id").string()));
    FolderEvents events(folder_ / "started");
    StartedProgram program(words("film.mp4", {"-q"}), folder_ / "log");
    ASSERT_TRUE(events.wait(IN_MOVED_TO, 1, program));
    const pid_t ffmpeg = std::stoi(read_bytes(folder_ / "started/id"));
    EXPECT_EQ(::kill(ffmpeg, 0), 0);
    program.send(SIGINT);
    expect_answer(program.wait(), 130, "all frames are finished, the film is not");
    EXPECT_NE(::kill(ffmpeg, 0), 0);
    EXPECT_EQ(names_in(folder_ / "out"), Words{".film.mp4.frames"});
}

}  // namespace
}  // namespace aleph
