// Standard output and standard error that cannot be written.

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <filesystem>
#include <string>

#include "tests/support/paths.h"
#include "tests/support/scratch_folder.h"

namespace aleph {
namespace {

TEST(LostOutput, HelpThatIsLostIsAFailure) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
    for (const char* words : {"--help", "--version", "render --help", "study --help"}) {
        const std::string command = "'" + program_path("aleph") + "' " + words + " >/dev/full 2>/dev/null";
        EXPECT_EQ(WEXITSTATUS(::system(command.c_str())), 1) << words;
    }
}

TEST(LostOutput, ProgressThatIsLostDoesNotEndARender) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
    const ScratchFolder folder;
    const std::string command =
        "'" + program_path("aleph") + "' render '" + (source_folder() / "scenes/cornell/scene.json").string() +
        "' --frames 0-2 --size 16x12 --spp 1 -o '" + folder.path().string() + "/' 2>/dev/full >/dev/null";
    EXPECT_EQ(WEXITSTATUS(::system(command.c_str())), 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "cornell.0002.exr"));
}

}  // namespace
}  // namespace aleph
