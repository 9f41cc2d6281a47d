// Renders under a limit of time: the same command again and again makes what one without a limit makes.

#include "tests/render/cli/answers.h"

namespace aleph {
namespace {

class TimeLimit : public ProgramTest {
  protected:
    TimeLimit() {
        write_sliding_box(folder_ / "scene.json");
        for (const char* const name : {"out", "whole"}) fs::create_directory(folder_ / name);
    }

    Words words(const char* folder, const Words& more) const {
        const Words words{"render", folder_ / "scene.json", "-o", folder_ / folder / "f.#.exr", "--size", "32x24"};
        return joined(joined(words, {"-t", "1", "-q"}), more);
    }

    /// The time is up before anything is made.
    void expect_made_in_pieces(const Words& more) const {
        constexpr int most_pieces = 1000;  // of work
        EXPECT_EQ(run(words("whole", more)).code, 0);
        for (int i = 0; i < most_pieces; ++i) {
            const Ended ended = run(joined(words("out", more), {"--resume", "--time-limit", "1e-6"}));
            if (ended.code == 0) break;
            expect_answer(ended, 75, "frames are finished; the same command goes on with the others");
            const std::vector<std::string> names = names_in(folder_ / "out");
            EXPECT_FALSE(names.empty());
            if (names.empty() || HasFailure()) break;
        }
        EXPECT_EQ(names_in(folder_ / "out"), names_in(folder_ / "whole"));
        for (const std::string& name : names_in(folder_ / "whole")) {
            EXPECT_TRUE(read_bytes(folder_ / "out" / name) == read_bytes(folder_ / "whole" / name)) << name;
        }
    }
};

TEST_F(TimeLimit, EveryProcessAdvances) {
    expect_made_in_pieces(
        {"--frames", "1", "--integrator", "path", "--light-samples", "1", "--sampling", "uniform", "--spp", "3000"});
}

TEST_F(TimeLimit, LightOfKeyframesAdvancesToo) {
    expect_made_in_pieces({"--frames", "1-3", "--spp", "1", "--gather", "64", "--accuracy", ".1", "--light-step", "3"});
}

TEST_F(TimeLimit, ItNeedsFramesThatGoOn) {
    expect_answer(run(words("out", {"--time-limit", "1"})), 2, "--resume");
    expect_answer(run(words("out", {"--resume", "--time-limit", "0"})), 2, "--time-limit");
}

}  // namespace
}  // namespace aleph
