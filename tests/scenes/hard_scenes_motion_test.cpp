// The scenes of scenes/hard about motion have the results that scenes/hard/README.md expects.

#include "tests/scenes/hard_scenes.h"

namespace aleph {
namespace {

TEST(HardScenes, RP02_RP03_CreepingIsMeasuredAndNotSalient) {
    HardScene hard("creeping");
    const FrameOutput output = hard.render(0);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < output.hits.size(); ++i) {
        if (output.hits.pixels[i].instance == no_index) continue;
        const double expected = pixels_per_unit * 1e-6 / output.surface.depth.pixels[i];
        ASSERT_NEAR(glm::length(output.motion.displacement.pixels[i]), expected, 1e-3 * expected);
        ++moved;
    }
    EXPECT_GT(moved, output.hits.size() / 2);
    for (const float m : output.perception.conspicuity_motion.pixels) ASSERT_EQ(m, 0.0f);
}
TEST(HardScenes, RP04_RP06_BehindTheNextCameraIsFlagged) {
    HardScene hard("flying_through");
    std::size_t behind = 0;
    for (const std::int64_t frame : {0, 1})
        for (const MotionValidity v : hard.render(frame).motion.validity.pixels)
            behind += v == MotionValidity::behind_camera ? 1 : 0;
    EXPECT_GT(behind, 100u);
}
TEST(HardScenes, RP07_SpinHasTheLengthOfItsArc) {
    HardScene hard("spinning");
    const FrameOutput output = hard.render(0);
    double longest_path = 0.0, chord = 0.0;
    for (const std::size_t i : hard.pixels_on(output, "thing")) {
        if (output.motion.path_length.pixels[i] <= longest_path) continue;
        longest_path = output.motion.path_length.pixels[i];
        chord = glm::length(output.motion.displacement.pixels[i]);
    }
    EXPECT_GT(longest_path, 15.0 * chord);  // an arc of 350 degrees, a chord of 10
}
TEST(HardScenes, RP09_SkyMovesByRotationAlone) {
    HardScene hard("sky");
    const FrameOutput output = hard.render(0);
    ASSERT_EQ(output.hits(24, 2).instance, no_index);
    const double from = std::atan(0.5 / pixels_per_unit), turn = pi / 180.0;
    const double expected = pixels_per_unit * (std::tan(from + turn) - std::tan(from));
    EXPECT_NEAR(std::abs(output.motion.displacement(24, 17).x), expected, 0.05 * expected);
}
TEST(HardScenes, RP10_NoMotionAcrossACut) {
    HardScene hard("camera_cut");
    const FrameOutput output = hard.render(1);
    EXPECT_EQ(longest_motion(output), 0.0);
    // The maps of a scene where nothing moves at all.
    Scene still = hard.scene;
    still.film.cuts.clear();
    Node& camera = still.nodes[hard.node("camera")];
    camera.transform.translation = evaluate(camera.transform.translation, 1.0 / 30.0);
    const FrameOutput expected = render_hard(still, 1);
    EXPECT_EQ(output.velocity, expected.velocity);
    EXPECT_EQ(output.perception.saliency, expected.perception.saliency);
    EXPECT_EQ(output.perception.aleph, expected.perception.aleph);
    EXPECT_EQ(output.limits.threshold, expected.limits.threshold);
    EXPECT_EQ(output.limits.alpha, expected.limits.alpha);
    // Without the cut the whole picture moves, and its maps are others.
    Scene jumping = hard.scene;
    jumping.film.cuts.clear();
    const FrameOutput moving = render_hard(jumping, 1);
    EXPECT_GT(longest_motion(moving), 5.0);
    EXPECT_FALSE(moving.perception.aleph == expected.perception.aleph);
}
TEST(HardScenes, RP12_AppearingHasNoCounterpart) {
    HardScene hard("appearing");
    EXPECT_TRUE(hard.pixels_on(hard.render(0), "thing").empty());
    const FrameOutput output = hard.render(1);
    for (const std::size_t i : hard.seen_on(output, "thing")) {
        EXPECT_EQ(output.motion.validity.pixels[i], MotionValidity::no_counterpart);
        EXPECT_EQ(output.motion.displacement.pixels[i], glm::dvec2(0.0));
    }
}
TEST(HardScenes, RP12_WhatHasNoVolumeHasNoCounterpart) {
    HardScene hard("scale_through_zero");
    for (const std::int64_t frame : {0, 2}) {
        const FrameOutput output = hard.render(frame);
        for (const std::size_t i : hard.seen_on(output, "thing")) {
            EXPECT_EQ(output.motion.validity.pixels[i], MotionValidity::no_counterpart);
            EXPECT_EQ(output.motion.displacement.pixels[i], glm::dvec2(0.0));
        }
    }
}
TEST(HardScenes, RP13_LeavingKeepsItsDisplacement) {
    HardScene hard("leaving");
    const FrameOutput output = hard.render(0);
    for (const std::size_t i : hard.pixels_on(output, "thing")) {
        EXPECT_EQ(output.motion.validity.pixels[i], MotionValidity::leaves_screen);
        EXPECT_GT(output.motion.displacement.pixels[i].x, 30.0);
    }
}
TEST(HardScenes, RP14_DeformingMovesAsRigid) {
    HardScene hard("deforming");
    Scene rigid = hard.scene;
    Mesh& mesh = rigid.meshes[rigid.nodes[hard.node("thing")].meshes.front()];
    mesh.deformation.points = no_index;
    rigid.nodes[hard.node("thing")].transform.translation =
        Track<glm::dvec3>({0.0, 2.0 / 30.0}, {{0.0, 0.5, 0.0}, {0.5, 0.5, 0.0}});
    const FrameOutput output = hard.render(0);
    const FrameOutput expected = render_hard(rigid, 0);
    for (const std::size_t i : hard.seen_on(output, "thing")) {
        EXPECT_GT(output.motion.displacement.pixels[i].x, 0.5);
        EXPECT_LT(glm::length(output.motion.displacement.pixels[i] - expected.motion.displacement.pixels[i]), 1e-6);
    }
}
TEST(HardScenes, RP15_NoMotionAcrossATopologyChange) {
    HardScene hard("changing_topology");
    const FrameOutput output = hard.render(0);
    for (const std::size_t i : hard.seen_on(output, "a"))
        EXPECT_EQ(output.motion.validity.pixels[i], MotionValidity::no_counterpart);
    EXPECT_FALSE(hard.pixels_on(hard.render(1), "b").empty());
}
TEST(HardScenes, RP16_RP17_StillCageIsExactlyStill) {
    HardScene hard("subdivided");
    const FrameOutput output = hard.render(0);
    const std::vector<std::size_t> still = hard.pixels_on(output, "thing"), swaying = hard.pixels_on(output, "swaying");
    ASSERT_FALSE(still.empty());
    for (const std::size_t i : still) EXPECT_EQ(output.motion.displacement.pixels[i], glm::dvec2(0.0));
    double longest = 0.0;
    for (const std::size_t i : swaying) longest = std::max(longest, glm::length(output.motion.displacement.pixels[i]));
    EXPECT_GT(longest, 0.1);
}

}  // namespace
}  // namespace aleph
