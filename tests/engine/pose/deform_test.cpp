// Known answers of deforming meshes, and of updates that touch only what moves: engine/pose/deform.h, plan.h.

#include "engine/pose/deform.h"
#include "engine/pose/plan.h"
#include "tests/support/scenes/deforming_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(Deform, PointsAreLinearBetweenSamplesAndExactOnThem) {
    Scene scene = make_sheet_scene();
    add_cache(scene, 0, {0.0, 2.0}, [](const glm::vec3& p, std::size_t sample) {
        return p + glm::vec3(0.0f, 0.0f, static_cast<float>(sample) * (1.0f + p.x));
    });
    const Mesh& mesh = scene.meshes[0];
    const ScenePose middle = pose(scene, 0.5);
    ASSERT_EQ(middle.meshes[0].positions.size(), mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::dvec3 rest(mesh.positions[v]);
        expect_near(middle.meshes[0].positions[v], rest + glm::dvec3(0.0, 0.0, 0.25 * (1.0 + rest.x)), 1e-7);
        for (const double late : {2.0, 9.0})
            EXPECT_EQ(pose(scene, late).meshes[0].positions[v], glm::dvec3(scene.point_caches[0].positions[1][v]));
        EXPECT_EQ(pose(scene, -1.0).meshes[0].positions[v], rest);
    }
}

TEST(Deform, VerticesFindTheirPoints) {
    Scene scene = make_sheet_scene();
    add_cache(scene, 0, {0.0, 1.0}, [](const glm::vec3& p, std::size_t sample) {
        return p + glm::vec3(0.0f, static_cast<float>(sample), 0.0f);
    });
    Mesh& mesh = scene.meshes[0];
    std::vector<std::uint32_t>& to = mesh.deformation.vertex_points;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
        to.push_back(static_cast<std::uint32_t>(mesh.positions.size()) - 1 - v);
    const ScenePose frame = pose(scene, 1.0);
    for (std::size_t v = 0; v < to.size(); ++v)
        EXPECT_EQ(frame.meshes[0].positions[v], glm::dvec3(scene.point_caches[0].positions[1][to[v]]));
}

TEST(Deform, WhatNeverMovesIsRigid) {
    Scene scene = make_sheet_scene();
    add_cache(scene, 0, {0.0, 1.0, 2.0}, [](const glm::vec3& p, std::size_t) { return p; });
    EXPECT_TRUE(pose(scene, 0.5).meshes[0].positions.empty());
    EXPECT_TRUE(make_pose_plan(scene).deformers.empty());
    EXPECT_TRUE(make_pose_plan(scene).instances.empty());
    scene.meshes[0].deformation.targets.resize(1);
    scene.meshes[0].deformation.targets[0].positions.assign(scene.meshes[0].positions.size(), glm::vec3(1.0f));
    scene.meshes[0].deformation.points = no_index;
    scene.meshes[0].deformation.target_weights = {Track<double>(0.0)};
    EXPECT_TRUE(pose(scene, 0.5).meshes[0].positions.empty());
    scene.meshes[0].deformation.target_weights = {Track<double>(0.5)};  // posed, though always alike
    EXPECT_EQ(pose(scene, 0.5).meshes[0].positions[0], glm::dvec3(scene.meshes[0].positions[0]) + 0.5);
    EXPECT_TRUE(make_pose_plan(scene).instances.empty());
}

TEST(Deform, OnlyShownMeshesAreFilled) {
    Scene scene = make_sheet_scene();
    add_cache(scene, 0, {0.0, 1.0},
              [](const glm::vec3& p, std::size_t s) { return p * (1.0f + static_cast<float>(s)); });
    scene.nodes[0].visible = Track<double>({0.0, 1.0}, {0.0, 1.0});
    EXPECT_TRUE(pose(scene, 0.5).meshes[0].positions.empty());
    EXPECT_FALSE(pose(scene, 1.0).meshes[0].positions.empty());
    scene.nodes[0].visible = 1.0;
    scene.meshes[0].present = Track<double>({0.0, 1.0}, {1.0, 0.0}, Interpolation::step);
    EXPECT_FALSE(pose(scene, 0.5).meshes[0].positions.empty());
    EXPECT_TRUE(pose(scene, 1.0).meshes[0].positions.empty());
    ScenePose posed = pose(scene, 0.5);
    update_pose(scene, make_pose_plan(scene), 1.0, posed);
    EXPECT_TRUE(posed.meshes[0].positions.empty());
    update_pose(scene, make_pose_plan(scene), 0.5, posed);
    EXPECT_FALSE(posed.meshes[0].positions.empty());
}

