// Scenes that a program changes between frames.

#include <functional>

#include "engine/surface/limit_surface.h"
#include "render/frame/sequence.h"
#include "tests/support/scenes/cage_scenes.h"
#include "tests/support/scenes/moving_box.h"
#include "tests/support/scenes/subdivision_cages.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

const auto maps_only = FrameRequest{.frame = false, .maps = true, .progress = {}};

bool is_without_motion(const MotionField& motion) {
    return std::ranges::none_of(motion.validity.pixels, [](MotionValidity v) { return v == MotionValidity::valid; });
}

/// A simulation that sets each step's place finds the motion that keys give in the last frame of a shot.
TEST(SequenceEdit, MotionLeadsFromTheFrameRenderedLast) {
    const RenderSettings settings = quick_settings(40, 30);
    Scene keyed = make_moving_scene();
    keyed.nodes[3].transform.translation.values = {{0.0, 1.0, 5.0}, {1.0, 1.5, 5.0}};  // the camera moves too
    const auto place_at = [&](Scene& scene, int frame) {
        for (const int node : {1, 3}) {
            scene.nodes[node].transform.translation =
                evaluate(keyed.nodes[node].transform.translation, keyed.film.frame_rate.seconds_of(frame));
        }
    };
    Scene still = keyed;
    place_at(still, 6);
    Sequence stepped(still, settings);
    stepped.render(6, maps_only);
    stepped.edit([&](Scene& scene) { place_at(scene, 7); });
    const FrameOutput first_after = stepped.render(7, maps_only);
    const MotionField& after = first_after.motion;
    const FrameStatistics& statistics = first_after.statistics;
    EXPECT_EQ(statistics.traced.all, statistics.counts.rays.total()) << "rays in the scene before the edit included";

    keyed.film.range = FrameRange{0, 7};
    const MotionField expected = Sequence(keyed, settings).render(7, maps_only).motion;
    for (std::size_t i = 0; i < after.displacement.size(); ++i) {
        // The box stands still within each step, so that its rays are traced in other coordinates.
        EXPECT_LT(glm::length(after.displacement.pixels[i] - expected.displacement.pixels[i]), 1e-5) << i;
    }
    EXPECT_TRUE(after.validity.pixels == expected.validity.pixels);
    EXPECT_GT(std::ranges::count(after.validity.pixels, MotionValidity::hidden), 0) << "behind the moving box";

    const MotionField again = stepped.render(7, maps_only).motion;
    for (const glm::dvec2& way : again.displacement.pixels) ASSERT_EQ(way, glm::dvec2(0.0)) << "no edit since";
}

TEST(SequenceEdit, MotionLeadsFromTheFrameThatWasRenderedNotFromOneThatWasPlanned) {
    const auto move_after = [](bool plans) {
        Sequence sequence(make_moving_scene(), quick_settings(40, 30));
        sequence.render(5, maps_only);
        if (plans) sequence.plan(2);
        sequence.edit([](Scene& scene) { scene.nodes[0].transform.scale = glm::dvec3(1.5); });
        return sequence.render(6, maps_only).motion.displacement.pixels;
    };
    EXPECT_TRUE(move_after(true) == move_after(false));
}

TEST(SequenceEdit, ThePictureIsThatOfANewSequence) {
    RenderSettings settings = quick_settings(40, 30);
    settings.perception.guide = Guide::none;  // the map depends on motion
    Sequence edited(make_moving_scene(), settings);
    edited.render(0);
    const double exposure = edited.exposure();
    const auto paint = [](Scene& scene) { scene.materials[0].base_color = glm::dvec3(0.2, 0.6, 0.1); };
    edited.edit(paint);
    EXPECT_EQ(edited.exposure(), exposure);
    Scene painted = make_moving_scene();
    paint(painted);
    painted.film.exposure = exposure;
    EXPECT_TRUE(edited.render(4).shaded.color.pixels == Sequence(painted, settings).render(4).shaded.color.pixels);
}

TEST(SequenceEdit, NothingMovesFromFramesWithOtherElements) {
    Sequence sequence(make_moving_scene(), quick_settings(40, 30));
    sequence.render(3, maps_only);
    sequence.edit([](Scene& scene) { add_mesh(scene, make_box(glm::dvec3(0.3), 0), {0.5, 0.4, 1.0}); });
    EXPECT_TRUE(is_without_motion(sequence.render(4, maps_only).motion));
    EXPECT_FALSE(is_without_motion(sequence.render(5, maps_only).motion)) << "no edit since";
    sequence.edit([](Scene& scene) { scene.film.cuts = {6}; });
    EXPECT_TRUE(is_without_motion(sequence.render(6, maps_only).motion)) << "a cut";
}

std::size_t count_moving(const MotionField& motion) {
    return static_cast<std::size_t>(std::ranges::count_if(
        motion.displacement.pixels, [](const glm::dvec2& way) { return way != glm::dvec2(0.0); }));
}

/// The motion of a frame after another was rendered and something was changed.
MotionField find_motion_after(Scene scene, int rendered, const std::function<void(Scene&)>& change, int frame) {
    Sequence sequence(std::move(scene), quick_settings(40, 30));
    sequence.render(rendered, maps_only);
    sequence.edit(change);
    return sequence.render(frame, maps_only).motion;
}

