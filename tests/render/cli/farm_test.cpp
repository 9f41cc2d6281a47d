// `aleph farm`: frames divided into tasks, in any order and more than once, are those of one process.

#include <sys/stat.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "engine/image/image_file.h"
#include "render/cli/farm/farm_job.h"
#include "render/settings/fingerprint.h"
#include "render/settings/frame_list.h"
#include "tests/render/cli/answers.h"

namespace aleph {
namespace {

TEST(FrameList, IsWrittenAsItIsRead) {
    for (const char* text : {"7", "1-4", "1-3,7,9-10", "-5--3,-1-2", "4,3,2", "1-9x4", "1,5-6,20-40x10,7"})
        EXPECT_EQ(format_frame_list(parse_frame_list(text)), text);
    EXPECT_EQ(format_frame_list({}), "");
    EXPECT_EQ(format_frame_list({1, 5, INT_MIN, INT_MAX}), "1,5,-2147483648,2147483647");
}

TEST(Farm, TasksHaveAllFramesOnceInOrder) {
    for (const int tasks : {1, 2, 3, 7, 12, 50}) {
        const std::vector<int> frames = parse_frame_list("-2-3,10-20x2");
        const std::vector<std::string> parts = divide_frames(frames, tasks);
        EXPECT_EQ(parts.size(), std::min<std::size_t>(tasks, frames.size()));
        std::vector<int> joined;
        std::size_t least = frames.size(), most = 0;
        for (const std::string& part : parts) {
            const std::vector<int> own = parse_frame_list(part);
            joined.insert(joined.end(), own.begin(), own.end());
            least = std::min(least, own.size());
            most = std::max(most, own.size());
        }
        EXPECT_EQ(joined, frames);
        EXPECT_LE(most - least, 1u);
    }
}

TEST(Farm, WordsAreQuotedForTheShell) {
    EXPECT_EQ(quote_words({"aleph", "render", "it's $HOME.json", "", "--set", "a=1"}),
              "aleph render 'it'\\''s $HOME.json' '' --set a=1");
}

/// Changes a byte before the last rows, so that only decoding all of the file finds it.
void damage_pixels(const fs::path& file) {
    const std::string whole = read_bytes(file);
    for (std::size_t at = whole.size() / 2; at < whole.size(); at += 16) {
        std::string bytes = whole;
        bytes[at] = static_cast<char>(bytes[at] ^ 0x55);
        std::ofstream(file, std::ios::binary) << bytes;
        const bool decodes = find_refusal([&] { read_image(file); }).message.empty();
        if (!decodes && read_picture_text(file, fingerprint_key)) return;
    }
    FAIL() << "every change is in the last rows";
}

class FarmTest : public ProgramTest {
  protected:
    FarmTest() {
        fs::create_directories(folder_ / "it's a folder");
        write_sliding_box(scene_);
        words_ = {scene_, "--frames", "1-10", "--size", "32x24", "--gather", "16", "--spp", "1", "--checkpoint", "60"};
    }

    Words with(const Words& begin, const Words& end) const { return joined(joined(begin, words_), end); }
    /// Runs a task of the first round as a scheduler does.
    int run_task(int task, const std::string& round = "1") const {
        const std::string command = "cd / && SLURM_ARRAY_TASK_ID=" + std::to_string(task) + " bash " +
                                    quote_words({out_ / "farm" / ("task." + round + ".sh")}) + " >/dev/null 2>&1";
        return WEXITSTATUS(std::system(command.c_str()));
    }
    std::string status(const std::string& verb = "status") const { return ask({verb, out_.string()}); }
    /// @param words  what follows `aleph farm`
    std::string ask(const Words& words) const {
        const std::string command = quote_words(joined({program_path("aleph"), "farm"}, words)) + " >" +
                                    quote_words({folder_ / "status"}) + " 2>&1";
        code_ = WEXITSTATUS(std::system(command.c_str()));
        return read_bytes(folder_ / "status");
    }

