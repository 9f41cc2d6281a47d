// The interval of a shutter, where cuts end it, the times within it, and frames at which the light jumps.

#include "render/time/shutter.h"
#include "render/frame/sequence_state.h"
#include "tests/support/scenes/shot_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

ShutterInterval open_at(std::int64_t frame, const glm::dvec2& shutter, std::vector<std::int64_t> cuts = {}) {
    Scene scene;
    scene.film.cuts = std::move(cuts);
    return find_shutter(scene, shutter, frame).value();
}

TEST(Shutter, IsRelativeToTheFrame) {
    EXPECT_FALSE(find_shutter({}, glm::dvec2(0.0), 7).has_value());
    const ShutterInterval whole = open_at(7, {-0.25, 0.5});
    EXPECT_EQ(whole.open, 6.75);
    EXPECT_EQ(whole.close, 7.5);
    const ShutterInterval keyframe = open_at(7, {0.5, 0.5});
    EXPECT_EQ(keyframe.open, 7.5);
    EXPECT_EQ(keyframe.close, 7.5);
}

TEST(Shutter, MC27_CutsEndItOnBothSides) {
    const std::vector<std::int64_t> cuts{20, 5, 10};
    constexpr double before = 1.0 / 2048.0;  // frames
    const auto expect = [&](std::int64_t frame, const glm::dvec2& shutter, double open, double close) {
        const ShutterInterval found = open_at(frame, shutter, cuts);
        EXPECT_DOUBLE_EQ(found.open, open) << frame;
        EXPECT_DOUBLE_EQ(found.close, close) << frame;
    };
    expect(9, {-0.5, 0.5}, 8.5, 9.5);
    expect(9, {-0.5, 2.0}, 8.5, 10.0 - before);  // the next shot begins at 10
    expect(9, {0.0, 30.0}, 9.0, 10.0 - before);  // and another at 20
    expect(10, {-0.5, 0.5}, 10.0, 10.5);
    expect(10, {-9.0, 0.0}, 10.0, 10.0);  // all of it before the cut: the shot's first keyframe
    expect(11, {-9.0, 30.0}, 10.0, 20.0 - before);
    expect(4, {0.0, 1.0}, 4.0, 5.0 - before);
}

