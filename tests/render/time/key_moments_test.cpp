// Which frames are key moments, and which views they are computed for.

#include "render/time/key_moments.h"

#include <gtest/gtest.h>

namespace aleph {
namespace {

using Views = std::vector<std::int64_t>;

TEST(MomentFrames, EveryStepOfTheRange) {
    const KeyMoments moments{{-5, 30}, {}, 10, {}};
    EXPECT_EQ(find_moments(moments, -5), (MomentPair{-5, -5, 0.0}));
    EXPECT_EQ(find_moments(moments, -4), (MomentPair{-5, 5, 0.1}));
    EXPECT_EQ(find_moments(moments, 5), (MomentPair{5, 5, 0.0}));
    EXPECT_EQ(find_moments(moments, 14), (MomentPair{5, 15, 0.9}));
    EXPECT_EQ(find_moments(moments, 26), (MomentPair{25, 30, 0.2})) << "the range's last frame";
    EXPECT_EQ(find_moments(moments, 30), (MomentPair{30, 30, 0.0}));
}

TEST(MomentFrames, FramesOutsideTheRangeToo) {
    const KeyMoments moments{{0, 4}, {}, 10, {}};
    EXPECT_EQ(find_moments(moments, 2), (MomentPair{0, 4, 0.5}));
    EXPECT_EQ(find_moments(moments, 7), (MomentPair{4, 10, 0.5}));
    EXPECT_EQ(find_moments(moments, -1), (MomentPair{-10, 0, 0.9}));
    EXPECT_EQ(find_moments(moments, -23), (MomentPair{-30, -20, 0.7}));
}

TEST(MomentFrames, BothSidesOfACut) {
    const KeyMoments moments{{0, 40}, {14}, 10, {}};
    EXPECT_EQ(find_moments(moments, 12).after, 13);
    EXPECT_EQ(find_moments(moments, 13), (MomentPair{13, 13, 0.0}));
    EXPECT_EQ(find_moments(moments, 14), (MomentPair{14, 14, 0.0}));
    EXPECT_EQ(find_moments(moments, 17), (MomentPair{14, 20, 0.5}));
}

TEST(MomentFrames, ViewsDoNotCrossCutsOrEnds) {
    const KeyMoments moments{{0, 40}, {14}, 10, {}};
    EXPECT_EQ(find_moment_views(moments, 0), (Views{0, 10}));
    EXPECT_EQ(find_moment_views(moments, 10), (Views{10, 0, 13}));
    EXPECT_EQ(find_moment_views(moments, 13), (Views{13, 10}));
    EXPECT_EQ(find_moment_views(moments, 14), (Views{14, 20}));
    EXPECT_EQ(find_moment_views(moments, 40), (Views{40, 30}));
    EXPECT_EQ(find_moment_views(moments, 50), (Views{50, 40, 60}));
    EXPECT_EQ(find_moment_views({{0, 0}, {}, 10, {}}, 0), (Views{0}));
}

TEST(MomentFrames, BothSidesOfAJump) {
    const auto find_breaks = [](std::int64_t first, std::int64_t last) {
        return first < 14 && last >= 14 ? Views{14} : Views{};
    };
    const KeyMoments moments{{0, 40}, {}, 10, find_breaks};
    EXPECT_EQ(find_moments(moments, 12).after, 13);
    EXPECT_EQ(find_moments(moments, 13), (MomentPair{13, 13, 0.0}));
    EXPECT_EQ(find_moments(moments, 17), (MomentPair{14, 20, 0.5}));
    EXPECT_EQ(find_moments(moments, 27), (MomentPair{20, 30, 0.7}));
    EXPECT_EQ(find_moment_views(moments, 14), (Views{14, 13, 20})) << "the camera is the same";
}

TEST(MomentFrames, EveryFrameForAStepOfOne) {
    const KeyMoments moments{{0, 9}, {}, 1, {}};
    for (int frame = -2; frame < 12; ++frame) {
        EXPECT_EQ(find_moments(moments, frame), (MomentPair{frame, frame, 0.0}));
    }
}

TEST(MomentFrames, BaseMomentsAreInTheMiddleOfAboutTenSteps) {
    const KeyMoments moments{{0, 249}, {170}, 10, {}};
    for (const int moment : {0, 40, 80}) EXPECT_EQ(find_base_moment(moments, moment), 40) << moment;
    for (const int moment : {90, 130, 160, 169}) EXPECT_EQ(find_base_moment(moments, moment), 120) << moment;
    for (const int moment : {170, 210, 249, 300}) EXPECT_EQ(find_base_moment(moments, moment), 210) << moment;
    EXPECT_EQ(find_base_moment({{0, 3}, {}, 10, {}}, 3), 0);
    EXPECT_EQ(find_base_moment({{7, 7}, {}, 10, {}}, 7), 7);
}

TEST(MomentFrames, ABaseMomentIsItsOwn) {
    const KeyMoments moments{{-1000000000, 1000000000}, {-7, 3, 55, 77, 900}, 7, {}};
    for (std::int64_t frame = -3000; frame < 3000; frame += 13) {
        const std::int64_t moment = find_moments(moments, frame).before, base = find_base_moment(moments, moment);
        EXPECT_EQ(find_moments(moments, base).before, base);
        EXPECT_EQ(find_moments(moments, base).after, base);
        EXPECT_EQ(find_base_moment(moments, base), base);
    }
}

}  // namespace
}  // namespace aleph