TEST(SequenceEdit, NothingMovesAcrossACutBetweenTwoRenderedFrames) {
    const auto raise_box = [](Scene& scene) { scene.nodes[1].transform.translation = glm::dvec3(0.0, 0.7, 0.0); };
    for (const auto& [before, after] : {std::pair{9, 11}, {9, 10}, {12, 9}}) {
        const MotionField motion = find_motion_after(make_scene_with_two_cameras(), before, raise_box, after);
        EXPECT_TRUE(is_without_motion(motion)) << before << " to " << after;
        EXPECT_EQ(count_moving(motion), 0u);
    }
    const auto look_closer = [](Scene& scene) { scene.film.camera_keys = {{0, "close"}}; };
    EXPECT_TRUE(is_without_motion(find_motion_after(make_scene_with_two_cameras(), 5, look_closer, 6)));
}

TEST(SequenceEdit, TheLastFrameOfAShotHasTheMotionFromTheFrameBefore) {
    const auto grow_floor = [](Scene& scene) { scene.nodes[0].transform.scale = glm::dvec3(1.5); };
    const std::size_t inner = count_moving(find_motion_after(make_scene_with_two_cameras(), 7, grow_floor, 8));
    EXPECT_GT(inner, 300u);
    EXPECT_GT(count_moving(find_motion_after(make_scene_with_two_cameras(), 8, grow_floor, 9)), inner / 2);
}

TEST(SequenceEdit, CutsOfCamerasThatNoLongerChangeAreNone) {
    Sequence sequence(make_scene_with_two_cameras(), quick_settings(8, 6));
    sequence.edit([](Scene& scene) {
        EXPECT_TRUE(scene.film.cuts.empty()) << "as it was given";
        scene.film.camera_keys = {{0, "eye"}, {20, "close"}};
    });
    EXPECT_EQ(sequence.scene().film.cuts, std::vector<std::int64_t>{20});
}

TEST(SequenceEdit, NothingMovesFromFramesWithOtherTriangles) {
    const auto replace = [](Scene& scene) { scene.meshes[1] = make_faceted_sphere(0.4, 12, 0); };
    EXPECT_TRUE(is_without_motion(find_motion_after(make_moving_scene(), 3, replace, 4)));
}

TEST(SequenceEdit, WhatIsForbiddenStaysAway) {
    RenderSettings settings = quick_settings(40, 30);
    settings.perception.guide = Guide::none;
    settings.effects.forbid.add(Effect::emission);
    const auto glow = [](Scene& scene) { scene.materials[0].glow.color = glm::dvec3(2.0); };
    Sequence edited(make_moving_scene(), settings);
    edited.edit(glow);
    Scene glowing = make_moving_scene();
    glowing.film.exposure = edited.exposure();
    glow(glowing);
    EXPECT_TRUE(edited.render(4).shaded.color.pixels == Sequence(glowing, settings).render(4).shaded.color.pixels);
}

/// A cage that moves to the right by a hundredth a frame, `distance` before the camera.
Scene make_sliding_cage(double distance) {
    TestCage cage = make_cube_cage();
    std::vector<std::vector<glm::dvec3>> points(2, cage.points);
    for (glm::dvec3& point : points[1]) point.x += 0.01;
    Scene scene = make_cage_scene(std::move(cage), points, 1);
    scene.nodes[0].transform.translation = glm::dvec3(0.0, 0.0, -distance);
    scene.film.range = FrameRange{0, 1};
    scene.film.exposure = 1.0;
    return scene;
}

TEST(SequenceEdit, CagesHaveTheLevelsOfANewSequence) {
    const auto place_at = [](double distance) {
        return [distance](Scene& scene) { scene.nodes[0].transform.translation = glm::dvec3(0.0, 0.0, -distance); };
    };
    const RenderSettings settings = quick_settings(80, 60);
    Sequence sequence(make_sliding_cage(3.0), settings);
    const int near = sequence.scene().cages[0].level;
    sequence.render(0, maps_only);
    sequence.edit(place_at(30.0));
    const Sequence far(make_sliding_cage(30.0), settings);
    EXPECT_LT(far.scene().cages[0].level, near);
    EXPECT_EQ(sequence.scene(), far.scene());

    // The same surface at another level: its points are found in the frame before, where they stood 27 m nearer.
    const FrameOutput after = sequence.render(0, maps_only);
    const int right = after.view.width / 2, middle = after.view.height / 2;
    EXPECT_EQ(after.motion.validity(right, middle), MotionValidity::valid);
    sequence.edit(place_at(3.0));
    EXPECT_EQ(sequence.scene().cages[0].level, near);
    const FrameOutput again = sequence.render(0, maps_only);
    const glm::dvec2 way = again.motion.displacement(right + 10, middle);
    EXPECT_EQ(again.motion.validity(right + 10, middle), MotionValidity::valid);
    EXPECT_NEAR(way.x / (10.5 * (1.0 - 3.0 / 30.0)), 1.0, 0.1) << "from the middle outwards";
}

TEST(SequenceEdit, ABadEditChangesNothing) {
    Sequence sequence(make_moving_scene(), quick_settings(40, 30));
    const Image<Rgb> before = sequence.render(2).shaded.color;
    EXPECT_THROW(sequence.edit([](Scene& scene) { scene.nodes[1].meshes = {999}; }), InputError);
    EXPECT_THROW(sequence.edit([](Scene& scene) { scene.nodes[3].camera = no_index; }), InputError) << "no camera";
    EXPECT_TRUE(sequence.render(2).shaded.color.pixels == before.pixels);
}

}  // namespace
}  // namespace aleph
