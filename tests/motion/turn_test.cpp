// How far nodes turn, from tracks whose turns are known.

#include <glm/gtc/type_ptr.hpp>

#include "engine/scene/operations.h"
#include "motion/turn.h"
#include "tests/support/motion_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// The turn of node 0 within a span of time, before a camera that stands still.
double turn_of(const Node& node, double begin, double end) {
    Scene scene;
    add_node(scene, node);
    scene.nodes[0].meshes = {add_point(scene, glm::vec3(0.0f))};
    const PosePlan plan = make_pose_plan(scene);
    TurnFinder turns(scene, plan);
    turns.find(no_index, begin, end);
    EXPECT_EQ(turns.background(), 0.0);
    return turns.of_node(0);
}

glm::dquat turned(double angle, const glm::dvec3& axis = {0.0, 0.0, 1.0}) {
    return glm::angleAxis(angle, glm::normalize(axis));
}

void append(std::vector<double>& channels, const glm::dmat4& matrix) {
    channels.insert(channels.end(), glm::value_ptr(matrix), glm::value_ptr(matrix) + 16);
}

/// Every kind of operation, with keys at 0, 1 and 3 s at which all angles are `phase` times their own.
Node make_operations() {
    using Kind = OperationStack::Kind;
    OperationStack stack;
    stack.operations = {Kind::translate, Kind::rotate,   Kind::scale,  Kind::rotate_x,
                        Kind::rotate_y,  Kind::rotate_z, Kind::matrix, Kind::translate};
    stack.sampling.kind = TimeSampling::Kind::acyclic;
    stack.sampling.times = {0.0, 1.0, 3.0};
    for (const double phase : {0.0, 1.0, -1.0}) {
        std::vector<double>& channels = stack.channels;
        channels.insert(channels.end(), {7.0 * phase, 8.0, 9.0});
        channels.insert(channels.end(), {0.0, 0.6, 0.8, 0.1 * phase});
        channels.insert(channels.end(), {2.0, 3.0 + phase, 4.0});
        channels.insert(channels.end(), {0.2 * phase, 0.4 * phase, 0.8 * phase});
        append(channels, glm::mat4_cast(turned(0.05 * phase, {1.0, 2.0, 3.0})));
        channels.insert(channels.end(), {phase, phase, phase});
    }
    return {.transform = {.operations = stack}};
}

TEST(Turn, AllOperationsThatTurnAddUp) {
    const Node node = make_operations();
    constexpr double sum = 0.1 + 0.2 + 0.4 + 0.8 + 0.05;
    EXPECT_NEAR(turn_of(node, 0.0, 1.0), sum, 1e-12);
    EXPECT_NEAR(turn_of(node, 0.0, 3.0), 3.0 * sum, 1e-12);  // there, and twice as far back
    EXPECT_NEAR(turn_of(node, 0.5, 2.0), 1.5 * sum, 1e-12);
    EXPECT_NEAR(turn_of(node, 2.0, 0.5), 1.5 * sum, 1e-12);
    EXPECT_NEAR(turn_of(node, -5.0, 9.0), 3.0 * sum, 1e-12);
    EXPECT_EQ(turn_of(node, 3.0, 9.0), 0.0);
    Node single{.transform = {.operations = OperationStack{{OperationStack::Kind::rotate_x}, {}, {1.0}}}};
    EXPECT_EQ(turn_of(single, 0.0, 1.0), 0.0);
}

TEST(Turn, RotationsAreAboutAnyAxis) {
    using Kind = OperationStack::Kind;
    for (const glm::dvec3& axis : {glm::dvec3(1.0, 2.0, -3.0), {0.0, 0.0, 2.0}, {-0.3, 0.1, 0.0}}) {
        for (const double angle : {0.7, -2.5}) {
            const OperationStack stack{{Kind::rotate}, {}, {axis.x, axis.y, axis.z, angle}};
            const glm::dmat4 expected = glm::mat4_cast(glm::angleAxis(angle, glm::normalize(axis)));
            const glm::dmat4 found = evaluate(stack, 0.0);
            for (int column = 0; column < 4; ++column) {
                for (int row = 0; row < 4; ++row) EXPECT_NEAR(found[column][row], expected[column][row], 1e-14);
            }
        }
    }
    EXPECT_EQ(evaluate(OperationStack{{Kind::rotate}, {}, {0.0, 0.0, 0.0, 1.0}}, 0.0), glm::dmat4(1.0));
}

