// Messages of the command line about frames that are copies.

#include "render/cli/copied_frames.h"

#include <gtest/gtest.h>

namespace aleph {
namespace {

TEST(CopiedFrames, AreSaidOncePerHold) {
    std::vector<FinishedFrame> list(20);
    for (std::size_t i = 0; i < list.size(); ++i) list[i].frame = static_cast<std::int64_t>(i);
    EXPECT_EQ(describe_copies(list), "");
    list[2].copy_of = list[3].copy_of = list[4].copy_of = 1;
    list[8].copy_of = 7;
    const std::string two =
        "aleph: frames 2-4 are copies of frame 1: nothing changes\n"
        "aleph: frame 8 is a copy of frame 7: nothing changes\n";
    EXPECT_EQ(describe_copies(list), two);
    for (const int frame : {11, 13, 15, 16, 18}) list[frame].copy_of = frame == 16 ? 14 : frame - 1;
    EXPECT_EQ(describe_copies(list), two +
                                         "aleph: frame 11 is a copy of frame 10: nothing changes\n"
                                         "aleph: frame 13 is a copy of frame 12: nothing changes\n"
                                         "aleph: 3 more frames are copies of others\n");
}

}  // namespace
}  // namespace aleph
