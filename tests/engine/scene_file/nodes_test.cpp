// The scene file: the meaning of the keys of nodes, where they stand and what they show, and of values over time.

#include "engine/pose/pose.h"
#include "engine/surface/shapes.h"
#include "tests/engine/scene_file/scene_texts.h"

namespace aleph {
namespace {

TEST(SceneJson, NodesThatDoNotInheritAndAlwaysShow) {
    const Scene scene =
        read(R"(, "fps": 10, "nodes": [{"name": "a", "translation": [1, 0, 0], "visible": false, "children": [
        {"name": "b", "inherits": {"keys": [[0, true], [10, false]]}, "visible": {"keys": [[0, true], [10, "always"]]}}]}])");
    const ScenePose before = pose(scene, 0.5), after = pose(scene, 1.0);
    EXPECT_EQ(before.world[1][3].x, 1.0);
    EXPECT_EQ(after.world[1][3].x, 0.0);
    EXPECT_EQ(before.visible[1], 0);
    EXPECT_EQ(after.visible[1], 1);
    EXPECT_EQ(again(scene), scene);
}

TEST(SceneJson, OperationsMultiplyFromLeftToRightAndInterpolateOneByOne) {
    const Scene scene = read(R"(, "fps": 10, "nodes": [{"operations": [{"translate": [1, 0, 0]},
        {"rotate_y": {"keys": [[0, 0], [10, 360]]}}, {"rotate_x": 90}, {"scale": 2},
        {"rotate": {"axis": [0, 0, 1], "degrees": {"keys": [[0, 0], [10, 90]]}}}]}])");
    ASSERT_TRUE(scene.nodes[0].transform.operations);
    const OperationStack& stack = *scene.nodes[0].transform.operations;
    EXPECT_EQ(stack.operations.size(), 5u);
    EXPECT_EQ(stack.channels.size(), 2u * (3 + 1 + 1 + 3 + 4));
    // At half time: about z by 45, doubled, about x by 90, about y by 180, then moved.
    const glm::dvec4 moved = pose(scene, 0.5).world[0] * glm::dvec4(1.0, 0.0, 0.0, 1.0);
    const double half = std::sqrt(2.0);
    EXPECT_NEAR(moved.x, 1.0 - half, 1e-12);
    EXPECT_NEAR(moved.y, 0.0, 1e-12);
    EXPECT_NEAR(moved.z, -half, 1e-12);
    EXPECT_EQ(again(scene), scene);
}

TEST(SceneJson, AnInstanceShowsAWholeSubTree) {
    const Scene scene = read(R"(, "nodes": [{"name": "tree", "shape": {"type": "cylinder"}, "children": [
          {"name": "crown", "translation": [0, 2, 0], "shape": {"type": "sphere"}, "camera": {},
           "children": [{"name": "apple", "light": {"type": "point"}}]},
          {"name": "root"}]},
        {"name": "tree 2", "instance": "tree", "translation": [5, 0, 0]},
        {"name": "tree 3", "instance": "tree 2", "translation": [9, 0, 0]}])");
    ASSERT_EQ(scene.nodes.size(), 12u);
    EXPECT_EQ(scene.meshes.size(), 2u) << "meshes are shared";
    EXPECT_EQ(scene.nodes[4].name, "tree 2");
    EXPECT_EQ(scene.nodes[4].meshes, scene.nodes[0].meshes);
    EXPECT_EQ(scene.nodes[5].name, "tree 2/crown");
    EXPECT_EQ(scene.nodes[5].parent, 4);
    EXPECT_EQ(scene.nodes[5].camera, no_index) << "cameras are not shared";
    EXPECT_EQ(scene.nodes[6].light, 0);
    EXPECT_EQ(scene.nodes[6].parent, 5);
    EXPECT_EQ(scene.nodes[9].meshes, scene.nodes[1].meshes);
    EXPECT_EQ(pose(scene, 0.0).world[9][3], glm::dvec4(9.0, 2.0, 0.0, 1.0));
    EXPECT_EQ(again(scene), scene);
}

TEST(SceneJson, CamerasMayBeMountedOnNodesThatWereShownAgain) {
    const Scene scene =
        read(R"(, "nodes": [{"name": "car", "shape": {"type": "box"}}, {"name": "other", "instance": "car"},
        {"name": "mount", "parent": "car", "children": [{"name": "eye", "camera": {}}]}])");
    EXPECT_EQ(scene.nodes[3].parent, 2);
}

