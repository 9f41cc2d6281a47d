// Standard input, output and errors that are closed, or that nobody reads.

#include "tests/render/cli/answers.h"

namespace aleph {
namespace {

/// Makes a file a pipe whose reader has ended.
void break_pipe(int file) {
    int ends[2];
    if (::pipe(ends) != 0) ::_exit(126);
    ::close(ends[0]);
    ::dup2(ends[1], file);
    if (ends[1] != file) ::close(ends[1]);
}

TEST_F(ProgramTest, FramesAreWholeWhoeverReadsTheMessages) {
    write_sliding_box(folder_ / "scene.json");
    const auto words = [&](const std::string& name) {
        return Words{"render", folder_ / "scene.json",          "--frames", "1-2", "--size", "32x24", "--spp", "1",
                     "-o",     folder_ / (name + "/f.####.exr")};
    };
    ASSERT_EQ(run(words("whole")).code, 0);
    const auto expect_whole = [&](const std::string& name, const std::function<void()>& before) {
        SCOPED_TRACE(name);
        EXPECT_EQ(StartedProgram(words(name), folder_ / "log", before).wait().code, 0);
        ASSERT_EQ(names_in(folder_ / name), names_in(folder_ / "whole"));
        for (const std::string& file : names_in(folder_ / "whole"))
            EXPECT_TRUE(read_bytes(folder_ / name / file) == read_bytes(folder_ / "whole" / file)) << file;
    };
    expect_whole("no reader", [] { break_pipe(STDERR_FILENO); });
    expect_whole("no errors", [] { ::close(STDERR_FILENO); });
    expect_whole("nothing", [] {
        for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::close(file);
    });
}

TEST_F(ProgramTest, ResultsThatNobodyReadsEndItInSilence) {
    write_sliding_box(folder_ / "scene.json");
    const Ended ended =
        StartedProgram({"explain", folder_ / "scene.json"}, folder_ / "log", [] { break_pipe(STDOUT_FILENO); }).wait();
    EXPECT_EQ(ended.signal, SIGPIPE) << ended.code;
    EXPECT_EQ(ended.err, "");
}

}  // namespace
}  // namespace aleph
