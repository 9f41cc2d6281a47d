// Objects that turn far within a frame, so that the chord is much shorter than the path (RP-07).

#include "motion/model_motion.h"
#include "motion/turn.h"
#include "tests/support/scenes/motion_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// Radius 1 at 10 m, 1500 px focal length: 150 px. Turns about the viewing axis.
Scene make_wheel(double degrees_per_second) {
    Scene scene = make_point_scene({1.0f, 0.0f, -10.0f}, 1500.0);
    scene.nodes[0].transform.axis_rotation = AxisRotation{{0.0, 0.0, 1.0}, ramp(0.0, degrees_per_second * degrees)};
    return scene;
}

TEST(ReprojectionTurn, RP07_RotationBeyondAHalfTurnPerFrame) {
    const struct {
        double turn, chord, arc;
    } cases[] = {{180.0, 300.0, 471.24}, {270.0, 212.13, 706.86}, {350.0, 26.15, 916.30}, {360.0, 0.0, 942.48}};
    for (const auto& c : cases) {
        for (const double sense : {1.0, -1.0}) {
            const PointMotion motion = motion_of_point(make_wheel(sense * c.turn));
            EXPECT_NEAR(glm::length(motion.displacement), c.chord, 0.01) << c.turn;
            EXPECT_NEAR(motion.path_length, c.arc, 0.01 * c.arc) << c.turn;
            EXPECT_EQ(motion.validity, MotionValidity::valid);
        }
    }
    const PointMotion slow = motion_of_point(make_wheel(1.0));
    EXPECT_NEAR(slow.path_length, 150.0 * degrees, 1e-4 * 150.0 * degrees);
    EXPECT_DOUBLE_EQ(slow.path_length, glm::length(slow.displacement));
}

/// A full turn in four keys of 90 degrees within a second.
Track<glm::dquat> make_full_turn() {
    std::vector<glm::dquat> turns;
    for (int i = 0; i <= 4; ++i) turns.push_back(glm::angleAxis(90.0 * i * degrees, glm::dvec3(0, 0, 1)));
    return Track({0.0, 0.25, 0.5, 0.75, 1.0}, turns);
}

/// The same bits at both times, although it moves between them.
TEST(ReprojectionTurn, RP07_FullTurnBetweenEqualPoses) {
    for (const bool camera_turns : {false, true}) {
        Scene scene = make_point_scene({1.0f, 0.0f, -10.0f}, 1500.0);
        Track<glm::dquat>& rotation = scene.nodes[camera_turns ? 1 : 0].transform.rotation;
        rotation = make_full_turn();
        rotation.values.back() = rotation.values.front();
        const MotionField field = motion_between(scene, 0.0, 1.0, one_hit(1000, 1000, 650, 500));
        EXPECT_EQ(field.displacement(650, 500), glm::dvec2(0.0));
        EXPECT_NEAR(field.path_length(650, 500), 942.48, 9.4);
        const double background = camera_turns ? 2.0 * std::numbers::pi * std::hypot(300.5, 0.5) : 0.0;
        EXPECT_NEAR(field.path_length(800, 500), background, 0.01 * background);
        EXPECT_EQ(field.displacement(800, 500), glm::dvec2(0.0));
    }
}

TEST(ReprojectionTurn, RP07_QuaternionKeysWithinTheFrame) {
    Scene scene = make_point_scene({1.0f, 0.0f, -10.0f}, 1500.0);
    scene.nodes[0].transform.rotation = make_full_turn();
    EXPECT_NEAR(motion_of_point(scene).path_length, 942.48, 9.4);
    EXPECT_NEAR(motion_of_point(scene, 0.1, 0.9).path_length, 0.8 * 942.48, 9.4);
    EXPECT_NEAR(motion_of_point(scene, 0.9, 0.1).path_length, 0.8 * 942.48, 9.4);
    // Held before the first and after the last key.
    EXPECT_NEAR(motion_of_point(scene, -3.0, 3.0).path_length, 942.48, 9.4);
    EXPECT_EQ(motion_of_point(scene, 1.0, 2.0).path_length, 0.0);
}