TEST(SceneJson, ShapesOfNodesTakeTheirNames) {
    const Scene scene = read(R"(, "materials": {"felt": {}}, "nodes": [
        {"name": "a", "shape": {"type": "quad", "size": [2, 3], "uv_scale": [4, 5]}, "material": "felt"},
        {"name": "b", "shape": {"type": "sphere", "radius": 2, "segments": 8}, "material": {"roughness": 0.5}},
        {"name": "c", "shape": {"type": "cylinder", "height": 7}, "camera": {}, "light": {"type": "point"}},
        {"name": "d", "shape": {"type": "box", "size": [1, 2, 3]}}])");
    Shape quad, sphere, cylinder, box;
    quad.size = {2, 3, 1};
    quad.uv_scale = {4, 5};
    sphere.kind = Shape::Kind::sphere;
    sphere.radius = 2;
    sphere.segments = 8;
    cylinder.kind = Shape::Kind::cylinder;
    cylinder.height = 7;
    box.kind = Shape::Kind::box;
    box.size = {1, 2, 3};
    ASSERT_EQ(scene.meshes.size(), 4u);
    EXPECT_EQ(scene.meshes[0], make_shape_mesh(quad, 0, "a"));
    EXPECT_EQ(scene.meshes[1], make_shape_mesh(sphere, 1, "b"));
    EXPECT_EQ(scene.meshes[2], make_shape_mesh(cylinder, no_index, "c"));
    EXPECT_EQ(scene.meshes[3], make_shape_mesh(box, no_index, "d"));
    EXPECT_EQ(scene.materials[1].name, "b");
    EXPECT_EQ(scene.cameras.at(0).name, "c");
    EXPECT_EQ(scene.lights.at(0).name, "c");
    EXPECT_EQ(scene.nodes[2].camera, 0);
    EXPECT_EQ(scene.nodes[2].light, 0);
}

TEST(SceneJson, NodesShareMeshesByNameAndByInstance) {
    const Scene scene =
        read(R"(, "meshes": {"ball": {"shape": {"type": "sphere"}}, "plate": {"shape": {"type": "quad"}}}, "nodes": [
        {"name": "a", "mesh": "ball"}, {"name": "b", "meshes": ["plate", "ball"]}, {"name": "c", "instance": "b"}])");
    EXPECT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.nodes[0].meshes, (std::vector<int>{0}));
    EXPECT_EQ(scene.nodes[1].meshes, (std::vector<int>{1, 0}));
    EXPECT_EQ(scene.nodes[2].meshes, (std::vector<int>{1, 0}));
    EXPECT_EQ(again(scene), scene);
}

TEST(SceneJson, ParentsStandBeforeTheirChildren) {
    const Scene scene = read(R"(, "nodes": [{"name": "a", "children": [{"name": "b", "children": [{}]}, {"name": ""}]},
        {"name": "c", "parent": "b"}, {"name": "node 2"}])");
    ASSERT_EQ(scene.nodes.size(), 6u);
    const int parents[] = {no_index, 0, 1, 0, 1, no_index};
    const char* names[] = {"a", "b", "node 2 2", "", "c", "node 2"};  // made-up names avoid given ones
    for (int i = 0; i < 6; ++i) {
        EXPECT_EQ(scene.nodes[i].parent, parents[i]) << i;
        EXPECT_EQ(scene.nodes[i].name, names[i]) << i;
    }
    EXPECT_EQ(again(scene), scene);
}

TEST(SceneJson, KF14_KeysAtFramesLieAtExactlyTheFramesTime) {
    const Scene scene = read(R"(, "fps": "30000/1001", "nodes": [{"translation":
        {"keys": [[-7, [0, 0, 0]], [12, [1, 2, 3]], [12.5, [4, 5, 6]], [107892, [7, 8, 9]]]}}])");
    const Track<glm::dvec3>& track = scene.nodes[0].transform.translation;
    EXPECT_EQ(track.interpolation, Interpolation::linear);
    EXPECT_EQ(track.sampling.kind, TimeSampling::Kind::acyclic);
    const FrameRate rate{30000, 1001};
    EXPECT_EQ(track.sampling.times, (std::vector<double>{rate.seconds_of(-7), rate.seconds_of(12),
                                                         12.5 * 1001.0 / 30000.0, rate.seconds_of(107892)}));
    EXPECT_EQ(track.values[1], glm::dvec3(1, 2, 3));
    EXPECT_EQ(again(scene), scene);
}

