// The writer of .glb: keys of all interpolations, turns, matrices, inheritance.
#include <glm/gtc/matrix_transform.hpp>

#include "tests/engine/gltf/exported.h"
#include "tests/support/read_bytes.h"
#include "tests/support/refusal.h"
#include "tests/support/scenes/deforming_scenes.h"

namespace aleph {
namespace {

/// A mesh under node 1, below node 0; frames 0 to 30 at 30 per second.
Scene make_two_nodes() {
    Scene scene = make_sheet_scene();
    scene.nodes.resize(2);
    scene.nodes[0].name = "upper";
    scene.nodes[0].meshes.clear();
    scene.nodes[1] = {.name = "lower", .parent = 0, .meshes = {0}};
    scene.film.range = FrameRange{0, 30};
    return scene;
}

/// The largest difference of world matrices at frames, or anywhere.
/// @param steps  times a frame
double difference_of(const Exported& files, int steps) {
    double largest = 0.0;
    for (int i = 0; i <= 30 * steps; ++i) largest = std::max(largest, files.world_difference(i / (30.0 * steps), 1.0));
    return largest;
}

/// Keys between which floats of the times make no difference.
const std::vector<double> exact_times{0.0, 0.25, 0.75, 1.0};

TEST(GltfWrite, KeysOfEachInterpolation) {
    for (const Interpolation how : {Interpolation::step, Interpolation::linear, Interpolation::nearest}) {
        Scene scene = make_two_nodes();
        LocalTransform& upper = scene.nodes[0].transform;
        upper.translation = Track<glm::dvec3>(exact_times, {{1, 2, 3}, {4, 5, 7}, {4, 5, 7}, {0, 1, -1}}, how);
        upper.scale = Track<glm::dvec3>(exact_times, {{1, 1, 1}, {2, 1, 1}, {1, -0.5, 1}, {1, 1, 1}}, how);
        scene.nodes[1].transform.rotation =
            Track<glm::dquat>(exact_times, {{1, 0, 0, 0}, {0.6, 0.8, 0, 0}, {0, 0, 1, 0}, {-0.6, 0, 0, 0.8}}, how);
        const Exported files(scene, "write_" + std::to_string(static_cast<int>(how)));
        EXPECT_LT(difference_of(files, 8), 5e-7) << static_cast<int>(how);
        EXPECT_EQ(files.after.nodes.size(), 2u + 1u) << "the camera that is added, and no other";
    }
}

TEST(GltfWrite, CubicKeysStayCubic) {
    Scene scene = make_two_nodes();
    scene.nodes[0].transform.translation = Track<glm::dvec3>(
        {0.0, 0.5, 1.0},
        {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 1, 0}, {0, 0, 3}, {0, 0, 0}, {2, 0, 0}, {0, 0, 0}},
        Interpolation::cubic);
    scene.nodes[1].transform.rotation = Track<glm::dquat>(
        {0.0, 1.0}, {{0, 0, 0, 0}, {2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 2, 0}, {0, 0, 0, 3}, {0, 0, 0, 0}},
        Interpolation::cubic);
    const Exported files(scene, "write_cubic");
    EXPECT_LT(difference_of(files, 8), 5e-7);
    EXPECT_EQ(files.after.nodes[files.nodes_after[0]].transform.translation.interpolation, Interpolation::cubic);
    EXPECT_EQ(files.after.nodes[files.nodes_after[1]].transform.rotation.interpolation, Interpolation::cubic);
}

TEST(GltfWrite, StepsHoldAtTheirOwnFrames) {
    // No float is a third or a seventh: the file's keys lie before, not after.
    Scene scene = make_two_nodes();
    std::vector<double> times;
    std::vector<glm::dvec3> values;
    for (int frame = 0; frame <= 30; ++frame) {
        times.push_back(frame / 30.0);
        values.emplace_back(frame, 0, 0);
    }
    scene.nodes[0].transform.translation = Track<glm::dvec3>(times, values, Interpolation::step);
    const Exported files(scene, "write_steps");
    for (int frame = 0; frame <= 30; ++frame) EXPECT_EQ(files.world_difference(frame / 30.0, 1.0), 0.0) << frame;
}

TEST(GltfWrite, WhatRestsKeepsItsBits) {
    Scene scene = make_two_nodes();
    scene.nodes[0].transform.translation =
        Track<glm::dvec3>({0.1, 0.3, 0.7, 0.9}, {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {5, 0, 0}});
    const Exported files(scene, "write_rests");
    const auto at = [&](double t) { return pose(files.after, t).world[files.nodes_after[0]][3].x; };
    EXPECT_EQ(at(0.4), 1.0);
    EXPECT_EQ(at(0.6), 1.0);
}

glm::dmat4 scaling(const glm::dvec3& factors) {
    return glm::scale(glm::dmat4(1.0), factors);
}

TEST(GltfWrite, MatricesWithShearTakeTwoNodes) {
    Scene scene = make_two_nodes();
    glm::dmat4 sheared(1.0);
    sheared[1].x = 0.7;
    glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 0.5, glm::dvec3(0.0, 0.6, 0.8)) * sheared;
    turned[2] *= -1.5;  // mirrored
    scene.nodes[0].transform.matrix = Track<glm::dmat4>(turned);
    const Exported constant(scene, "write_shear");
    EXPECT_LT(difference_of(constant, 1), 1e-12);
    EXPECT_EQ(constant.after.nodes[1].name, "upper.shear");
    glm::dmat4 moved = turned;
    moved[3] = glm::dvec4(1.0, 2.0, 3.0, 1.0);
    scene.nodes[0].transform.matrix = Track<glm::dmat4>({0.0, 1.0}, {turned, glm::dmat4(moved)});
    const Exported keys(scene, "write_shear_keys");
    EXPECT_LT(difference_of(keys, 1), 1e-6);
}

