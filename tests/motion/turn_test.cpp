// How far nodes turn, from tracks whose turns are known.

#include <glm/gtc/type_ptr.hpp>

#include "motion/turn.h"
#include "tests/support/scenes/motion_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// The turn of a node within a span of time, before a camera that stands still.
double turn_of(const LocalTransform& transform, double begin, double end) {
    Scene scene;
    add_node(scene, {.transform = transform, .meshes = {add_point(scene, glm::vec3(0.0f))}});
    const PosePlan plan = make_pose_plan(scene);
    TurnFinder turns(scene, plan);
    turns.find(no_index, begin, end);
    EXPECT_EQ(turns.background(), 0.0);
    return turns.of_node(0);
}

glm::dmat4 turned(double angle) {
    return glm::mat4_cast(glm::angleAxis(angle, glm::normalize(glm::dvec3(3.0, 1.0, 2.0))));
}

TEST(Turn, AllOperationsThatTurnAddUp) {
    using Kind = OperationStack::Kind;
    OperationStack stack{
        {Kind::translate, Kind::rotate, Kind::scale, Kind::rotate_x, Kind::rotate_y, Kind::rotate_z, Kind::matrix},
        {TimeSampling::Kind::acyclic, 0.0, 1.0, {0.0, 1.0, 3.0}},
        {}};
    std::vector<double>& all = stack.channels;
    for (const double s : {0.0, 1.0, -1.0}) {  // there, and twice as far back
        const glm::dmat4 m = turned(0.05 * s);
        all.insert(all.end(), {7.0 * s, 8, 9, 0, 0.6, 0.8, 0.1 * s, 2, 3 + s, 4, 0.2 * s, 0.4 * s, 0.8 * s});
        all.insert(all.end(), glm::value_ptr(m), glm::value_ptr(m) + 16);
    }
    constexpr double sum = 0.1 + 0.2 + 0.4 + 0.8 + 0.05;
    EXPECT_NEAR(turn_of({.operations = stack}, -5.0, 9.0), 3.0 * sum, 1e-12);
    EXPECT_NEAR(turn_of({.operations = stack}, 2.0, 0.5), 1.5 * sum, 1e-12);
    EXPECT_EQ(turn_of({.operations = stack}, 3.0, 9.0), 0.0);
}

TEST(Turn, ASplineSwingsBeyondItsKeys) {
    // Equal keys at 0 and 1 s, and an angle of 10 (t - t^2) between: to 2.5 and back.
    const AxisRotation swing{{0.0, 0.0, 1.0},
                             Track<double>({0.0, 1.0}, {0.0, 0.0, 10.0, -10.0, 0.0, 0.0}, Interpolation::cubic)};
    EXPECT_NEAR(turn_of({.axis_rotation = swing}, -0.7, 1.3), 5.0, 1e-12);
    EXPECT_NEAR(turn_of({.axis_rotation = swing}, 0.25, 0.75), 1.25, 1e-12);
}

TEST(Turn, MatricesTurnAsTheirRotations) {
    for (const double mirror : {1.0, -1.0}) {
        // Sheared along the first axes, which leaves what Gram and Schmidt find.
        const glm::dmat4 scale(glm::dmat3(2.0 * mirror, 0.0, 0.0, 1.0, 3.0, 0.0, -0.4, 0.7, 0.5));
        EXPECT_NEAR(turn_of({.matrix = ramp(turned(0.2) * scale, turned(1.5) * scale)}, 0.0, 1.0), 1.3, 1e-12);
    }
    EXPECT_EQ(turn_of({.matrix = ramp(glm::dmat4(0.0), glm::dmat4(0.0))}, 0.0, 1.0), 0.0);
}

Node make_spin(int parent, double turn) {
    return {.parent = parent, .transform = {.axis_rotation = AxisRotation{{0.0, 0.0, 1.0}, ramp(0.0, turn)}}};
}

/// A cart carries an arm, with an object on it, and a mast with the camera on it.
TEST(Turn, WhatCameraAndObjectShareDoesNotCount) {
    Scene scene;
    const int cart = add_node(scene, make_spin(no_index, 1.0)), arm = add_node(scene, make_spin(cart, 0.3)),
              mast = add_node(scene, make_spin(cart, 0.04)), camera = add_camera(scene, mast);
    scene.nodes[arm].meshes = {add_point(scene, glm::vec3(0.0f))};
    const auto expect = [&](double of_arm, double of_cart, double background) {
        const PosePlan plan = make_pose_plan(scene);
        TurnFinder turns(scene, plan);
        turns.find(camera, 0.0, 1.0);
        EXPECT_NEAR(turns.of_node(arm), of_arm, 1e-12);
        EXPECT_NEAR(turns.of_node(cart), of_cart, 1e-12);
        EXPECT_NEAR(turns.background(), background, 1e-12);
    };
    expect(0.3 + 0.04, 0.04, 1.04);
    scene.nodes[mast].inherits = 0.0;  // the camera stays where it is
    expect(1.3 + 0.04, 1.0 + 0.04, 0.04);
    scene.nodes[mast].inherits = 1.0;
    scene.nodes[arm].inherits = 0.0;  // the object does
    expect(0.3 + 1.04, 0.04, 1.04);
    // Let go during the span: counts as carried.
    scene.nodes[arm].inherits = Track<double>({0.0, 1.0}, {1.0, 0.0}, Interpolation::step);
    expect(0.3 + 0.04, 0.04, 1.04);
    scene.nodes[arm].inherits.values = {0.0, 1.0};
    expect(0.3 + 0.04, 0.04, 1.04);
}

}  // namespace
}  // namespace aleph
