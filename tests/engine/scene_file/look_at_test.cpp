// Nodes that look at something: exact rotations at frames, close ones between them, and the cases without a direction.

#include "engine/scene/transforms.h"
#include "tests/engine/scene_file/guided_poses.h"
#include "tests/engine/scene_file/scene_texts.h"

namespace aleph {
namespace {

constexpr double exact = 1e-13;     // rad, at frames
constexpr double between = 1.1e-6;  // rad

TEST(LookAt, CameraThatCirclesTheOrigin) {
    const Scene scene = read(R"(, "frames": [0, 48], "nodes": [
        {"name": "rig", "rotation": {"axis": [0, 1, 0], "degrees": {"keys": [[0, 0], [48, 360]]}}, "children": [
          {"name": "eye", "translation": [0, 3, 4], "look_at": [0, 0, 0], "camera": {}}]}])");
    for (int part = 0; part <= 48 * 5; ++part) {
        const double frame = part / 5.0, angle = 2.0 * std::numbers::pi * frame / 48.0;
        const CameraValues camera = pose(scene, frame_seconds(scene, frame)).cameras[0];
        const double tolerance = part % 5 == 0 ? exact : between;
        expect_near(camera.axes[2], {0.8 * std::sin(angle), 0.6, 0.8 * std::cos(angle)}, tolerance);
        expect_near(camera.axes[0], {std::cos(angle), 0.0, -std::sin(angle)}, tolerance);
        expect_near(camera.axes[1], {-0.6 * std::sin(angle), 0.8, -0.6 * std::cos(angle)}, tolerance);
    }
}

TEST(LookAt, BallOnAParabola) {
    const Scene scene = read(R"(, "fps": 24, "frames": [0, 48], "nodes": [
        {"name": "eye", "translation": [1, 1, 5], "look_at": "ball", "camera": {}},
        {"name": "ball", "translation": {"interpolation": "cubic", "unit": "seconds",
          "keys": [[0, [0, 0, 0], [-3, 0, 0], [3, 9.81, 0]], [2, [3, -9.81, 0], [3, 0, 0], [0, 0, 0]]]}}])");
    for (int part = 0; part <= 48 * 8; ++part) {
        const double seconds = frame_seconds(scene, part / 8.0);
        const glm::dvec3 ball(-3.0 + 3.0 * seconds, 9.81 * seconds - 0.5 * 9.81 * seconds * seconds, 0.0);
        const glm::dvec3 way = glm::normalize(ball - glm::dvec3(1.0, 1.0, 5.0));
        const CameraValues camera = pose(scene, seconds).cameras[0];
        expect_near(-camera.axes[2], way, part % 8 == 0 ? exact : between);
        EXPECT_NEAR(camera.axes[0].y, 0.0, part % 8 == 0 ? exact : between);
        EXPECT_GT(camera.axes[1].y, 0.0);
    }
    // A cubic needs few keys beyond those at frames.
    EXPECT_LT(scene.nodes[0].transform.rotation.key_count(), 49u * 2u);
    EXPECT_GE(scene.nodes[0].transform.rotation.key_count(), 49u);
    EXPECT_TRUE(again(scene) == scene);
}