TEST(GltfWrite, MatricesWithoutShearStayWithTheirKeys) {
    Scene scene = make_two_nodes();
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 2.9, glm::dvec3(1, 0, 0));
    scene.nodes[0].transform.matrix =
        Track<glm::dmat4>({0.0, 1.0}, {scaling({1, 2, -3}), turned * scaling({2, 1, -1})});
    const Exported files(scene, "write_matrices");
    EXPECT_LT(difference_of(files, 8), 2e-6);
    EXPECT_LE(files.after.nodes[files.nodes_after[0]].transform.rotation.key_count(), 3u);
}

TEST(GltfWrite, FlatMatricesAndScalesThroughZero) {
    Scene scene = make_two_nodes();
    const glm::dvec3 whole(1, 1, 1);
    for (const auto& [from, to] :
         {std::pair{glm::dvec3(1, 1, 0), glm::dvec3(0, 1, 0)}, {whole, {-1, 1, 1}}, {whole, {0, 0, 0}}}) {
        scene.nodes[0].transform.matrix = Track<glm::dmat4>({0.0, 1.0}, {scaling(from), scaling(to)});
        EXPECT_LT(difference_of(Exported(scene, "write_flat"), 1), 1e-6);
    }
}

TEST(GltfWrite, OperationsAndInheritance) {
    using Kind = OperationStack::Kind;
    Scene scene = make_two_nodes();
    // Turned, stretched along another axis, turned on: a shear that changes.
    scene.nodes[0].transform.operations = OperationStack{
        {Kind::translate, Kind::rotate_z, Kind::scale, Kind::rotate_x},
        {TimeSampling::Kind::uniform, 0.0, 0.5, {}},
        {0, 0, 0, 0, 1, 1, 1, 0, /**/ 1, 2, 3, 0.5, 1, 2, 1, 1, /**/ 0, 1, 0, 1, 2, 1, 1, 2},
    };
    scene.nodes[1].transform.translation = glm::dvec3(0.5, 0.25, 0.0);
    scene.nodes[1].inherits = Track<double>({0.0, 0.4, 0.8}, {1.0, 0.0, 1.0}, Interpolation::step);
    const Exported files(scene, "write_operations");
    EXPECT_LT(difference_of(files, 1), 1e-6);
    EXPECT_LT(difference_of(files, 4), 3e-3) << "between frames";
    scene.nodes[1].inherits = Track<double>(0.0);
    EXPECT_LT(difference_of(Exported(scene, "write_alone"), 1), 1e-6);
}

TEST(GltfWrite, MotionBeforeZeroIsLeftOut) {
    Scene scene = make_two_nodes();
    scene.film.range = FrameRange{-30, 30};
    scene.nodes[0].transform.translation =
        Track<glm::dvec3>({-1.0, -0.5, 0.25, 0.5}, {{0, 0, 0}, {4, 0, 0}, {1, 0, 0}, {0, 0, 1}});
    scene.nodes[1].transform.scale =
        Track<glm::dvec3>({-1.0, -0.5, 0.5}, {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}}, Interpolation::step);
    scene.nodes[1].transform.axis_rotation = {{0, 0, 1}, Track<double>({-2.0, 0.5}, {-9.0, 1.0})};
    EXPECT_LT(difference_of(Exported(scene, "write_before"), 8), 2e-6);
}