/// A node with a hinge: two squares, with vertices of their own on its axis.
Scene make_hinge() {
    Scene scene = make_sheet_scene();
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {-1, 1, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
    mesh.triangles = {{2, 0, 1}, {2, 1, 3}, {4, 6, 7}, {4, 7, 5}};
    mesh.normals.assign(8, glm::vec3(0.0f, 0.0f, 1.0f));
    scene.meshes = {mesh};
    return scene;
}

TEST(Deform, NormalsFollowTheTrianglesAndEdgesStaySharp) {
    Scene scene = make_hinge();
    scene.meshes[0].deformation.vertex_points = {0, 1, 2, 3, 0, 1, 4, 5};  // the points of the axis are shared
    scene.meshes[0].deformation.points = 0;
    PointCache cache;
    cache.sampling.period = 1.0;
    cache.positions = {{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {-1, 1, 0}, {1, 0, 0}, {1, 1, 0}},
                       {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {-1, 1, 0}, {0, 0, 1}, {0, 1, 1}}};
    scene.point_caches = {cache};
    const ScenePose smooth = pose(scene, 1.0);  // the right square stands up and faces -x
    expect_near(smooth.meshes[0].normals[2], {0.0, 0.0, 1.0}, 1e-6);
    expect_near(smooth.meshes[0].normals[6], {-1.0, 0.0, 0.0}, 1e-6);
    expect_near(smooth.meshes[0].normals[0], glm::normalize(glm::dvec3(-1.0, 0.0, 1.0)), 1e-6);
    EXPECT_EQ(smooth.meshes[0].normals[0], smooth.meshes[0].normals[4]);
    for (const std::size_t v : {4, 5, 6, 7})
        scene.meshes[0].normals[v] = glm::vec3(0.1f, 0.0f, 1.0f);  // an edge at rest
    const ScenePose sharp = pose(scene, 1.0);
    expect_near(sharp.meshes[0].normals[0], {0.0, 0.0, 1.0}, 1e-6);
    expect_near(sharp.meshes[0].normals[4], {-1.0, 0.0, 0.0}, 1e-6);
    scene.meshes[0].normals.clear();
    EXPECT_TRUE(pose(scene, 1.0).meshes[0].normals.empty());  // flat stays flat
}

/// The hinge's axis is a seam of the texture: its vertices are listed twice, and are points of their own.
TEST(Deform, NormalsStaySmoothAcrossSeams) {
    Scene scene = make_hinge();
    scene.meshes[0].positions[4].x = -1e-8f;  // as computed from an angle of a full turn
    scene.meshes[0].normals[4].x = 1e-7f;
    const Mesh mesh = scene.meshes[0];
    const auto stand_up = [](const glm::vec3& p, std::size_t sample) {
        return sample == 1 && p.x > 0.0f ? glm::vec3(0.0f, p.y, 1.0f) : p;
    };
    add_cache(scene, 0, {0.0, 1.0}, stand_up);
    const ScenePose smooth = pose(scene, 1.0);
    expect_near(smooth.meshes[0].normals[0], glm::normalize(glm::dvec3(-1.0, 0.0, 1.0)), 1e-6);
    EXPECT_EQ(smooth.meshes[0].normals[0], smooth.meshes[0].normals[4]);
    for (const std::size_t v : {4, 5, 6, 7}) scene.meshes[0].normals[v] = glm::vec3(0.1f, 0.0f, 1.0f);
    expect_near(pose(scene, 1.0).meshes[0].normals[0], {0.0, 0.0, 1.0}, 1e-6);  // an edge at rest stays one
    // Vertices that come apart are two points.
    scene.meshes[0] = mesh;
    scene.point_caches.clear();
    std::size_t vertex = 0;
    add_cache(scene, 0, {0.0, 1.0}, [&](const glm::vec3& p, std::size_t sample) {
        return stand_up(p, sample) + (vertex++ % 8 >= 4 && sample == 1 ? glm::vec3(0.5f, 0.0f, 0.0f) : glm::vec3(0.0f));
    });
    expect_near(pose(scene, 1.0).meshes[0].normals[0], {0.0, 0.0, 1.0}, 1e-6);
}

TEST(Deform, NormalsAreWeightedByAngleHoweverFacesAreCut) {
    // Three sides of a box of 2 x 3 x 1 m around a corner; one is cut through the corner, the others across it.
    Scene scene;
    scene.nodes.resize(1);
    scene.nodes[0].meshes = {0};
    Mesh mesh;
    for (const glm::vec3& to : {glm::vec3(0), {2, 0, 0}, {0, 3, 0}, {0, 0, 1}, {2, 3, 0}, {0, 3, 1}, {2, 0, 1}})
        mesh.positions.push_back(glm::vec3(5.0f, 6.0f, 7.0f) - to);
    mesh.triangles = {{0, 1, 4}, {0, 4, 2}, {0, 2, 3}, {2, 5, 3}, {0, 3, 1}, {3, 6, 1}, {0, 0, 1}};
    mesh.normals.assign(7, glm::vec3(0.0f, 0.0f, 1.0f));
    scene.meshes = {mesh};
    add_cache(scene, 0, {0.0, 1.0},
              [](const glm::vec3& p, std::size_t s) { return p + glm::vec3(static_cast<float>(s)); });
    const ScenePose frame = pose(scene, 1.0);
    const glm::dvec3 expected[] = {{1, 1, 1}, {0, 1, 1}, {1, 0, 1}, {1, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    for (std::size_t v = 0; v < 7; ++v) expect_near(frame.meshes[0].normals[v], glm::normalize(expected[v]), 1e-6);
}

TEST(Deform, NormalSamplesAreTakenWhereGiven) {
    Scene scene = make_sheet_scene();
    add_cache(scene, 0, {0.0, 1.0}, [](const glm::vec3& p, std::size_t) { return p; });
    const std::size_t count = scene.meshes[0].positions.size();
    scene.meshes[0].normals.assign(count, glm::vec3(0.0f, 0.0f, 1.0f));
    scene.meshes[0].deformation.normal_sampling.period = 2.0;
    scene.meshes[0].deformation.normal_samples = {scene.meshes[0].normals, {count, glm::vec3(1.0f, 0.0f, 0.0f)}};
    const ScenePose frame = pose(scene, 1.0);  // the points stand still, the normals do not
    EXPECT_EQ(frame.meshes[0].normals[3], glm::vec3(0.5f, 0.0f, 0.5f));
    EXPECT_EQ(frame.meshes[0].positions[3], glm::dvec3(scene.meshes[0].positions[3]));
}

TEST(Deform, MorphTargetsAddUp) {
    Scene scene = make_sheet_scene();
    Mesh& mesh = scene.meshes[0];
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0.0f, 0.0f, 1.0f));
    mesh.deformation.targets.resize(2);
    mesh.deformation.targets[0].positions.assign(mesh.positions.size(), glm::vec3(0.0f, 2.0f, 0.0f));
    mesh.deformation.targets[0].normals.assign(mesh.positions.size(), glm::vec3(2.0f, 0.0f, 0.0f));
    mesh.deformation.targets[1].positions.assign(mesh.positions.size(), glm::vec3(0.0f, 0.0f, -4.0f));
    mesh.deformation.target_weights = {Track<double>({0.0, 1.0}, {0.0, 1.0}), Track<double>(0.25)};
    const PosedMesh posed = pose(scene, 0.5).meshes[0];
    EXPECT_EQ(posed.positions[0], glm::dvec3(mesh.positions[0]) + glm::dvec3(0.0, 1.0, -1.0));
    expect_near(posed.normals[0], glm::normalize(glm::dvec3(1.0, 0.0, 1.0)), 1e-7);
}

TEST(Deform, MorphedMeshesStandUnderSeveralNodes) {
    Scene scene = make_sheet_scene();
    Mesh& mesh = scene.meshes[0];
    mesh.deformation.targets.resize(1);
    mesh.deformation.targets[0].positions.assign(mesh.positions.size(), glm::vec3(0.0f, 2.0f, 0.0f));
    mesh.deformation.target_weights = {Track<double>({0.0, 1.0}, {0.0, 1.0})};
    scene.nodes.push_back(scene.nodes[0]);
    for (const std::size_t hidden : {0, 1}) {
        scene.nodes[hidden].visible = 0.0;
        scene.nodes[1 - hidden].visible = 1.0;
        EXPECT_EQ(pose(scene, 0.5).meshes[0].positions[0], glm::dvec3(mesh.positions[0]) + glm::dvec3(0.0, 1.0, 0.0));
    }
}

TEST(Deform, SkinFollowsItsJointsWhateverItsOwnNodeDoes) {
    Scene scene = make_skin_scene();
    for (const double angle : {0.0, 30.0, 90.0, 210.0}) {
        scene.nodes[2].transform.rotation = glm::angleAxis(angle * pi / 180.0, glm::dvec3(0.0, 0.0, 1.0));
        const ScenePose frame = pose(scene, 0.0);
        for (std::size_t v = 0; v < scene.meshes[0].positions.size(); ++v) {
            const glm::dvec3 world(frame.world[0] * glm::dvec4(frame.meshes[0].positions[v], 1.0));
            expect_near(world, bent_by(scene.meshes[0].positions[v], angle * pi / 180.0), 1e-6);
        }
    }
    scene.nodes[0].transform.scale = glm::dvec3(1.0, 0.0, 1.0);
    const ScenePose flat = pose(scene, 0.0);
    for (const glm::dvec3& p : flat.meshes[0].positions) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
}

/// A quarter of one joint, which rests, and three of one that stretches and moves.
TEST(Deform, JointsAreBlendedByTheirWeights) {
    for (const float whole : {1.0f, 0.5f}) {
        Scene scene = make_skin_scene();
        scene.nodes[0].transform = {};
        scene.nodes[2].transform.translation = glm::dvec3(4.0, 0.0, 1.0);
        scene.nodes[2].transform.scale = glm::dvec3(1.0, 5.0, 1.0);
        Mesh& mesh = scene.meshes[0];
        mesh.normals.assign(mesh.positions.size(), glm::normalize(glm::vec3(1.0f, 1.0f, 0.0f)));
        for (std::size_t i = 0; i < mesh.deformation.joint_weights.size(); ++i)
            mesh.deformation.joint_weights[i].weight = (i % 2 == 0 ? 0.25f : 0.75f) * whole;
        const PosedMesh posed = pose(scene, 0.0).meshes[0];
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            const glm::dvec3 rest(mesh.positions[v]);
            expect_near(posed.positions[v], glm::dvec3(rest.x + 3.0, 4.0 * rest.y, rest.z), 1e-6);
            expect_near(posed.normals[v], glm::normalize(glm::dvec3(1.0, 0.25, 0.0)), 1e-6);
        }
    }
}