TEST(LookAt, BelowParentsThatTurnAndStretch) {
    const Scene scene = read(R"(, "frames": [0, 30], "nodes": [
        {"name": "ship", "translation": {"interpolation": "smooth", "keys": [[0, [0, 0, 0]], [10, [1, 0.2, 0]], [30, [3, 0, -1]]]},
         "rotation": {"axis": [1, 2, 0.5], "degrees": {"interpolation": "smooth", "keys": [[0, 0], [12, 70], [30, 200]]}},
         "scale": {"keys": [[0, [1, 2, 0.5]], [30, [-2, 1, 1]]]}, "children": [
          {"name": "eye", "translation": [0, 1, 3], "scale": [2, 1, 3], "look_at": "bird", "up": [0, 0, 1], "camera": {}}]},
        {"name": "sky", "rotation": {"axis": [0, 0, 1], "degrees": {"keys": [[0, 0], [30, -300]]}}, "scale": [3, 1, 1], "children": [
          {"name": "bird", "translation": {"keys": [[0, [2, 3, -8]], [17, [3, 3, -9]], [30, [2, 5, -7]]]}}]}])");
    for (int part = 0; part <= 30 * 4; ++part) {
        const double seconds = frame_seconds(scene, part / 4.0);
        // A scale of the parent passes zero at frame 10: there it has no inverse, and the last rotation stays.
        if (std::abs(part / 4.0 - 10.0) < 0.6) continue;
        EXPECT_LT(miss_angle(scene, "eye", "bird", seconds), part % 4 == 0 ? 1e-12 : 1e-4) << part;
        const CameraValues camera = pose(scene, seconds).cameras[0];
        EXPECT_NEAR(camera.axes[0].z, 0.0, part % 4 == 0 ? 1e-12 : 1e-4) << part;
        EXPECT_GT(camera.axes[1].z, 0.0) << part;
    }
    const glm::dquat held = evaluate(scene.nodes[1].transform.rotation, frame_seconds(scene, 10.0));
    EXPECT_NEAR(glm::length(held), 1.0, 1e-15);
}

TEST(LookAt, PointsMayMoveAndScalesMayMirror) {
    const Scene scene = read(R"(, "nodes": [{"name": "eye", "translation": [0, 0, 1], "scale": [1, 1, -1],
        "look_at": {"keys": [[5, [-4, 0, 1]], [25, [4, 0, -3]]]}, "shape": {"type": "quad"}}])");
    EXPECT_EQ(frame_range(scene), (FrameRange{5, 25}));  // the keys of the point count
    for (int frame = 5; frame <= 25; ++frame) {
        const glm::dvec3 point = glm::mix(glm::dvec3(-4, 0, 1), glm::dvec3(4, 0, -3), (frame - 5) / 20.0);
        const glm::dmat4 world = world_at(scene, "eye", frame_seconds(scene, frame));
        expect_near(view_of(world), glm::normalize(point - glm::dvec3(0, 0, 1)), exact);
    }
    EXPECT_EQ(scene.nodes.size(), 1u);
}

TEST(LookAt, UpStaysUpWhereYIsMirrored) {
    const Scene scene = read(R"(, "nodes": [{"name": "eye", "scale": [1, -1, 1], "look_at": [1, 0.5, -3]}])");
    const glm::dmat4 world = world_at(scene, "eye", 0.0);
    expect_near(view_of(world), glm::normalize(glm::dvec3(1.0, 0.5, -3.0)), exact);
    EXPECT_GT(world[1].y, 0.9);
}

TEST(LookAt, OneKeyWhereNothingMoves) {
    const Scene scene =
        read(R"(, "frames": [0, 1000000000], "nodes": [{"name": "eye", "translation": [0, 2, 2], "look_at": "ball"},
        {"name": "ball", "translation": [0, 1, 1], "visible": {"values": [true]}}])");
    const glm::dquat turned = scene.nodes[0].transform.rotation.values.at(0);
    EXPECT_EQ(scene.nodes[0].transform.rotation, Track<glm::dquat>(turned));
    EXPECT_NEAR(turned.x, -std::sin(std::numbers::pi / 8.0), 1e-15);
    EXPECT_NEAR(turned.w, std::cos(std::numbers::pi / 8.0), 1e-15);
}

TEST(LookAt, HeldSpansHaveNoKeysOfTheirOwn) {
    const Scene scene = read(R"(, "nodes": [{"name": "eye", "look_at": "ball"},
        {"name": "ball", "translation": {"keys": [[0, [-1, 0, -2]], [10, [1, 0, -2]], [900, [1, 0, -2]], [910, [0, 0, -2]]]}}])");
    const Track<glm::dquat>& track = scene.nodes[0].transform.rotation;
    EXPECT_LT(track.key_count(), 100u);
    const glm::dquat held = evaluate(track, frame_seconds(scene, 10.0));
    for (const double frame : {11.5, 400.0, 899.9, 900.0})
        EXPECT_EQ(evaluate(track, frame_seconds(scene, frame)), held);
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 910}));
}