    const fs::path scene_ = folder_ / "it's a folder/scene.json", out_ = folder_ / "it's a folder/out";
    Words words_;
    mutable int code_ = 0;
};

TEST_F(FarmTest, WhateverTheTasksTheFramesAreThoseOfOneProcess) {
    ASSERT_EQ(run(with({"render"}, {"-o", folder_ / "whole/", "-q"})).code, 0);
    const fs::path stats = folder_ / "stats.json";
    const Ended written = run(with({"farm", "slurm"}, {"-o", out_ / "", "--stats", stats, "--tasks", "4"}));
    ASSERT_EQ(written.code, 0) << written.err;
    EXPECT_EQ(status(), "frames: 0 of 10 finished\nmissing: 10 (1-10)\n");
    EXPECT_EQ(code_, 1);
    for (const int task : {2, 0, 3, 0}) EXPECT_EQ(run_task(task), 0) << task;
    EXPECT_EQ(status(), "frames: 7 of 10 finished\nmissing: 3 (3-5)\n");
    EXPECT_EQ(run_task(1), 0);
    const std::vector<std::string> names = names_in(folder_ / "whole");
    const auto expect_whole = [&] {
        for (const std::string& name : names)
            EXPECT_EQ(read_bytes(out_ / name), read_bytes(folder_ / "whole" / name)) << name;
    };
    expect_whole();
    EXPECT_EQ(status("collate"), "frames: 10 of 10 finished\n");
    EXPECT_EQ(code_, 0);
    const auto statistics = nlohmann::json::parse(read_bytes(stats));
    ASSERT_EQ(statistics.at("frames").size(), 10u);
    for (int i = 0; i < 10; ++i) EXPECT_EQ(statistics["frames"][i].at("frame"), i + 1);

    fs::resize_file(out_ / names[3], 700);
    damage_pixels(out_ / names[5]);
    fs::copy_file(out_ / names[0], out_ / names[8], fs::copy_options::overwrite_existing);
    EXPECT_EQ(status("collate"),
              "frames: 7 of 10 finished\ndamaged: 2 (4,6)\n"
              "of another scene, other settings or another program: 1 (9)\n");
    EXPECT_EQ(code_, 1);
    for (const int task : {0, 1, 2, 3}) EXPECT_EQ(run_task(task), 0);
    expect_whole();
}

TEST_F(FarmTest, MapsAndStudiesAreDividedToo) {
    const Ended written = run({"farm", "slurm", scene_, "--frames", "1-4", "--size", "32x24", "-o", out_ / "",
                               "--tasks", "2", "--command", "maps"});
    ASSERT_EQ(written.code, 0) << written.err;
    EXPECT_EQ(run_task(0), 0);
    EXPECT_EQ(run_task(1), 0);
    EXPECT_EQ(status(), "frames: 4 of 4 finished\n");
    EXPECT_TRUE(fs::exists(out_ / "it's a folder-maps.0004.exr"));

    const fs::path file = folder_ / "study.json", study = folder_ / "study";
    std::ofstream(file) << R"({"scenes": [{"scene": ")" << scene_.string() << R"(", "frames": "1,2"}], "size": "16x12",
        "reference": {"passes": 2, "spp": 1}, "sweep": {"spp": [1, 2]}})";
    ASSERT_EQ(run({"farm", "slurm", file, "-o", study, "--tasks", "3", "--cpus", "1"}).code, 0);
    EXPECT_EQ(ask({"status", study}), "references: 0 of 2 finished\nruns: 0 of 2 finished\n");
    EXPECT_EQ(code_, 1);
    for (const int task : {2, 1, 0}) {
        const std::string command =
            "SLURM_CPUS_PER_TASK=1 bash " + (study / "farm/task.1.sh").string() + " " + std::to_string(task);
        EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 0) << task;
    }
    EXPECT_EQ(names_in(study / "runs").size(), 6u) << "two runs with two pictures each";
    EXPECT_FALSE(fs::exists(study / "study.json"));
    EXPECT_EQ(ask({"status", study}), "references: 2 of 2 finished\nruns: 2 of 2 finished\n");
    EXPECT_EQ(code_, 0);
    EXPECT_THAT(ask({"collate", study}), HasSubstr("0 runs made, 2 found finished"));
    EXPECT_EQ(code_, 0);
    EXPECT_TRUE(fs::exists(study / "report.html"));
    fs::remove(study / "runs" / names_in(study / "runs").front());
    EXPECT_THAT(ask({"status", study}), HasSubstr("runs: 1 of 2 finished\n"));
    EXPECT_EQ(code_, 1);
    ask({"collate", study, "--submit"});
    EXPECT_TRUE(fs::exists(study / "farm/submit.2.sh"));
}

TEST_F(FarmTest, AnotherJobDoesNotTakeTheFolder) {
    const auto job = [&](const Words& more) {
        return run(joined(with({"farm", "parallel"}, {"-o", out_ / "", "--stats", folder_ / "stats.json"}), more));
    };
    ASSERT_EQ(job({"--tasks", "2"}).code, 0);
    ASSERT_EQ(job({"--tasks", "3", "--jobs", "2"}).code, 0) << "another round of the same";
    const std::string first = read_bytes(out_ / "farm/job.json");
    for (const Words& other : {Words{"--frames", "11-12"}, {"--spp", "2"}, {"--stats", folder_ / "other.json"}})
        expect_answer(job(joined(other, {"--tasks", "2"})), 1, "this is the folder of another job");
    EXPECT_EQ(read_bytes(out_ / "farm/job.json"), first);
    EXPECT_FALSE(fs::exists(out_ / "farm/task.3.sh"));
}

