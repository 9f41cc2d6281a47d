// Drafts of what archives of other programs contain: instances within instances, cameras with a film back under evenly
// spaced acyclic times, stacks of translations and curves; and those archives where they are there.
#include "engine/pose/pose.h"
#include "tests/engine/alembic/fixture.h"

namespace aleph {
namespace {

/// Translations that follow one another; every sample has the numbers of all.
DraftObject draft_moved(const std::string& name, const std::vector<std::vector<double>>& samples,
                        std::vector<DraftObject> children) {
    const std::vector<std::uint8_t> operations(samples.front().size() / 3, 0x10);
    return {name,
            "schema=AbcGeom_Xform_v3",
            {draft_compound(".xform", {draft_scalar<std::uint8_t>(".ops", DraftProperty::u8, {operations}),
                                       draft_scalar<double>(".vals", DraftProperty::f64, samples)})},
            std::move(children)};
}

glm::dvec3 place_of(const Scene& scene, const std::string& path) {
    return glm::dvec3(pose(scene, 0.0).world.at(static_cast<std::size_t>(find_node(scene, path)))[3]);
}

/// An instance of what holds an instance: two meshes, each four times.
TEST(AlembicDrafts, InstancesWithinInstances) {
    const DraftObject a = draft_moved(
        "a", {{1, 0, 0}}, {draft_triangle("aMesh"), draft_moved("b", {{0, 2, 0}}, {draft_triangle("bMesh")})});
    const DraftObject within = draft_moved("f", {{0, 0, 5}}, {draft_instance("g", "/root/first/a")});
    const Scene scene =
        load({draft_group("root", {draft_group("first", {a, within}),
                                   draft_moved("c", {{100, 0, 0}}, {draft_instance("second", "/root/first")})})});
    EXPECT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(list_instances(scene).size(), 8u);
    EXPECT_EQ(place_of(scene, "/root/first/a/b/bMesh"), glm::dvec3(1, 2, 0));
    EXPECT_EQ(place_of(scene, "/root/first/f/g/b/bMesh"), glm::dvec3(1, 2, 5));
    EXPECT_EQ(place_of(scene, "/root/c/second/a/aMesh"), glm::dvec3(101, 0, 0));
    EXPECT_EQ(place_of(scene, "/root/c/second/f/g/b/bMesh"), glm::dvec3(101, 2, 5));
}

/// 21 acyclic times, evenly spaced; the transform above has one sample fewer. The film back scales the film's half
/// width by 2 and its half height, 2 / 3, by 3, and moves it: left -1.5, right 2.5, bottom -2.25, top 1.75.
TEST(AlembicDrafts, CameraWithAFilmBackUnderEvenAcyclicTimes) {
    std::vector<double> times;
    std::vector<std::vector<double>> moves, cores;
    for (int i = 0; i <= 20; ++i) {
        times.push_back(i / 24.0);
        if (i < 20) moves.push_back({static_cast<double>(i), 0, 0});
        cores.push_back({50.0 + i, 3.6, 0, 2.4, 0, 1, 0, 0, 0, 0, 5.6, 5, 0, 1.0 / 48.0, 0.125, 1000});
    }
    DraftProperty operations = draft_text(".filmBackOps", "");
    operations.extent = 2;
    operations.samples = {text_bytes("t window")};
    for (const std::uint8_t byte : text_bytes("s")) operations.samples[0].push_back(byte);
    const DraftObject camera{
        "camera",
        "schema=AbcGeom_Camera_v1",
        {draft_compound(".geom",
                        {draft_scalar<double>(".core", DraftProperty::f64, cores), operations,
                         draft_scalar<double>(".filmBackChannels", DraftProperty::f64, {{0.5, -0.25, 2, 3}})})},
        {}};
    const Scene scene = load({draft_moved("rig", moves, {camera})}, times);
    EXPECT_EQ(scene.film.frame_rate, (FrameRate{24, 1}));
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 20}));
    ASSERT_EQ(scene.cameras.size(), 1u);
    for (const int i : {0, 7, 19, 20}) {
        const CameraValues values = pose(scene, times[static_cast<std::size_t>(i)]).cameras.at(0);
        EXPECT_NEAR(values.fov, 2.0 * std::atan(2.0 * 36.0 / (2.0 * (50.0 + i))), 1e-12) << i;
        EXPECT_NEAR(values.shift_x, 0.125, 1e-12);
        EXPECT_NEAR(values.shift_y, -0.0625, 1e-12);
        EXPECT_EQ(values.near_plane, 0.125);
        EXPECT_EQ(values.focus_distance, 5.0);
        EXPECT_NEAR(values.position.x, std::min(i, 19), 1e-12);
    }
}

/// Pivots come as translations that follow one another; the curves below are nodes that show nothing.
TEST(AlembicDrafts, TranslationsAddUpAndCurvesAreLeftOut) {
    const DraftObject curve{"curve", "schema=AbcGeom_Curve_v2", {draft_compound(".geom", {})}, {}};
    const Scene scene = load(
        {draft_group("asset", {draft_moved("pivot", {{1, 2, 3, 10, 0, 0, -1, -2, -3, 0, 5, 0}}, {curve}), curve})});
    EXPECT_TRUE(has_warning(scene, "AbcGeom_Curve_v2 are not read"));
    EXPECT_EQ(place_of(scene, "/asset/pivot/curve"), glm::dvec3(10, 5, 0));
    EXPECT_EQ(place_of(scene, "/asset/curve"), glm::dvec3(0));
    EXPECT_TRUE(list_instances(scene).empty());
}

/// Archives of others: what there is to see. Without them, this is the one test that says so.
TEST(AlembicForeign, WhatThereIsToSee) {
    for (const std::string& name : foreign_archives)
        if (!std::filesystem::exists(archive_path(name))) GTEST_SKIP() << missing_asset(archive_path(name));
    const Scene cube = load("indexedTextureCoordinates");
    EXPECT_EQ(mesh_of(cube, "CubeShape").triangles.size(), 12u);
    EXPECT_EQ(mesh_of(cube, "CubeShape").deformation.vertex_points.size(), mesh_of(cube, "CubeShape").uv[0].size());
    const Scene nested = load("nestedInstancing");
    EXPECT_EQ(list_instances(nested).size(), 12u);  // 3 meshes, 4 times each
    EXPECT_EQ(nested.meshes.size(), 3u);
    for (const Mesh& mesh : nested.meshes) {
        EXPECT_EQ(mesh.triangles.size(), 12u);
        for (const glm::uvec3& t : mesh.triangles)
            EXPECT_GT(glm::dot(triangle_normal(mesh.positions, t), glm::dvec3(mesh.normals[t.x])), 0.0);
    }
    const Scene camera = load("testAbcCamera");
    EXPECT_EQ(camera.film.frame_rate, (FrameRate{24, 1}));  // acyclic, evenly spaced
    EXPECT_EQ(frame_range(camera), (FrameRange{0, 20}));
    EXPECT_EQ(camera.cameras.size(), 1u);
    EXPECT_TRUE(is_animated(camera.nodes[pose(camera, 0.0).cameras[0].node].visible) ||
                pose(camera, 0.1).cameras[0].position != pose(camera, 0.7).cameras[0].position);
    EXPECT_TRUE(has_warning(load("testUsdAbcXformPrimCollapsing"), "AbcGeom_Curve_v2 are not read"));
}

}  // namespace
}  // namespace aleph