TEST(LookAt, JumpsStayJumps) {
    const Scene scene = read(R"(, "frames": [0, 20], "nodes": [{"name": "eye", "look_at": "ball"},
        {"name": "ball", "translation": {"interpolation": "step", "keys": [[0, [0, 0, -2]], [10, [2, 0, 0]]]}}])");
    for (const double frame : {0.0, 5.3, 9.0, 9.5, 9.99}) expect_near(view_at(scene, "eye", frame), {0, 0, -1}, exact);
    for (const double frame : {10.0, 10.01, 11.0, 20.0}) expect_near(view_at(scene, "eye", frame), {1, 0, 0}, exact);
}

TEST(LookAt, TheFramesOfAnOpenShutterHaveKeys) {
    const std::string ball = R"({"name": "ball", "translation": {"keys": [[-100, [-9, 0, -2]], [200, [9, 0, -2]]]}})";
    const Scene scene = read(R"(, "frames": [10, 20], "nodes": [{"name": "eye", "look_at": "ball",
        "camera": {"shutter": [-3.5, 2.5]}}, )" +
                             ball + "]");
    const std::vector<double>& times = scene.nodes[0].transform.rotation.sampling.times;
    EXPECT_NEAR(times.front() * 30.0, 6.0, 1e-9);
    EXPECT_NEAR(times.back() * 30.0, 23.0, 1e-9);
    const Scene still = read(R"(, "frames": [10, 20], "nodes": [{"name": "eye", "look_at": "ball"}, )" + ball + "]");
    EXPECT_NEAR(still.nodes[0].transform.rotation.sampling.times.front() * 30.0, 9.0, 1e-9);
    EXPECT_NEAR(still.nodes[0].transform.rotation.sampling.times.back() * 30.0, 21.0, 1e-9);
}

TEST(LookAt, StraightOverheadTheLastRotationTurnsOn) {
    // The ball passes straight above the eye at frame 10.
    const Scene scene = read(R"(, "nodes": [{"name": "eye", "look_at": "ball"},
        {"name": "ball", "translation": {"keys": [[0, [-1, 2, 0]], [20, [1, 2, 0]]]}}])");
    const glm::dmat4 overhead = world_at(scene, "eye", frame_seconds(scene, 10.0));
    expect_near(view_of(overhead), {0, 1, 0}, exact);
    expect_near(glm::dvec3(overhead[0]), {0, 0, -1}, 1e-9);                     // as before
    EXPECT_LT(largest_turn_degrees(scene.nodes[0].transform.rotation), 100.0);  // loading warns above 170
    for (int part = 0; part <= 20 * 8; ++part) {
        const glm::dmat4 world = world_at(scene, "eye", frame_seconds(scene, part / 8.0));
        const double x = -1.0 + part / 80.0;
        expect_near(view_of(world), glm::normalize(glm::dvec3(x, 2.0, 0.0)), part % 8 == 0 ? exact : between);
        EXPECT_NEAR(world[0].z, part / 8.0 <= 10.0 ? -1.0 : 1.0, 1e-6) << part;
    }
}

TEST(LookAt, AlwaysStraightDownAndUp) {
    const Scene scene = read(R"(, "nodes": [{"name": "down", "translation": [0, 5, 0], "look_at": [0, 0, 0]},
        {"name": "up", "look_at": [0, 5, 0]}, {"name": "z", "translation": [0, 0, 5], "up": [0, 0, 2], "look_at": [0, 0, 0]}])");
    expect_near(glm::dvec3(world_at(scene, "down", 0.0)[1]), {0, 0, -1}, exact);
    expect_near(glm::dvec3(world_at(scene, "up", 0.0)[1]), {0, 0, 1}, exact);
    expect_near(glm::dvec3(world_at(scene, "z", 0.0)[1]), {0, 1, 0}, exact);
    expect_near(view_at(scene, "z", 0.0), {0, 0, -1}, exact);
}

