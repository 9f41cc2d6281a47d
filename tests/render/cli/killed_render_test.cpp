// A render that is stopped or killed: finished frames stay whole, and --resume makes the others.

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "engine/image/image_file.h"
#include "tests/render/cli/answers.h"

namespace aleph {
namespace {

class KilledRender : public ProgramTest {
  protected:
    KilledRender() {
        write_sliding_box(folder_ / "scene.json");
        fs::create_directory(folder_ / "out");
        fs::create_directory(folder_ / "whole");
    }

    Words words(const std::string& frames, const fs::path& output, const Words& more = {}) const {
        const Words words{"render", folder_ / "scene.json", "--frames", frames, "-o", output, "--size", "32x24"};
        return joined(joined(words, {"--gather", "16", "--spp", "1", "-q"}), more);
    }

    /// The files are those of a render that was not stopped, and nothing else is there.
    void expect_whole() const {
        EXPECT_EQ(names_in(folder_ / "out"), names_in(folder_ / "whole"));
        for (const std::string& name : names_in(folder_ / "whole")) {
            EXPECT_TRUE(read_bytes(folder_ / "out" / name) == read_bytes(folder_ / "whole" / name)) << name;
        }
    }
};

using Inodes = std::map<std::string, ino_t>;

/// Frames that are written again get new numbers.
Inodes inodes_in(const fs::path& folder) {
    Inodes found;
    for (const std::string& name : names_in(folder)) {
        struct stat status {};
        if (!name.starts_with('.') && ::stat((folder / name).c_str(), &status) == 0) found[name] = status.st_ino;
    }
    return found;
}

TEST_F(KilledRender, OU07_StoppedBySignalsItLeavesWholeFramesAndNothingElse) {
    ASSERT_EQ(run(words("1-40", folder_ / "whole/f.####.exr")).code, 0);
    for (const auto& [signal, resume, code] :
         {std::tuple(SIGINT, false, 130), std::tuple(SIGTERM, false, 143), std::tuple(SIGTERM, true, 75)}) {
        SCOPED_TRACE(code);
        FolderEvents events(folder_ / "out");
        StartedProgram program(words("1-5000", folder_ / "out/f.####.exr", resume ? Words{"--resume"} : Words{}),
                               folder_ / "log");
        ASSERT_TRUE(events.wait(IN_MOVED_TO, 2, program));
        program.send(signal);
        expect_answer(program.wait(), code, "of 5000 frames are finished");
        const auto names = names_in(folder_ / "out");
        EXPECT_GE(names.size(), 2u);
        for (const std::string& name : names) {
            ASSERT_TRUE(name.starts_with("f.")) << name;
            if (!fs::exists(folder_ / "whole" / name)) continue;
            EXPECT_TRUE(read_bytes(folder_ / "out" / name) == read_bytes(folder_ / "whole" / name)) << name;
        }
    }
}

TEST_F(KilledRender, ASignalBeforeTheFirstFrameIsResumedToo) {
    for (const Words& words : {words("1-5000", folder_ / "out/f.####.exr", {"--resume"}),
                               Words{"maps", folder_ / "scene.json", "-o", folder_ / "out/m.####.exr", "--resume"}}) {
        FolderEvents events(folder_ / "out");
        StartedProgram program(words, folder_ / "log");
        ASSERT_TRUE(events.wait(IN_CREATE, 1, program)) << "the trial of a name";
        program.send(SIGTERM);
        expect_answer(program.wait(), 75, "stopped by SIGTERM");
    }
}

TEST_F(KilledRender, ASecondInterruptEndsItAtOnce) {
    FolderEvents events(folder_ / "out");
    // The frame takes longer than the test: one stage of a million samples.
    const Words endless =
        words("1", folder_ / "out/f.exr", {"--sampling", "uniform", "--spp", "65536", "--size", "2000x2000"});
    StartedProgram program(endless, folder_ / "log");
    ASSERT_TRUE(events.wait(IN_CREATE, 1, program));
    program.send(SIGINT);
    program.send(SIGINT);
    const Ended ended = program.wait();
    EXPECT_TRUE(ended.signal == SIGINT || ended.code == 130) << ended.code;
}

TEST_F(KilledRender, KilledAnywhereAResumedRenderCompletesIt) {
    const Words stats{"--stats", folder_ / "out.json", "--resume"};
    ASSERT_EQ(run(words("1-12", folder_ / "whole/f.####.exr")).code, 0);
    // Every frame is created under a temporary name and renamed; the lock file and trials of names come first.
    for (int event = 1; event <= 60; event += 7) {
        SCOPED_TRACE(event);
        for (const std::string& name : names_in(folder_ / "out")) fs::remove(folder_ / "out" / name);
        Inodes before;
        {
            FolderEvents events(folder_ / "out");
            StartedProgram program(words("1-12", folder_ / "out/f.####.exr", stats), folder_ / "log");
            events.wait(IN_CREATE | IN_MOVED_TO, event, program);
            program.send(SIGKILL);
            program.wait();
            before = inodes_in(folder_ / "out");
        }
        EXPECT_EQ(run(words("1-12", folder_ / "out/f.####.exr", stats)).code, 0);
        expect_whole();
        const Inodes after = inodes_in(folder_ / "out");
        for (const auto& [name, inode] : before) EXPECT_EQ(after.at(name), inode) << name << " was made again";
        const auto statistics = nlohmann::json::parse(read_bytes(folder_ / "out.json"));
        ASSERT_EQ(statistics.at("frames").size(), 12u);
        for (int i = 0; i < 12; ++i) EXPECT_EQ(statistics["frames"][i].at("frame"), i + 1);
        EXPECT_FALSE(fs::exists(folder_ / ".out.json.rows"));
    }
}

TEST_F(KilledRender, WhatIsCutOrOfSomethingElseIsMadeAgain) {
    for (const std::string ending : {"exr", "png"}) {
        SCOPED_TRACE(ending);
        const std::string output = folder_ / ("out/f.####." + ending);
        const auto file = [&](int frame) { return folder_ / "out" / fmt::format("f.{:04}.{}", frame, ending); };
        ASSERT_EQ(run(words("1-5", output)).code, 0);
        const std::string bytes = read_bytes(file(2));
        const Inodes before = inodes_in(folder_ / "out");
        fs::resize_file(file(2), fs::file_size(file(2)) - 20);
        fs::copy_file(file(4), file(3), fs::copy_options::overwrite_existing);
        std::ofstream(file(5)) << "no picture";
        ASSERT_EQ(run(words("1-5", output, {"--resume"})).code, 0);
        const Inodes after = inodes_in(folder_ / "out");
        for (const int frame : {1, 4}) {
            const std::string name = file(frame).filename();
            EXPECT_EQ(after.at(name), before.at(name)) << frame;
        }
        EXPECT_EQ(read_bytes(file(2)), bytes);
        EXPECT_NE(read_bytes(file(3)), read_bytes(file(4)));
        write_sliding_box(folder_ / "scene.json", "31");
        ASSERT_EQ(run(words("1-5", output, {"--resume"})).code, 0);
        EXPECT_NE(read_bytes(file(2)), bytes) << "the scene has changed";
        write_sliding_box(folder_ / "scene.json");
        ASSERT_EQ(run(words("1-5", output, {"--resume", "--seed", "7"})).code, 0);
        const std::string seeded = read_bytes(file(2));
        EXPECT_NE(seeded, bytes) << "a setting has changed";
        ASSERT_EQ(run(words("1-5", output, {"--resume"})).code, 0);
        EXPECT_EQ(read_bytes(file(2)), bytes);
    }
}

TEST_F(KilledRender, MapsAndTheLightOfKeyframesAreResumed) {
    const auto maps = [&](const fs::path& output) {
        return Words{"maps",    folder_ / "scene.json", "--frames", "1-4", "--size", "32x24", "-q", "-o", output,
                     "--resume"};
    };
    ASSERT_EQ(run(maps(folder_ / "whole/m.####.exr")).code, 0);
    ASSERT_EQ(run(maps(folder_ / "out/m.####.exr")).code, 0);
    const Inodes before = inodes_in(folder_ / "out");
    fs::remove(folder_ / "out/m.0003.exr");
    ASSERT_EQ(run(maps(folder_ / "out/m.####.exr")).code, 0);
    expect_whole();
    EXPECT_EQ(inodes_in(folder_ / "out").at("m.0002.exr"), before.at("m.0002.exr"));

    const auto lit = [&](const std::string& name) {
        return words("1-12", folder_ / name / "f.####.exr",
                     {"--cache", folder_ / (name + ".light"), "--light-step", "3", "--accuracy", ".2", "--resume"});
    };
    ASSERT_EQ(run(lit("whole")).code, 0);
    {
        FolderEvents events(folder_ / "out");
        StartedProgram program(lit("out"), folder_ / "log");
        ASSERT_TRUE(events.wait(IN_MOVED_TO, 5, program));
        program.send(SIGKILL);
        program.wait();
    }
    ASSERT_EQ(run(lit("out")).code, 0);
    EXPECT_EQ(read_bytes(folder_ / "out.light"), read_bytes(folder_ / "whole.light"));
    EXPECT_EQ(read_bytes(folder_ / "out/f.0012.exr"), read_bytes(folder_ / "whole/f.0012.exr"));
}

TEST_F(KilledRender, HiddenFilesBesideStatisticsAndLightGo) {
    const Words lit = words("1-2", folder_ / "out/f.####.exr",
                            {"--stats", folder_ / "out/s.json", "--cache", folder_ / "out/l", "--light-step", "3",
                             "--accuracy", ".2", "--resume"});
    ASSERT_EQ(run(lit).code, 0);
    const Words names = names_in(folder_ / "out");
    for (const std::string name : {"s.json", "l", "f.0001.exr", ".f.0001.exr.checkpoint"})
        std::ofstream(folder_ / "out" / ("." + name + ".1234567890123.part")) << "part";
    EXPECT_EQ(run(lit).code, 0);
    EXPECT_EQ(names_in(folder_ / "out"), names);
}

TEST_F(KilledRender, TwoProcessesDivideTheFramesOrRefuse) {
    const Words divided = words("1-12", folder_ / "out/f.####.exr", {"--resume"});
    ASSERT_EQ(run(words("1-12", folder_ / "whole/f.####.exr")).code, 0);
    {
        StartedProgram one(divided, folder_ / "one"), other(divided, folder_ / "other");
        EXPECT_EQ(one.wait().code, 0);
        EXPECT_EQ(other.wait().code, 0);
    }
    expect_whole();
    fs::remove_all(folder_ / "out");
    fs::create_directory(folder_ / "out");
    FolderEvents events(folder_ / "out");
    StartedProgram program(words("1-5000", folder_ / "out/f.####.exr"), folder_ / "log");
    ASSERT_TRUE(events.wait(IN_MOVED_TO, 1, program));
    const auto refused = [&](const Words& words, const std::string& part) {
        expect_answer(StartedProgram(words, folder_ / "other").wait(), 1, part);
    };
    refused(words("4000-4003", folder_ / "out/f.####.exr"), "another process makes this frame");
    refused(words("4000-4003", folder_ / "out/f.####.exr", {"--seed", "2", "--resume"}),
            "another process renders these files from another scene or with other settings");
    EXPECT_EQ(StartedProgram(words("4000", folder_ / "out/g.####.exr", {"--seed", "2"}), folder_ / "other").wait().code,
              0)
        << "other files in the same folder";
    program.send(SIGTERM);
    program.wait();
    EXPECT_EQ(run(words("4000", folder_ / "out/f.####.exr", {"--seed", "2"})).code, 0);
    for (const std::string& name : names_in(folder_ / "out")) EXPECT_FALSE(name.starts_with('.')) << name;
}

TEST_F(KilledRender, AStudyThatIsStoppedGoesOn) {
    fs::create_directories(folder_ / "study/references");
    const Words study{"study", folder_ / "scene.json", "--frames", "1",  "--size",          "16x12", "--sweep",
                      "spp=1", "--reference-passes",   "100",      "-o", folder_ / "study", "-q",    "-t",
                      "1",     "--reference-spp",      "1"};
    FolderEvents events(folder_ / "study/references");
    StartedProgram program(study, folder_ / "log");
    ASSERT_TRUE(events.wait(IN_MOVED_TO, 1, program)) << "no pass was finished";
    program.send(SIGTERM);
    expect_answer(program.wait(), 75, "stopped by SIGTERM: finished passes and runs are kept; the same command goes");
    EXPECT_EQ(names_in(folder_ / "study/references").size(), 1u);
    EXPECT_EQ(run(joined(study, {"--status"})).code, 1);
    EXPECT_EQ(run(study).code, 0);
    EXPECT_EQ(run(joined(study, {"--status"})).code, 0);
}

TEST_F(KilledRender, AFrameGoesOnFromItsCheckpoint) {
    // Later options count. The frame takes seconds, in which it is asked how far it is, stopped, killed and finished.
    const auto long_frame = [&](const fs::path& output, const Words& more) {
        return joined(words("7", output, {"--size", "120x90", "--spp", "80", "--accuracy", "0"}), more);
    };
    const fs::path file = folder_ / "out/f.exr", state = folder_ / "out/.f.exr.checkpoint";
    ASSERT_EQ(run(long_frame(folder_ / "whole/f.exr", {})).code, 0);
    const Words kept = long_frame(file, {"--checkpoint", "0.05"});
    {
        FolderEvents events(folder_ / "out");
        StartedProgram program(kept, folder_ / "log");
        ASSERT_TRUE(events.wait(IN_MOVED_TO, 1, program)) << "no state was written";
        program.send(SIGUSR1);
        while (!fs::exists(folder_ / "out/f.partial.exr")) ASSERT_TRUE(events.wait(IN_MOVED_TO, 1, program));
        program.send(SIGTERM);
        const Ended ended = program.wait();
        EXPECT_EQ(ended.code, 143) << "without --resume the same command begins anew";
        EXPECT_THAT(ended.err, HasSubstr("0 of 1 frames are finished; frame 7: shade"));
        EXPECT_EQ(names_in(folder_ / "out"), (Words{".f.exr.checkpoint", "f.partial.exr"}));
        EXPECT_EQ(read_image(folder_ / "out/f.partial.exr").channels.size(), 3u);
    }
    const std::string first = read_bytes(state);
    const Words resumed = joined(kept, {"--resume"});
    {
        FolderEvents events(folder_ / "out");
        StartedProgram program(resumed, folder_ / "log");
        ASSERT_TRUE(events.wait(IN_MOVED_TO, 1, program));
        program.send(SIGKILL);
        program.wait();
    }
    EXPECT_NE(read_bytes(state), first) << "it went on";
    EXPECT_EQ(run(resumed).code, 0);
    expect_whole();
    std::ofstream(state, std::ios::binary) << first;  // killed between the frame's file and the end
    EXPECT_EQ(run(resumed).code, 0);
    expect_whole();
}

/// Files of at most so many bytes can be written: a full disk without a disk. That of the frame is smaller.
TEST_F(KilledRender, OU05_TheFrameIsKeptWhereWhatIsBesideItCannotBeWritten) {
    const Words lit{"--cache", folder_ / "light", "--light-step", "3", "--accuracy", ".2"};
    const Words shared = joined(lit, {"--cache", folder_ / "lights/"});
    const Words stats{"--stats", folder_ / "out.json"}, checkpoint{"--checkpoint", "1e-6", "--spp", "4"};
    const Words paths{"--integrator", "path", "--sampling", "uniform", "--spp", "2000"},
        limited{"--resume", "--time-limit", "1e-6"}, none;
    for (const auto& [beside, more, code] :
         {std::tuple(lit, none, 1), {shared, none, 1}, {stats, none, 1}, {checkpoint, none, 0}, {paths, limited, 75}}) {
        SCOPED_TRACE(beside.back());
        ASSERT_EQ(run(words("1", folder_ / "whole/f.png", beside)).code, 0);
        fs::remove(folder_ / "light");
        fs::remove_all(folder_ / "lights");
        fs::remove(folder_ / "out.json");
        const rlim_t most = fs::file_size(folder_ / "whole/f.png") + 200;
        const char* const frames = code == 75 ? "1-5000" : "1-3";  // more than the limit leaves time for
        StartedProgram program(words(frames, folder_ / "out/f.#.png", joined(beside, more)), folder_ / "log", [most] {
            const rlimit limit{most, most};
            ::setrlimit(RLIMIT_FSIZE, &limit);
        });
        const Ended ended = program.wait();
        expect_answer(ended, code, "cannot write: File too large\n");
        EXPECT_TRUE(read_bytes(folder_ / "out/f.1.png") == read_bytes(folder_ / "whole/f.png"));
    }
}

TEST_F(KilledRender, APictureOfSomebodyElseIsKept) {
    std::ofstream(folder_ / "out/f.partial.exr") << "theirs";
    ASSERT_EQ(run(words("1", folder_ / "out/f.exr")).code, 0);
    EXPECT_EQ(read_bytes(folder_ / "out/f.partial.exr"), "theirs");
}

TEST_F(KilledRender, WhatCannotBeResumedIsSaid) {
    for (const std::string option : {"--budget", "--verify"})
        expect_answer(run_command(words("1-2", folder_ / "out/f.####.exr", {"--resume", option, "10"})), 2,
                      "--resume: " + option);
}

}  // namespace
}  // namespace aleph