TEST(Deform, VerticesWithoutWeightsStayAtRest) {
    Scene scene = make_skin_scene();
    Mesh& mesh = scene.meshes[0];
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0.0f, 0.0f, 1.0f));
    mesh.deformation.joint_weights[0].weight = mesh.deformation.joint_weights[1].weight = 0.0f;
    const PosedMesh posed = pose(scene, 0.0).meshes[0];
    EXPECT_EQ(posed.positions[0], glm::dvec3(mesh.positions[0]));
    EXPECT_EQ(posed.normals[0], mesh.normals[0]);
    EXPECT_NE(posed.positions[1], glm::dvec3(mesh.positions[1]));
}

void expect_same(const ScenePose& a, const ScenePose& b) {
    EXPECT_EQ(a.seconds, b.seconds);
    EXPECT_EQ(a.world, b.world);
    EXPECT_EQ(a.visible, b.visible);
    EXPECT_EQ(a.instances, b.instances);
    EXPECT_EQ(a.shown, b.shown);
    EXPECT_EQ(a.meshes, b.meshes);
    EXPECT_EQ(a.materials, b.materials);
    EXPECT_EQ(a.lights, b.lights);
    EXPECT_EQ(a.cameras, b.cameras);
    EXPECT_EQ(a.environment, b.environment);
    EXPECT_EQ(a.environment_rotation, b.environment_rotation);
}

TEST(PosePlan, UpdatesGiveTheBitsOfAFreshPose) {
    const Scene scene = make_everything_scene();
    const PosePlan plan = make_pose_plan(scene);
    EXPECT_LT(plan.nodes.size(), scene.nodes.size());
    ScenePose frame = pose(scene, 0.0);
    for (const double seconds : {0.0, 0.3, 2.0, 1.1, 1.0, -4.0, 0.5, 0.77, 9.0, 0.25}) {
        SCOPED_TRACE(seconds);
        update_pose(scene, plan, seconds, frame);
        expect_same(frame, pose(scene, seconds));
    }
}

TEST(PosePlan, NamesOnlyWhatCanChange) {
    const Scene scene = make_everything_scene();
    const PosePlan plan = make_pose_plan(scene);
    const ScenePose a = pose(scene, 0.1), b = pose(scene, 0.9);
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
        EXPECT_TRUE(plan.moving[n] != 0 || a.world[n] == b.world[n]) << n;
    EXPECT_EQ(make_pose_plan(make_sheet_scene()).nodes, std::vector<int>{});
}

}  // namespace
}  // namespace aleph