TEST(Turn, ASplineSwingsBeyondItsKeys) {
    // Equal keys at 0 and 1 s, and an angle of 4 a (t - t^2) between: to a and back.
    constexpr double a = 2.5;
    Node node{.transform = {.axis_rotation = AxisRotation{{0.0, 0.0, 1.0}, ramp(0.0, 0.0)}}};
    Track<double>& angle = node.transform.axis_rotation->angle;
    angle.interpolation = Interpolation::cubic;
    angle.values = {0.0, 0.0, 4.0 * a, -4.0 * a, 0.0, 0.0};
    EXPECT_NEAR(turn_of(node, 0.0, 1.0), 2.0 * a, 1e-12);
    EXPECT_NEAR(turn_of(node, -0.7, 1.3), 2.0 * a, 1e-12);  // held outside of the keys
    EXPECT_NEAR(turn_of(node, 0.25, 0.75), 0.5 * a, 1e-12);
    EXPECT_NEAR(turn_of(node, 0.5, 1.0), a, 1e-12);
}

TEST(Turn, QuaternionsTurnTheShortWay) {
    for (const double angle : {1e-6, 0.3, 2.0, 3.1, 3.2, 5.0}) {
        Node node{.transform = {.rotation = ramp(turned(0.7, {1.0, 2.0, 3.0}), turned(0.7 + angle, {1.0, 2.0, 3.0}))}};
        EXPECT_NEAR(turn_of(node, 0.0, 1.0), std::min(angle, 2.0 * pi - angle), 1e-12) << angle;
    }
}

TEST(Turn, MatricesTurnAsTheirRotations) {
    for (const double mirror : {1.0, -1.0}) {
        Node node;
        // Sheared along the first axes, which leaves what Gram and Schmidt find.
        const glm::dmat4 scale(glm::dmat3(2.0 * mirror, 0.0, 0.0, 1.0, 3.0, 0.0, -0.4, 0.7, 0.5));
        node.transform.matrix = ramp(glm::mat4_cast(turned(0.2, {3.0, 1.0, 2.0})) * scale,
                                     glm::mat4_cast(turned(1.5, {3.0, 1.0, 2.0})) * scale);
        EXPECT_NEAR(turn_of(node, 0.0, 1.0), 1.3, 1e-12) << mirror;
    }
    // Nodes without a rotation do not turn.
    Node flat{.transform = {.matrix = ramp(glm::dmat4(0.0), glm::dmat4(0.0))}};
    EXPECT_EQ(turn_of(flat, 0.0, 1.0), 0.0);
}

Node make_spin(int parent, double turn) {
    return {.parent = parent, .transform = {.axis_rotation = AxisRotation{{0.0, 0.0, 1.0}, ramp(0.0, turn)}}};
}

/// A cart carries an arm, with an object on it, and a mast with the camera on it.
struct Cart {
    Scene scene;
    int cart, arm, mast, camera;

    explicit Cart(double cart_turn, double arm_turn, double mast_turn)
        : cart(add_node(scene, make_spin(no_index, cart_turn))),
          arm(add_node(scene, make_spin(cart, arm_turn))),
          mast(add_node(scene, make_spin(cart, mast_turn))),
          camera(add_camera(scene, mast)) {
        scene.nodes[arm].meshes = {add_point(scene, glm::vec3(0.0f))};
    }
};

