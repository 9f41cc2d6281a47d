// Which frames are lighting keyframes, and which views they are computed for.

#include "render/time/lighting_keyframes.h"

#include <gtest/gtest.h>

namespace aleph {
namespace {

using Views = std::vector<std::int64_t>;

TEST(KeyframeFrames, EveryStepOfTheRange) {
    const LightingKeyframes keyframes{{-5, 30}, {}, 10, {}};
    EXPECT_EQ(find_keyframes(keyframes, -5), (KeyframePair{-5, -5, 0.0}));
    EXPECT_EQ(find_keyframes(keyframes, -4), (KeyframePair{-5, 5, 0.1}));
    EXPECT_EQ(find_keyframes(keyframes, 5), (KeyframePair{5, 5, 0.0}));
    EXPECT_EQ(find_keyframes(keyframes, 14), (KeyframePair{5, 15, 0.9}));
    EXPECT_EQ(find_keyframes(keyframes, 26), (KeyframePair{25, 30, 0.2})) << "the range's last frame";
    EXPECT_EQ(find_keyframes(keyframes, 30), (KeyframePair{30, 30, 0.0}));
}

TEST(KeyframeFrames, FramesOutsideTheRangeToo) {
    const LightingKeyframes keyframes{{0, 4}, {}, 10, {}};
    EXPECT_EQ(find_keyframes(keyframes, 2), (KeyframePair{0, 4, 0.5}));
    EXPECT_EQ(find_keyframes(keyframes, 7), (KeyframePair{4, 10, 0.5}));
    EXPECT_EQ(find_keyframes(keyframes, -1), (KeyframePair{-10, 0, 0.9}));
    EXPECT_EQ(find_keyframes(keyframes, -23), (KeyframePair{-30, -20, 0.7}));
}

TEST(KeyframeFrames, BothSidesOfACut) {
    const LightingKeyframes keyframes{{0, 40}, {14}, 10, {}};
    EXPECT_EQ(find_keyframes(keyframes, 12).after, 13);
    EXPECT_EQ(find_keyframes(keyframes, 13), (KeyframePair{13, 13, 0.0}));
    EXPECT_EQ(find_keyframes(keyframes, 14), (KeyframePair{14, 14, 0.0}));
    EXPECT_EQ(find_keyframes(keyframes, 17), (KeyframePair{14, 20, 0.5}));
}

TEST(KeyframeFrames, ViewsDoNotCrossCutsOrEnds) {
    const LightingKeyframes keyframes{{0, 40}, {14}, 10, {}};
    EXPECT_EQ(find_keyframe_views(keyframes, 0), (Views{0, 10}));
    EXPECT_EQ(find_keyframe_views(keyframes, 10), (Views{10, 0, 13}));
    EXPECT_EQ(find_keyframe_views(keyframes, 13), (Views{13, 10}));
    EXPECT_EQ(find_keyframe_views(keyframes, 14), (Views{14, 20}));
    EXPECT_EQ(find_keyframe_views(keyframes, 40), (Views{40, 30}));
    EXPECT_EQ(find_keyframe_views(keyframes, 50), (Views{50, 40, 60}));
    EXPECT_EQ(find_keyframe_views({{0, 0}, {}, 10, {}}, 0), (Views{0}));
}

TEST(KeyframeFrames, BothSidesOfAJump) {
    const auto find_breaks = [](std::int64_t first, std::int64_t last) {
        return first < 14 && last >= 14 ? Views{14} : Views{};
    };
    const LightingKeyframes keyframes{{0, 40}, {}, 10, find_breaks};
    EXPECT_EQ(find_keyframes(keyframes, 12).after, 13);
    EXPECT_EQ(find_keyframes(keyframes, 13), (KeyframePair{13, 13, 0.0}));
    EXPECT_EQ(find_keyframes(keyframes, 17), (KeyframePair{14, 20, 0.5}));
    EXPECT_EQ(find_keyframes(keyframes, 27), (KeyframePair{20, 30, 0.7}));
    EXPECT_EQ(find_keyframe_views(keyframes, 14), (Views{14, 13, 20})) << "the camera is the same";
}

TEST(KeyframeFrames, EveryFrameForAStepOfOne) {
    const LightingKeyframes keyframes{{0, 9}, {}, 1, {}};
    for (int frame = -2; frame < 12; ++frame) {
        EXPECT_EQ(find_keyframes(keyframes, frame), (KeyframePair{frame, frame, 0.0}));
    }
}

TEST(KeyframeFrames, BaseMomentsAreInTheMiddleOfAboutTenSteps) {
    const LightingKeyframes keyframes{{0, 249}, {170}, 10, {}};
    for (const int keyframe : {0, 40, 80}) EXPECT_EQ(find_base_keyframe(keyframes, keyframe), 40) << keyframe;
    for (const int keyframe : {90, 130, 160, 169}) EXPECT_EQ(find_base_keyframe(keyframes, keyframe), 120) << keyframe;
    for (const int keyframe : {170, 210, 249, 300}) EXPECT_EQ(find_base_keyframe(keyframes, keyframe), 210) << keyframe;
    EXPECT_EQ(find_base_keyframe({{0, 3}, {}, 10, {}}, 3), 0);
    EXPECT_EQ(find_base_keyframe({{7, 7}, {}, 10, {}}, 7), 7);
}

TEST(KeyframeFrames, ABaseMomentIsItsOwn) {
    const LightingKeyframes keyframes{{-1000000000, 1000000000}, {-7, 3, 55, 77, 900}, 7, {}};
    for (std::int64_t frame = -3000; frame < 3000; frame += 13) {
        const std::int64_t keyframe = find_keyframes(keyframes, frame).before,
                           base = find_base_keyframe(keyframes, keyframe);
        EXPECT_EQ(find_keyframes(keyframes, base).before, base);
        EXPECT_EQ(find_keyframes(keyframes, base).after, base);
        EXPECT_EQ(find_base_keyframe(keyframes, base), base);
    }
}

}  // namespace
}  // namespace aleph
