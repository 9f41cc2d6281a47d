// Films whose render is stopped or killed, is divided among processes, or whose ffmpeg fails.

#include "tests/render/cli/answers.h"
#include "tests/support/film_programs.h"

namespace aleph {
namespace {

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