TEST_F(FarmTest, SlurmWritesLogsInFoldersOfAnyName) {
    ASSERT_EQ(run(with({"farm", "slurm"}, {"-o", out_ / "50%a/", "--tasks", "2"})).code, 0);
    EXPECT_THAT(read_bytes(out_ / "50%a/farm/task.1.sh"), HasSubstr("/50%%a/farm/task.1-%a.log"));
    EXPECT_THAT(read_bytes(out_ / "50%a/farm/submit.1.sh"), HasSubstr("/50%%a/farm/collate.1.log"));
}

TEST_F(FarmTest, RequestsAreAsSlurmReadsThem) {
    for (const char* time : {"90", "90:30", "2:00:00", "1-12", "1-12:30", "1-12:30:00"}) {
        const Words words =
            with({"farm", "slurm"}, {"-o", out_ / "", "--tasks", "2", "--time", time, "--memory", "4G"});
        EXPECT_EQ(run(words).code, 0) << time;
    }
    EXPECT_THAT(read_bytes(out_ / "farm/task.6.sh"), HasSubstr("#SBATCH --time=1-12:30:00\n"));
    EXPECT_THAT(read_bytes(out_ / "farm/task.6.sh"), HasSubstr("#SBATCH --mem=4G\n"));
}

TEST_F(FarmTest, WhatCannotBeDividedIsRefused) {
    const auto refused = [&](const Words& words, const std::string& part) { expect_answer(run(words), 2, part); };
    refused(with({"farm", "slurm"}, {"-o", out_ / "", "--tasks", "0"}), "--tasks: expected 1 to");
    refused(with({"farm", "slurm"}, {"--tasks", "2"}), "--output: name the files");
    refused(with({"farm", "slurm"}, {"-o", out_ / "one.exr", "--tasks", "2"}), "need a number in the name");
    refused(with({"farm", "slurm"}, {"-o", out_ / "", "--tasks", "2", "--taks", "3"}),
            "there is no option --taks; did you mean \"--tasks\"");
    refused(with({"farm", "slurm"}, {"-o", out_ / "", "--tasks", "2", "--importance"}),
            "--importance: `aleph render` has no such option, only maps");
    refused(with({"farm", "slurm"}, {"-o", out_ / "", "--tasks", "2", "--aovs", "--command", "maps"}),
            "--aovs: `aleph maps` has no such option, only render");
    refused(with({"farm", "slurm"}, {"-o", out_ / "a\nb/", "--tasks", "2"}), "a name has a line break");
    refused(with({"farm", "slurm"}, {"-o", out_ / "a\xff/", "--tasks", "2"}), "a name or a path is not UTF-8");
    const Words to_slurm = with({"farm", "slurm"}, {"-o", out_ / "", "--tasks", "2"}),
                to_parallel = with({"farm", "parallel"}, {"-o", out_ / "", "--tasks", "2"});
    for (const char* time : {"2h", "1:2:3:4", "1-", "-1", "1-2:3:4:5", "2:00:00 "})
        refused(joined(to_slurm, {"--time", time}), "--time: '");
    for (const char* memory : {"4GB", "4.5G", "-1", "G"})
        refused(joined(to_slurm, {"--memory", memory}), "--memory: '");
    refused(joined(to_slurm, {"--time", std::string(100000, '1') + "h"}), "--time: '");
    refused(joined(to_slurm, {"--cpus", "-1"}), "--cpus: '-1': expected 0");
    refused(joined(to_parallel, {"--jobs", "0"}), "--jobs: '0': expected 1 or more");
    for (const char* hosts : {"", ",", "one,,two", "one,"})
        refused(joined(to_parallel, {"--hosts", hosts}), "--hosts: ");
    refused({"farm"}, "commands: slurm, parallel, status, collate; aleph farm --help describes them");
    refused({"farm", "status", folder_.path().string()}, "there is no job of `aleph farm` in this folder");
    fs::create_directories(out_ / "farm");
    std::ofstream(out_ / "farm/job.json") << "{}";
    refused({"farm", "status", out_.string()}, "this is not as `aleph farm` wrote it");
    EXPECT_FALSE(fs::exists(out_ / "farm/task.1.sh"));
}

TEST_F(FarmTest, ATaskThatIsNotInTheListMakesNothing) {
    ASSERT_EQ(run(with({"farm", "slurm"}, {"-o", out_ / "", "--tasks", "2"})).code, 0);
    EXPECT_EQ(run_task(99), 2);
    EXPECT_EQ(status().substr(0, 9), "frames: 0");
}

/// GNU parallel gives its words to a shell once more.
TEST_F(FarmTest, ParallelRunsInFoldersOfAnyName) {
    if (std::system("command -v parallel >/dev/null") != 0) GTEST_SKIP() << "GNU parallel is not installed";
    const fs::path out = folder_ / "a b$c'd`e";
    ASSERT_EQ(run(with({"farm", "parallel"}, {"-o", out / "", "--tasks", "2", "--submit"})).code, 0);
    EXPECT_EQ(names_in(out).size(), 10u + 1u) << "frames, and the folder of the job";
}

}  // namespace
}  // namespace aleph