/// Quaternion keys 270 degrees apart take the short way, 90 degrees back, as the picture does.
TEST(ReprojectionTurn, RP08_KeysBeyondAHalfTurnGoTheShortWay) {
    Scene scene = make_point_scene({1.0f, 0.0f, -10.0f}, 1500.0);
    scene.nodes[0].transform.rotation =
        ramp(glm::angleAxis(0.0, glm::dvec3(0, 0, 1)), glm::angleAxis(270.0 * degrees, glm::dvec3(0, 0, 1)));
    const PointMotion motion = motion_of_point(scene);
    EXPECT_NEAR(motion.displacement.x, -150.0, 1e-9);
    EXPECT_NEAR(motion.displacement.y, 150.0, 1e-9);  // down: clockwise
    EXPECT_NEAR(motion.path_length, 150.0 * 90.0 * degrees, 0.01 * 235.62);
}

/// The picture of the environment, about the viewing axis.
TEST(ReprojectionTurn, RP07_ASpinningBackground) {
    Scene scene;
    add_camera(scene);
    const Image<Hit> hits(64, 48);
    for (const bool by_keys : {false, true}) {
        scene.environment.axis_rotation.reset();
        if (by_keys) {
            scene.environment.rotation = make_full_turn();
        } else {
            scene.environment.axis_rotation = AxisRotation{{0.0, 0.0, 1.0}, ramp(0.0, 360.0 * degrees)};
        }
        const MotionField field = motion_between(scene, 0.0, 1.0, hits);
        const double arc = 2.0 * std::numbers::pi * std::hypot(3.5 - 32.0, 40.5 - 24.0);
        EXPECT_LT(glm::length(field.displacement(3, 40)), 1e-9);
        EXPECT_NEAR(field.path_length(3, 40), arc, 0.01 * arc);
    }
}

/// Times between 0 and 1 s; node 1 holds the camera.
std::vector<double> subdivide(const Scene& scene) {
    const PosePlan plan = make_pose_plan(scene);
    return TurnFinder(scene, plan).subdivide(1, 0.0, 1.0, 20.0 * degrees);
}

/// Starts at rest and ends fast: even steps would turn 38 degrees in the last of 18.
TEST(ReprojectionTurn, RP07_UnevenSpin) {
    Scene scene = make_point_scene({1.0f, 0.0f, -10.0f}, 1500.0);
    const double turn = 2.0 * std::numbers::pi;
    scene.nodes[0].transform.axis_rotation = AxisRotation{
        {0.0, 0.0, 1.0},
        Track<double>({0.0, 1.0}, {0.0, 0.0, 0.0, 2.0 * turn, turn, 0.0}, Interpolation::cubic)};  // turn t^2
    EXPECT_NEAR(motion_of_point(scene).path_length, 942.48, 9.4);
    const std::vector<double> times = subdivide(scene);
    double previous = 0.0;
    for (const double time : times) {
        EXPECT_LE(turn * (time * time - previous * previous), 20.001 * degrees);
        previous = time;
    }
    EXPECT_LE(turn * (1.0 - previous * previous), 20.001 * degrees);
}

TEST(ReprojectionTurn, RP07_NoSubFramesWithoutAFastSpin) {
    EXPECT_TRUE(subdivide(make_wheel(19.9)).empty());
    EXPECT_EQ(subdivide(make_wheel(20.1)).size(), 1u);
    EXPECT_EQ(subdivide(make_wheel(180.0)).size(), 8u);
    EXPECT_EQ(subdivide(make_wheel(1e12)).size(), 511u);
    Scene jump = make_wheel(180.0);
    jump.nodes[0].transform.axis_rotation->angle.interpolation = Interpolation::step;
    EXPECT_TRUE(subdivide(jump).empty());
}

}  // namespace
}  // namespace aleph