TEST(Shutter, MC27_AShutterBeyondTheCutShowsTheLastMomentBeforeIt) {
    // Keys take in times within a billionth of a frame.
    for (const std::int64_t cut : {10, 100'000}) {
        for (const glm::dvec2& shutter : {glm::dvec2(1.0, 1.5), glm::dvec2(3.0, 3.0)}) {
            const ShutterInterval found = open_at(cut - 1, shutter, {cut, 2 * cut});
            EXPECT_EQ(found.open, found.close);
            EXPECT_LT(found.close, static_cast<double>(cut) - 1e-7);
            EXPECT_GT(found.close, static_cast<double>(cut) - 1e-3);
        }
    }
}

/// A camera with an open shutter that jumps by 40 m to frame 5.
Scene make_jump(const Track<glm::dvec3>& way) {
    Scene scene;
    scene.film.frame_rate = {1, 1};
    scene.film.cuts = {5};
    scene.cameras.emplace_back().shutter = glm::dvec2(-0.25, 0.5);
    scene.nodes.emplace_back().transform.translation = way;
    scene.nodes.emplace_back().camera = 0;
    scene.nodes.back().parent = 0;
    return scene;
}

TEST(Shutter, MC27_AShotEndsBeforeKeysThatLeadIntoTheNext) {
    using Keys = std::vector<glm::dvec3>;
    const auto crossed = [](const Scene& scene) { return find_crossed_cuts(scene, [](std::int64_t) { return 0; }); };
    const glm::dvec3 there(40, 0, 0), on(1, 0, 0);
    const Scene neighbours = make_jump(Track<glm::dvec3>({0, 4, 5, 9}, Keys{{}, on, there, there + on}));
    EXPECT_EQ(crossed(neighbours), neighbours.film.cuts);
    const ShutterInterval found = find_shutter(neighbours, {-0.25, 0.5}, 4, neighbours.film.cuts).value();
    EXPECT_EQ(found.open, 3.75);
    EXPECT_EQ(found.close, 4.0);
    EXPECT_DOUBLE_EQ(find_shutter_center(neighbours, {0.0, 0.5}, 4, neighbours.film.cuts), 4.0);
    Scene zoom = make_jump(Track<glm::dvec3>(glm::dvec3(0.0)));
    zoom.cameras[0].fov = Track<double>({0, 4, 5, 9}, std::vector<double>{0.6, 0.6, 1.2, 1.2});
    EXPECT_EQ(crossed(zoom), zoom.film.cuts);
    // Another camera looks from the cut on.
    Scene others = neighbours;
    others.cameras.push_back(others.cameras[0]);
    others.nodes.emplace_back(others.nodes.back()).camera = 1;
    EXPECT_TRUE(find_crossed_cuts(others, [](std::int64_t frame) { return frame < 5 ? 0 : 1; }).empty());
    // A step takes no time, and what moves on is no jump.
    Track<glm::dvec3> step = Track<glm::dvec3>({0, 5}, Keys{{}, there});
    step.interpolation = Interpolation::step;
    EXPECT_TRUE(crossed(make_jump(step)).empty());
    EXPECT_TRUE(crossed(make_jump(Track<glm::dvec3>({0, 4, 5, 9}, Keys{{}, 4.0 * on, 5.0 * on, 9.0 * on}))).empty());
}

TEST(Shutter, ItsCenterStaysInTheShot) {
    Scene scene;
    scene.film.frame_rate = {30, 1};
    scene.film.cuts = {5};
    const auto center = [&](const glm::dvec2& shutter, std::int64_t frame) {
        return 30.0 * find_shutter_center(scene, shutter, frame);
    };
    EXPECT_DOUBLE_EQ(center({0.0, 0.0}, 3), 3.0);
    EXPECT_DOUBLE_EQ(center({-0.3, 0.3}, 3), 3.0);
    EXPECT_DOUBLE_EQ(center({0.0, 0.5}, 3), 3.25);
    EXPECT_DOUBLE_EQ(center({0.5, 0.5}, 3), 3.5);
    EXPECT_NEAR(center({0.0, 2.0}, 4), 4.5, 1e-3);  // the shot ends at 5
    EXPECT_DOUBLE_EQ(center({-0.5, 0.5}, 5), 5.0);
    EXPECT_DOUBLE_EQ(center({-2.0, 0.5}, 5), 5.25);  // it begins at 5
    EXPECT_LT(center({1.0, 1.0}, 4), 5.0);
}

/// A second camera looks from frame 10 on. The lamp is a spot light.
std::vector<std::int64_t> find_breaks(Scene scene, const glm::dvec2& shutter) {
    scene.lights[0].kind = Light::Kind::spot;
    add_camera(scene, {0.5, 1.5, 4.0}, {-0.5, 1.0, -2.0});
    scene.cameras[1].shutter = shutter;
    return SequenceState(scene, shot_settings(10), {{0, 0}, {10, 1}}).light_breaks.find(10, 20);
}

Track<double> step_after_frame_14(double from, double to) {
    return Track<double>({0.0, 14.5 / 30.0}, {from, to}, Interpolation::step);
}

TEST(LightBreaks, FramesAreLookedAtAtTheShutterOfTheirOwnCamera) {
    Scene scene = make_shot();
    scene.lights[0].intensity = step_after_frame_14(0.0, 2.0);
    EXPECT_EQ(find_breaks(scene, {0.0, 0.0}), std::vector<std::int64_t>{15});
    EXPECT_EQ(find_breaks(scene, {0.9, 0.9}), std::vector<std::int64_t>{14});
}

TEST(LightBreaks, RangesAndConesJump) {
    const auto jumps = [](Track<double> Light::*value, double to) {
        Scene scene = make_shot();
        scene.lights[0].*value = step_after_frame_14(0.6, to);
        return find_breaks(scene, glm::dvec2(0.0));
    };
    for (Track<double> Light::*value : {&Light::range, &Light::outer_cone}) {
        EXPECT_EQ(jumps(value, 1.0), std::vector<std::int64_t>{15});
        EXPECT_TRUE(jumps(value, 0.7).empty());
    }
}

/// The spot comes between frames 12 and 13, and dims to a quarter two frames later.
TEST(LightBreaks, ALampThatComesMayJumpLater) {
    Scene scene = make_shot();
    for (Node& node : scene.nodes) {
        if (node.light != no_index) node.visible = Track<double>({0.0, 12.5 / 30.0}, {0.0, 1.0}, Interpolation::step);
    }
    scene.lights[0].intensity = step_after_frame_14(2.0, 0.5);
    EXPECT_EQ(find_breaks(scene, glm::dvec2(0.0)), (std::vector<std::int64_t>{13, 15}));
}

TEST(LightBreaks, TheLastFrameOfASpanBelongsToIt) {
    Scene scene = make_shot();
    scene.lights[0].intensity = step_after_frame_14(2.0, 0.5);
    SequenceState state(scene, shot_settings(10), {{0, 0}});
    EXPECT_EQ(state.light_breaks.find(10, 15), std::vector<std::int64_t>{15});
    EXPECT_TRUE(state.light_breaks.find(10, 14).empty());
    EXPECT_TRUE(state.light_breaks.changes(10.0, 15.0));
    EXPECT_FALSE(state.light_breaks.changes(10.0, 14.4)) << "it changes after the shutter closes";
}

}  // namespace
}  // namespace aleph