TEST(Turn, WhatCameraAndObjectShareDoesNotCount) {
    Cart test(1.0, 0.3, 0.04);
    const auto expect = [&](double arm, double cart, double background) {
        const PosePlan plan = make_pose_plan(test.scene);
        TurnFinder turns(test.scene, plan);
        turns.find(test.camera, 0.0, 1.0);
        EXPECT_NEAR(turns.of_node(test.arm), arm, 1e-12);
        EXPECT_NEAR(turns.of_node(test.cart), cart, 1e-12);
        EXPECT_NEAR(turns.background(), background, 1e-12);
    };
    expect(0.3 + 0.04, 0.04, 1.04);
    test.scene.nodes[test.mast].inherits = 0.0;  // the camera stays where it is
    expect(1.3 + 0.04, 1.0 + 0.04, 0.04);
    test.scene.nodes[test.mast].inherits = 1.0;
    test.scene.nodes[test.arm].inherits = 0.0;  // the object does
    expect(0.3 + 1.04, 0.04, 1.04);
    // Let go during the span: counts as carried.
    test.scene.nodes[test.arm].inherits = ramp(1.0, 0.0);
    test.scene.nodes[test.arm].inherits.interpolation = Interpolation::step;
    expect(0.3 + 0.04, 0.04, 1.04);
    test.scene.nodes[test.arm].inherits.values = {0.0, 1.0};
    expect(0.3 + 0.04, 0.04, 1.04);
}

TEST(Turn, ASkinTurnsAsTheJointThatTurnsMost) {
    Scene scene;
    const int skinned = add_node(scene, make_spin(no_index, 0.1));
    Skin skin;
    for (const double turn : {0.2, 0.7, 0.5}) skin.joints.push_back(add_node(scene, make_spin(no_index, turn)));
    skin.inverse_binds.assign(3, glm::dmat4(1.0));
    const int camera = add_camera(scene, add_node(scene, make_spin(no_index, 0.04)));
    scene.skins = {skin};
    const int mesh = add_point(scene, glm::vec3(0.0f));
    scene.meshes[mesh].deformation.skin = 0;
    scene.meshes[mesh].deformation.joint_weights.assign(3, {0, 1.0f});
    scene.nodes[skinned].meshes = {mesh};
    const PosePlan plan = make_pose_plan(scene);
    TurnFinder turns(scene, plan);
    turns.find(camera, 0.0, 1.0);
    EXPECT_NEAR(turns.of_node(skinned), 0.74, 1e-12);
    EXPECT_EQ(turns.subdivide(camera, 0.0, 1.0, 0.75).size(), 0u);
    EXPECT_EQ(turns.subdivide(camera, 0.0, 1.0, 0.73).size(), 1u);
}

TEST(Turn, StepsAreEvenInEitherDirection) {
    Cart test(0.0, 0.0, 0.0);
    test.scene.nodes[test.arm].transform.axis_rotation->angle = ramp(0.0, 1.0, 2.0, 4.0);
    const PosePlan plan = make_pose_plan(test.scene);
    TurnFinder turns(test.scene, plan);
    const auto expect = [](const std::vector<double>& found, const std::vector<double>& expected) {
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) EXPECT_DOUBLE_EQ(found[i], expected[i]);
    };
    expect(turns.subdivide(test.camera, 2.0, 4.0, 0.25), {2.5, 3.0, 3.5});
    expect(turns.subdivide(test.camera, 4.0, 2.0, 0.25), {3.5, 3.0, 2.5});
    expect(turns.subdivide(test.camera, 2.0, 4.0, 0.21), {2.4, 2.8, 3.2, 3.6});
    // All of the turn is in the second half: two steps are not enough, four are.
    expect(turns.subdivide(test.camera, 0.0, 4.0, 0.5), {1.0, 2.0, 3.0});
    // A turn at a constant rate comes on top of it, in equal shares.
    expect(turns.subdivide(test.camera, 2.0, 4.0, 0.5, 1.0), {2.5, 3.0, 3.5});
    expect(turns.subdivide(test.camera, 2.0, 4.0, 2.0, 1.0), {});
    expect(turns.subdivide(test.camera, 0.0, 4.0, 0.76, 0.5), {1.0, 2.0, 3.0});
}

}  // namespace
}  // namespace aleph
