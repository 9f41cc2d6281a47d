// Which frame motion is found against.

#include "motion/other_frame.h"

#include <gtest/gtest.h>

namespace aleph {
namespace {

TEST(OtherFrame, NumbersAndSigns) {
    EXPECT_EQ(other_frame_number(7, OtherFrame::next), 8);
    EXPECT_EQ(other_frame_number(7, OtherFrame::previous), 6);
    EXPECT_EQ(other_frame_number(7, OtherFrame::none), 7);
    EXPECT_EQ(displacement_sign(OtherFrame::next), 1.0);
    EXPECT_EQ(displacement_sign(OtherFrame::previous), -1.0);
    EXPECT_EQ(displacement_sign(OtherFrame::none), 1.0);
}

}  // namespace
}  // namespace aleph
