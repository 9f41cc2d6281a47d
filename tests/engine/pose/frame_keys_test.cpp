// Keys at every frame: transforms at frames stay, and nothing is left that programs interpolate differently.

#include "engine/pose/frame_keys.h"
#include "engine/pose/pose.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

Scene make_moving_scene() {
    Scene scene;
    scene.film.frame_rate = {24000, 1001};
    scene.film.range = FrameRange{-2, 30};
    Node& flyer = scene.nodes.emplace_back();
    flyer.name = "flyer";
    flyer.transform.translation = Track<glm::dvec3>(
        {0.0, 1.0}, {{0, 0, 0}, {0, 1, 0}, {1, 5, 0}, {1, -5, 0}, {1, 1, 0}, {0, 0, 0}}, Interpolation::cubic);
    flyer.transform.rotation = Track<glm::dquat>({0.0, 1.0}, {glm::dquat(1, 0, 0, 0), glm::dquat(0, 1, 0, 0)});
    Node& wheel = scene.nodes.emplace_back();
    wheel.name = "wheel";
    wheel.parent = 0;
    wheel.transform.axis_rotation = AxisRotation{{0, 0.6, 0.8}, Track<double>({0.0, 1.0}, {0.0, 100.0})};
    wheel.transform.translation = Track<glm::dvec3>({0.0, 0.7}, {{0, 0, 0}, {3, 0, 0}});
    wheel.transform.scale = Track<glm::dvec3>({0.0, 0.5}, {{1, 1, 1}, {2, 1, 1}}, Interpolation::step);
    return scene;
}

TEST(FrameKeys, TransformsAtFramesStay) {
    const Scene given = make_moving_scene();
    Scene framed = given;
    key_frames(framed);
    EXPECT_FALSE(framed.nodes[1].transform.axis_rotation.has_value());
    EXPECT_EQ(framed.nodes[0].transform.rotation.key_count(), 33u);
    EXPECT_EQ(framed.nodes[0].transform.translation.interpolation, Interpolation::linear);
    EXPECT_EQ(framed.nodes[1].transform.translation, given.nodes[1].transform.translation);
    EXPECT_EQ(framed.nodes[1].transform.scale, given.nodes[1].transform.scale);
    for (std::int64_t frame = -2; frame <= 30; ++frame) {
        const double seconds = given.film.frame_rate.seconds_of(frame);
        const ScenePose before = pose(given, seconds), after = pose(framed, seconds);
        for (int node = 0; node < 2; ++node) {
            for (int i = 0; i < 16; ++i)
                EXPECT_NEAR(after.world[node][i / 4][i % 4], before.world[node][i / 4][i % 4], 1e-13) << frame;
        }
    }
}

TEST(FrameKeys, WhatDoesNotMoveAndTooManyFrames) {
    Scene still;
    still.nodes.emplace_back().transform.translation = glm::dvec3(1, 2, 3);
    const Scene before = still;
    key_frames(still);
    EXPECT_EQ(still, before);
    Scene endless = make_moving_scene();
    endless.film.range = FrameRange{0, 3000000};
    EXPECT_THROW(key_frames(endless), InputError);
    endless.film.range =
        FrameRange{std::numeric_limits<std::int64_t>::min() / 2, std::numeric_limits<std::int64_t>::max() / 2};
    EXPECT_THROW(key_frames(endless), InputError);
}

}  // namespace
}  // namespace aleph