TEST(GltfWrite, EqualScenesGiveEqualBytes) {
    const Scene scene = make_everything_scene();
    const Exported first(scene, "write_everything");
    const std::string bytes = read_bytes(first.file);
    const Exported second(scene, "write_everything");
    EXPECT_EQ(bytes, read_bytes(second.file));
    for (int i = 0; i <= 60; ++i) EXPECT_LT(first.world_difference(i / 30.0, 1.0), 2e-6) << i;
}

TEST(GltfWrite, LongRangesAreRefusedBeforeTheyTakeMemory) {
    const double ages = 1e9;
    const auto refused = [&](const Scene& scene) {
        return find_refusal([&] { write_gltf(scene, round_trip_folder / "never.glb"); }).reason;
    };
    Scene scene = make_two_nodes();
    scene.film.range.reset();
    scene.nodes[0].transform.operations =
        OperationStack{{OperationStack::Kind::rotate_y}, {TimeSampling::Kind::uniform, 0.0, ages, {}}, {0.0, 1.0}};
    EXPECT_NE(refused(scene).find("shorten the range"), std::string::npos) << refused(scene);
    scene = make_two_nodes();
    scene.nodes[0].transform.axis_rotation = {{0, 1, 0}, Track<double>({0.0, 1.0}, {0.0, 1e12})};
    EXPECT_LT(difference_of(Exported(scene, "write_spin"), 1), 1e-3) << "the frames alone";
    EXPECT_FALSE(std::filesystem::exists(round_trip_folder / "never.glb"));
}

/// As in a shot with a run-up: what changed before 0 s keeps the value that it has then.
TEST(GltfWrite, WhatChangedBeforeZeroKeepsItsLastValue) {
    Scene scene = make_two_nodes();
    scene.materials.resize(1);
    scene.meshes[0].material = 0;
    const std::vector<double> early{-2.0, -1.0};
    scene.nodes[0].transform.translation = Track<glm::dvec3>(early, {{0, 0, 0}, {1, 2, 3}});
    scene.nodes[0].transform.scale = Track<glm::dvec3>({-2.0, 0.0, 1.0}, {{0.1, 1, 1}, {1, 1, 1}, {1, 1, 1}});
    scene.nodes[1].transform.axis_rotation = AxisRotation{{0.0, 1.0, 0.0}, Track<double>(early, {0.0, 1.5})};
    scene.nodes[1].visible = Track<double>(early, {0.0, 1.0}, Interpolation::step);
    scene.materials[0].base_color = Track<glm::dvec3>(early, {{1, 0, 0}, {0, 1, 0}});
    scene.lights.push_back({.intensity = Track<double>(early, {0.0, 5.0})});
    scene.nodes[1].light = static_cast<int>(scene.lights.size()) - 1;
    const Exported files(scene, "write_early");
    EXPECT_LT(difference_of(files, 1), 1e-6);
    const ScenePose after = pose(files.after, 0.5);
    EXPECT_TRUE(std::ranges::all_of(after.visible, [](std::uint8_t visible) { return visible != 0; }));
    EXPECT_EQ(after.materials[0].base_color, Rgb(0.0f, 1.0f, 0.0f));
    EXPECT_EQ(after.lights[0].intensity, Rgb(5.0f));
}

/// 0 has a meaning of its own, and no number between keys: what stands for it is in the reader's range.
TEST(GltfWrite, UnlimitedRangesAndDistancesAreRead) {
    Scene scene = make_two_nodes();
    scene.materials.resize(1);
    scene.meshes[0].material = 0;
    scene.lights.push_back({.range = Track<double>({0.0, 1.0}, {0.0, 10.0}, Interpolation::step)});
    scene.nodes[1].light = static_cast<int>(scene.lights.size()) - 1;
    scene.materials[0].glass = {.transmission = 1.0,
                                .thickness = 1.0,
                                .attenuation_distance = Track<double>({0.0, 1.0}, {0.0, 3.0}, Interpolation::step)};
    const Exported files(scene, "write_unlimited");
    EXPECT_GT(pose(files.after, 0.5).lights[0].range, 1e6f);
    EXPECT_GT(pose(files.after, 0.5).materials[0].glass.attenuation_distance, 1e6f);
    EXPECT_EQ(pose(files.after, 1.0).lights[0].range, 10.0f);
}

}  // namespace
}  // namespace aleph