TEST(LookAt, WhereTheTargetIsAtTheNodeTheRotationStays) {
    const Scene scene = read(R"(, "nodes": [{"name": "eye", "look_at": "ball"},
        {"name": "ball", "translation": {"keys": [[0, [0, 0, 0]], [5, [0, 0, 0]], [10, [2, 0, 0]], [20, [-2, 0, 0]], [25, [0, 0, 0]]]}}])");
    for (const double frame : {0.0, 3.0, 5.0, 8.0, 15.0}) expect_near(view_at(scene, "eye", frame), {1, 0, 0}, exact);
    for (const double frame : {16.0, 20.0, 25.0}) expect_near(view_at(scene, "eye", frame), {-1, 0, 0}, exact);
    for (int part = 0; part <= 250; ++part) {
        const glm::dquat q = evaluate(scene.nodes[0].transform.rotation, frame_seconds(scene, part / 10.0));
        EXPECT_NEAR(glm::length(q), 1.0, 1e-14);
    }
}

TEST(LookAt, NodesThatLookAtEachOtherInAnyOrder) {
    const Scene scene = read(R"(, "frames": [0, 12], "nodes": [
        {"name": "last", "translation": [0, 0, 3], "look_at": "tip"},
        {"name": "arm", "look_at": "hand", "children": [{"name": "tip", "translation": [0, 0, -1]}]},
        {"name": "hand", "translation": {"keys": [[0, [1, 0, -3]], [12, [4, 1, 0]]]}, "look_at": "arm"}])");
    for (int frame = 0; frame <= 12; ++frame) {
        const double seconds = frame_seconds(scene, frame);
        EXPECT_LT(miss_angle(scene, "last", "tip", seconds), exact);
        EXPECT_LT(miss_angle(scene, "arm", "hand", seconds), exact);
        EXPECT_LT(miss_angle(scene, "hand", "arm", seconds), exact);
    }
}

TEST(LookAt, CopiesTurnLikeTheirOriginals) {
    const Scene scene = read(R"(, "frames": [0, 10], "nodes": [
        {"name": "lamp", "children": [{"name": "head", "translation": [0, 1, 0], "look_at": "ball", "shape": {"type": "box"},
          "children": [{"name": "nose", "translation": [0, 0, -1]}]}]},
        {"name": "copy", "instance": "lamp", "translation": [5, 0, 0]},
        {"name": "eye", "translation": [9, 9, 9], "look_at": "copy/nose"},
        {"name": "ball", "translation": {"keys": [[0, [1, 0, 1]], [10, [-1, 0, 1]]]}}])");
    EXPECT_EQ(scene.nodes[find_named(scene.nodes, "copy/head")].transform.rotation,
              scene.nodes[find_named(scene.nodes, "head")].transform.rotation);
    EXPECT_GT(scene.nodes[find_named(scene.nodes, "head")].transform.rotation.key_count(), 10u);
    for (int frame = 0; frame <= 10; ++frame)
        EXPECT_LT(miss_angle(scene, "eye", "copy/nose", frame_seconds(scene, frame)), exact);
}

TEST(LookAt, HugeAndTinyParents) {
    for (const char* scale : {"1e-9", "1e9"}) {
        const Scene scene = read(std::string(R"(, "nodes": [{"name": "p", "scale": )") + scale + R"(, "children": [
            {"name": "eye", "translation": [1, 0, 0], "look_at": "ball"}, {"name": "ball", "translation": [1, 1, -1]}]}])");
        EXPECT_LT(miss_angle(scene, "eye", "ball", 0.0), 1e-13) << scale;
    }
}

}  // namespace
}  // namespace aleph