TEST(SceneJson, ValuesOncePerFrameAreUniform) {
    const Track<double> intensity = read(R"(, "fps": 25, "lights": {"l": {"type": "point", "intensity":
        {"values": [1, 2, 4], "start": 5, "period": 2, "interpolation": "step"}}})")
                                        .lights[0]
                                        .intensity;
    EXPECT_EQ(intensity.sampling.kind, TimeSampling::Kind::uniform);
    EXPECT_EQ(intensity.sampling.start, 0.2);
    EXPECT_EQ(intensity.sampling.period, 0.08);
    EXPECT_EQ(intensity.interpolation, Interpolation::step);
    EXPECT_EQ(intensity.values, (std::vector<double>{1, 2, 4}));
    EXPECT_EQ(read_node(R"("scale": {"values": [1, [1, 2, 3]]})").nodes[0].transform.scale.sampling.period, 1.0 / 30.0);
    EXPECT_EQ(read_node(R"("scale": {"values": [1, 2], "unit": "seconds"})").nodes[0].transform.scale.sampling.period,
              1.0);
}

TEST(SceneJson, CyclesAndCubicKeys) {
    const Node node =
        read_node(
            R"("translation": {"cycle": [0, 0.25], "period": 1, "unit": "seconds", "values": [[0, 0, 0], [1, 1, 1], [2, 2, 2]]},
        "rotation": {"interpolation": "cubic", "unit": "seconds", "keys": [[0, [0, 0, 0, 0], [0, 0, 0, 1], [1, 0, 0, 0]], [2, [0, 1, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0]]]},
        "scale": {"interpolation": "cubic", "values": [[[1, 2, 3], [4, 5, 6], 7]]})")
            .nodes[0];
    EXPECT_EQ(node.transform.translation.sampling.kind, TimeSampling::Kind::cyclic);
    EXPECT_EQ(node.transform.translation.sampling.times, (std::vector<double>{0.0, 0.25}));
    EXPECT_EQ(node.transform.translation.sampling.period, 1.0);
    EXPECT_EQ(node.transform.rotation.interpolation, Interpolation::cubic);
    ASSERT_EQ(node.transform.rotation.values.size(), 6u);
    EXPECT_EQ(node.transform.rotation.values[1], glm::dquat(1, 0, 0, 0));  // w first in GLM's constructor
    EXPECT_EQ(node.transform.rotation.values[2], glm::dquat(0, 1, 0, 0));
    EXPECT_EQ(node.transform.rotation.values[4], glm::dquat(0, 0, 1, 0));
    EXPECT_EQ(node.transform.scale.values, (std::vector<glm::dvec3>{{1, 2, 3}, {4, 5, 6}, {7, 7, 7}}));
}

TEST(SceneJson, MatricesAreRowByRow) {
    const Node node = read_node(R"("matrix": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0, 0, 1])").nodes[0];
    const glm::dvec4 moved = node.transform.matrix.value().values.at(0) * glm::dvec4(1, 10, 100, 1);
    EXPECT_EQ(moved, glm::dvec4(1 + 20 + 300 + 4, 5 + 60 + 700 + 8, 9 + 100 + 1100 + 12, 1));
}

TEST(SceneJson, AxisAndDegreesGoBeyondAHalfTurn) {
    const Node node =
        read_node(R"("rotation": {"axis": [0, 0, -5], "degrees": {"keys": [[0, 0], [30, 1080]]}})").nodes[0];
    EXPECT_EQ(node.transform.axis_rotation.value().axis, glm::dvec3(0, 0, -1));
    EXPECT_NEAR(node.transform.axis_rotation->angle.values[1], 6.0 * std::numbers::pi, 1e-14);
    EXPECT_EQ(node.transform.rotation, Node{}.transform.rotation);
}

TEST(SceneJson, VisibilityStepsBetweenTrueAndFalse) {
    const Track<double> visible = read_node(R"("visible": {"keys": [[0, true], [10, false]]})").nodes[0].visible;
    EXPECT_EQ(visible.interpolation, Interpolation::step);
    EXPECT_EQ(visible.values, (std::vector<double>{1.0, 0.0}));
    EXPECT_EQ(read_node(R"("visible": false)").nodes[0].visible, Track<double>(0.0));
}

}  // namespace
}  // namespace aleph
