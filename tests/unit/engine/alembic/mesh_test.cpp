// Surfaces of archives: vertices, triangles, orientation, parts, cages; own archives against their truth, and small
// ones written here against the answer on paper.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/alembic/alembic.h"
#include "engine/alembic/polygons.h"
#include "engine/base/errors.h"
#include "engine/load/load_scene.h"
#include "engine/pose/pose.h"
#include "engine/scene/points.h"
#include "engine/surface/limit_surface.h"
#include "tests/support/alembic_draft.h"
#include "tests/support/alembic_truth.h"
#include "tests/support/scratch_folder.h"

namespace aleph {
namespace {

Scene load(const std::string& name) {
    return load_scene(archive_path(name));
}

Scene load(const std::vector<DraftObject>& objects, std::vector<double> times = {0.0}) {
    const ScratchFolder folder;
    OgawaDraft draft;
    draft.times = std::move(times);
    return load_scene(write_draft(folder / "draft.abc", draft.finish(objects)));
}

const Node& node_named(const Scene& scene, const std::string& name) {
    const auto found = std::ranges::find(scene.nodes, name, &Node::name);
    if (found == scene.nodes.end()) throw std::out_of_range("no node " + name);
    return *found;
}

const Mesh& mesh_of(const Scene& scene, const std::string& node, std::size_t i = 0) {
    return scene.meshes[node_named(scene, node).meshes.at(i)];
}

bool has_warning(const Scene& scene, const std::string& word) {
    return std::ranges::any_of(scene.warnings,
                               [&](const std::string& text) { return text.find(word) != std::string::npos; });
}

const json& object_of(const json& truth, const std::string& path) {
    for (const json& object : truth["objects"])
        if (object["path"] == path) return object;
    throw std::out_of_range("no object " + path);
}

const json& property_of(const json& object, const std::string& name) {
    for (const json& property : object["properties"][0]["properties"])
        if (property["name"] == name) return property;
    throw std::out_of_range("no property " + name);
}

glm::vec3 vec3_at(const json& values, std::size_t i) {
    return {values[3 * i].get<float>(), values[3 * i + 1].get<float>(), values[3 * i + 2].get<float>()};
}

glm::dvec3 triangle_normal(const std::vector<glm::vec3>& positions, const glm::uvec3& t) {
    const glm::dvec3 a = positions[t.x], b = positions[t.y], c = positions[t.z];
    return glm::cross(b - a, c - a);
}

/// Each vertex has the point, normal and texture coordinate of one of the file's corners, and each corner its vertex.
TEST(AlembicMeshes, CornersBecomeVertices) {
    const json truth = truth_of("polymesh_anim");
    const json& object = object_of(truth, "/meshXform/wave");
    const Scene scene = load("polymesh_anim");
    const Mesh& mesh = mesh_of(scene, "wave");
    const json& indices = property_of(object, ".faceIndices")["samples"][0][2];
    const json& normals = object["polymesh"]["normals"]["expanded_samples"];
    const json& uv = object["polymesh"]["uv"]["expanded_samples"][0][1];
    for (const std::size_t sample : {0u, 3u, 7u}) {
        const ScenePose frame = pose(scene, static_cast<double>(sample) / 24.0);
        const PosedMesh& posed = frame.meshes[node_named(scene, "wave").meshes[0]];
        ASSERT_EQ(posed.normals.size(), mesh.positions.size());
        std::vector<bool> used(mesh.positions.size(), false);
        for (std::size_t corner = 0; corner < indices.size(); ++corner) {
            const glm::vec3 normal = glm::normalize(vec3_at(normals[sample][1], corner));
            const float u = uv[2 * corner].get<float>(), v = 1.0f - uv[2 * corner + 1].get<float>();
            bool found = false;
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                if (mesh.vertex_points[i] != indices[corner].get<std::uint32_t>()) continue;
                if (mesh.uv[0][i] != glm::vec2(u, v) || glm::distance(posed.normals[i], normal) > 1e-6f) continue;
                found = used[i] = true;
            }
            EXPECT_TRUE(found) << "corner " << corner << " of sample " << sample;
        }
        EXPECT_TRUE(std::ranges::all_of(used, [](bool u) { return u; }));
    }
    EXPECT_EQ(mesh.triangles.size(), 32u);
    const PointCache& cache = scene.point_caches[mesh.points];
    ASSERT_EQ(cache.velocities.size(), cache.positions.size());
    const json& velocities = property_of(object, ".velocities")["samples"];
    for (std::size_t i = 0; i < cache.velocities.size(); ++i)
        EXPECT_EQ(cache.velocities[i][7], vec3_at(velocities[i][2], 7));
}

TEST(AlembicMeshes, FacesTurnCounterClockwiseOrAsNormalsSay) {
    // A quad in the plane z = 0; 0 1 2 3 runs counter-clockwise seen from +z.
    const std::vector<float> square{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const Scene turned = load({draft_mesh("m", {square}, {{4}}, {{0, 1, 2, 3}})});
    const Mesh& mesh = mesh_of(turned, "m");
    ASSERT_EQ(mesh.triangles.size(), 2u);
    for (const glm::uvec3& t : mesh.triangles) EXPECT_LT(triangle_normal(mesh.positions, t).z, 0.0);

    const auto up = draft_array<float>("N", DraftProperty::f32, 3, {{0, 0, 2}}, "geoScope=uni");
    const Scene kept = load({draft_mesh("m", {square}, {{4}}, {{0, 1, 2, 3}}, {up})});
    for (const glm::uvec3& t : mesh_of(kept, "m").triangles)
        EXPECT_GT(triangle_normal(mesh_of(kept, "m").positions, t).z, 0.0);
    for (const glm::vec3& n : mesh_of(kept, "m").normals) EXPECT_EQ(n, glm::vec3(0, 0, 1));
    // The wave's normals are up, as its faces are seen counter-clockwise.
    const Scene wave = load("polymesh_anim");
    for (const glm::uvec3& t : mesh_of(wave, "wave").triangles)
        EXPECT_GT(triangle_normal(mesh_of(wave, "wave").positions, t).y, 0.0);
}

/// Normals and texture coordinates of every scope, plain and indexed, on two triangles.
TEST(AlembicMeshes, EveryScopeOfAParameter) {
    const std::vector<float> square{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const auto vertices = [&](const std::string& scope, const std::vector<float>& values,
                              const std::vector<int>& indices) {
        DraftProperty uv = draft_array<float>("uv", DraftProperty::f32, 2, {values}, "geoScope=" + scope);
        if (!indices.empty()) {
            uv.name = ".vals";
            uv = draft_compound("uv", {uv, draft_array<int>(".indices", DraftProperty::u32, 1, {indices})});
            uv.metadata = "geoScope=" + scope;
        }
        const Scene scene = load({draft_mesh("m", {square}, {{3, 3}}, {{0, 1, 2, 0, 2, 3}}, {uv})});
        EXPECT_FALSE(has_warning(scene, "left out"));
        std::vector<std::vector<float>> list;  // point, u, v
        const Mesh& mesh = mesh_of(scene, "m");
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            list.push_back({static_cast<float>(mesh.vertex_points[i]), mesh.uv[0][i].x, 1.0f - mesh.uv[0][i].y});
        std::ranges::sort(list);
        return list;
    };
    using List = std::vector<std::vector<float>>;
    EXPECT_EQ(vertices("con", {.5f, .25f}, {}), (List{{0, .5f, .25f}, {1, .5f, .25f}, {2, .5f, .25f}, {3, .5f, .25f}}));
    EXPECT_EQ(vertices("", {.5f, .25f}, {}), vertices("con", {.5f, .25f}, {}));
    EXPECT_EQ(vertices("uni", {0, 0, 1, 1}, {}),
              (List{{0, 0, 0}, {0, 1, 1}, {1, 0, 0}, {2, 0, 0}, {2, 1, 1}, {3, 1, 1}}));
    EXPECT_EQ(vertices("vtx", {0, 0, 1, 0, 1, 1, 0, 1}, {}), (List{{0, 0, 0}, {1, 1, 0}, {2, 1, 1}, {3, 0, 1}}));
    EXPECT_EQ(vertices("var", {0, 0, 1, 0}, {0, 1, 1, 0}), (List{{0, 0, 0}, {1, 1, 0}, {2, 1, 0}, {3, 0, 0}}));
    EXPECT_EQ(vertices("fvr", {0, 0, 1, 0, 1, 1, 0, 0, .5f, .5f, 0, 1}, {}),
              (List{{0, 0, 0}, {1, 1, 0}, {2, .5f, .5f}, {2, 1, 1}, {3, 0, 1}}));
    EXPECT_EQ(vertices("fvr", {0, 0, 1, 1}, {0, 1, 1, 0, 1, 0}), (List{{0, 0, 0}, {1, 1, 1}, {2, 1, 1}, {3, 0, 0}}));
}

TEST(AlembicMeshes, ParametersOfTheWrongLengthAreLeftOut) {
    const std::vector<float> triangle{0, 0, 0, 1, 0, 0, 0, 1, 0};
    const auto uv = draft_array<float>("uv", DraftProperty::f32, 2, {{0, 0, 1, 1}}, "geoScope=fvr");
    const Scene scene = load({draft_mesh("m", {triangle}, {{3}}, {{0, 1, 2}}, {uv})});
    EXPECT_TRUE(mesh_of(scene, "m").uv[0].empty());
    EXPECT_TRUE(has_warning(scene, "2 values where the surface has 3"));
}

/// RP-15: a change of topology is a cut for that object: another mesh, shown from there on.
TEST(AlembicMeshes, RP15_TopologyThatChangesIsAMeshForEach) {
    const Scene scene = load("polymesh_anim");
    const Node& growing = node_named(scene, "growing");
    ASSERT_EQ(growing.meshes.size(), 4u);
    EXPECT_TRUE(has_warning(scene, "there is no motion across a change"));
    for (int step = -2; step < 18; ++step) {
        const double seconds = (step + 0.5) / 4.0 / 24.0;
        const ScenePose frame = pose(scene, seconds);
        const int expected = std::clamp(static_cast<int>(std::floor(seconds * 24.0)), 0, 3);
        for (std::size_t i = 0; i < frame.instances.size(); ++i) {
            const auto found = std::ranges::find(growing.meshes, frame.instances[i].mesh);
            if (found == growing.meshes.end()) continue;
            EXPECT_EQ(frame.shown[i] != 0, found - growing.meshes.begin() == expected) << seconds;
        }
    }
}

/// Points that move between two changes of topology interpolate there, and only there.
TEST(AlembicMeshes, RP15_PointsMoveBetweenChanges) {
    const std::vector<float> a{0, 0, 0, 1, 0, 0, 0, 1, 0}, b{0, 0, 2, 1, 0, 2, 0, 1, 2},
        c{0, 0, 9, 1, 0, 9, 1, 1, 9, 0, 1, 9};
    const Scene scene =
        load({draft_mesh("m", {a, b, c, c}, {{3}, {3}, {4}, {4}}, {{0, 1, 2}, {0, 1, 2}, {0, 1, 2, 3}, {0, 1, 2, 3}})},
             {0.0, 1.0, 2.0, 3.0});
    ASSERT_EQ(node_named(scene, "m").meshes.size(), 2u);
    const PointCache& first = scene.point_caches[mesh_of(scene, "m", 0).points];
    EXPECT_EQ(sample_points(first, 0.5)[0], glm::dvec3(0, 0, 1));
    EXPECT_EQ(sample_points(first, 1.9)[0], glm::dvec3(0, 0, 2));  // holds: not half way to another surface
    EXPECT_EQ(evaluate(mesh_of(scene, "m", 0).present, 1.9), 1.0);
    EXPECT_EQ(evaluate(mesh_of(scene, "m", 0).present, 2.0), 0.0);
    EXPECT_EQ(evaluate(mesh_of(scene, "m", 1).present, 2.0), 1.0);
}

TEST(AlembicMeshes, AConcavePolygonIsCutInsideItsOutline) {
    // An L of area 3, clockwise as archives have them, in the plane y = 0 seen from above.
    const std::vector<glm::vec3> outline{{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}, {1, 0, 2}, {0, 0, 2}};
    std::vector<float> points;
    for (const glm::vec3& p : outline) points.insert(points.end(), {p.x, p.y, p.z});
    const Scene scene = load({draft_mesh("m", {points}, {{6}}, {{0, 1, 2, 3, 4, 5}})});
    const Mesh& mesh = mesh_of(scene, "m");
    ASSERT_EQ(mesh.triangles.size(), 4u);
    double area = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 normal = triangle_normal(mesh.positions, t);
        EXPECT_GT(normal.y, 0.0);  // all the same way: none covers what another does
        area += 0.5 * normal.y;
    }
    EXPECT_NEAR(area, 3.0, 1e-12);
}

TEST(AlembicMeshes, EveryRotationOfAConcavePolygonIsCutTheSame) {
    const std::vector<glm::vec3> arrow{{0, 0, 0}, {2, 0, 1}, {4, 0, 0}, {2, 0, 4}};
    for (std::size_t first = 0; first < 4; ++first) {
        std::vector<glm::vec3> points = arrow;
        std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(first), points.end());
        std::vector<std::array<std::uint32_t, 3>> triangles;
        std::uint64_t effort = 1000;
        EXPECT_TRUE(triangulate_polygon(points, effort, triangles));
        double area = 0.0;
        for (const auto& [a, b, c] : triangles)
            area += 0.5 * glm::length(glm::cross(points[b] - points[a], points[c] - points[a]));
        EXPECT_NEAR(area, 6.0, 1e-6);
        std::uint64_t none = 0;
        triangles.clear();
        EXPECT_FALSE(triangulate_polygon(points, none, triangles));
        EXPECT_EQ(triangles.size(), 2u);  // a fan then
    }
}

TEST(AlembicMaterials, AssignmentsToTheMeshAndToFaceSets) {
    const Scene scene = load("materials_facesets");
    ASSERT_EQ(node_named(scene, "box").meshes.size(), 3u);
    const auto part = [&](const std::string& material) -> const Mesh& {
        for (const int mesh : node_named(scene, "box").meshes) {
            const Mesh& m = scene.meshes[mesh];
            if (scene.materials[m.material].name == material) return m;
        }
        throw std::out_of_range(material);
    };
    EXPECT_EQ(part("red").triangles.size(), 2u);  // face 4: the sides and face 5 are assigned away
    ASSERT_EQ(scene.materials.size(), 3u);
    for (const Material& material : scene.materials) EXPECT_EQ(material.metallic, Track<double>(0.0));
    const auto close = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) < 1e-6; };
    const Material& red = scene.materials[part("red").material];
    EXPECT_TRUE(close(red.base_color.values[0], {0.8, 0.1, 0.05}));
    EXPECT_NEAR(red.roughness.values[0], 0.25, 1e-7);
    // Two are called blue: the sides' own, and one that the archive does not have.
    std::size_t triangles = 0;
    for (const int mesh : node_named(scene, "box").meshes) triangles += scene.meshes[mesh].triangles.size();
    EXPECT_EQ(triangles, 12u);
    EXPECT_TRUE(has_warning(scene, "no material \"/materials/red/blue\""));
    EXPECT_TRUE(has_warning(scene, "face set changes over time"));
}

TEST(AlembicSubdivision, CreasesCornersHolesAndRules) {
    const Scene scene = load("subd_creases");
    const json truth = truth_of("subd_creases");
    const json& object = object_of(truth, "/cage");
    const json& sample = object["subd"]["samples"][0];
    const Cage& cage = scene.cages[mesh_of(scene, "cage").cage];
    EXPECT_EQ(cage.scheme, Cage::Scheme::catmull_clark);
    EXPECT_EQ(cage.boundary, Cage::Boundary::edge_only);          // 2
    EXPECT_EQ(cage.uv_rule, Cage::UvRule::linear_corners_plus1);  // 1, corners not propagated
    EXPECT_EQ(cage.crease_points, sample["creaseIndices"].get<std::vector<int>>());
    EXPECT_EQ(cage.crease_lengths, sample["creaseLengths"].get<std::vector<int>>());
    EXPECT_EQ(cage.crease_sharpness, sample["creaseSharpnesses"].get<std::vector<float>>());
    EXPECT_EQ(cage.corner_points, sample["cornerIndices"].get<std::vector<int>>());
    EXPECT_EQ(cage.corner_sharpness, sample["cornerSharpnesses"].get<std::vector<float>>());
    EXPECT_EQ(cage.holes, sample["holes"].get<std::vector<int>>());

    // Faces backwards, each with its texture coordinates.
    const auto indices = property_of(object, ".faceIndices")["samples"][0][2].get<std::vector<int>>();
    const auto uv = object["subd"]["uv"]["expanded_samples"][0][1].get<std::vector<float>>();
    ASSERT_EQ(cage.face_sizes, std::vector<int>(6, 4));
    for (std::size_t f = 0; f < 6; ++f) {
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t ours = 4 * f + i, theirs = 4 * f + (4 - i) % 4;
            EXPECT_EQ(cage.face_points[ours], indices[theirs]);
            const glm::vec2 found = cage.uv[cage.face_uv[ours]];
            EXPECT_EQ(found, glm::vec2(uv[2 * theirs], 1.0f - uv[2 * theirs + 1]));
        }
    }
    const Cage& plain = scene.cages[mesh_of(scene, "tetra").cage];
    EXPECT_EQ(plain.boundary, Cage::Boundary::none);
    EXPECT_EQ(plain.uv_rule, Cage::UvRule::linear_all);
    EXPECT_TRUE(plain.holes.empty());
    for (const char* name : {"cage", "tetra"}) EXPECT_GT(mesh_of(scene, name).triangles.size(), 50u);
}

TEST(AlembicVelocities, OfTheWrongLengthAreLeftOut) {
    const std::vector<float> triangle{0, 0, 0, 1, 0, 0, 0, 1, 0};
    const auto velocities = draft_array<float>(".velocities", DraftProperty::f32, 3, {{1, 2, 3}});
    const Scene scene = load({draft_mesh("m", {triangle}, {{3}}, {{0, 1, 2}}, {velocities})});
    EXPECT_TRUE(scene.point_caches[0].velocities.empty());
    EXPECT_TRUE(has_warning(scene, "velocities do not fit"));
}

DraftObject draft_xform(const std::vector<DraftProperty>& properties) {
    return {"x", "schema=AbcGeom_Xform_v3", {draft_compound(".xform", properties)}, {}};
}

TEST(AlembicTransforms, MoreThan256ChannelsComeAsAnArray) {
    std::vector<double> channels;
    for (int i = 0; i < 90; ++i) channels.insert(channels.end(), {1.0, 0.0, i == 0 ? 0.5 : 0.0});
    DraftProperty operations{".ops", DraftProperty::scalar, DraftProperty::u8, 90, {DraftBytes(90, 0x13)}, 0, "", {},
                             -1};
    const Scene scene =
        load({draft_xform({operations, draft_array<double>(".vals", DraftProperty::f64, 1, {channels})})});
    const auto x = static_cast<std::size_t>(&node_named(scene, "x") - scene.nodes.data());
    EXPECT_EQ(pose(scene, 0.0).world[x][3], glm::dvec4(90.0, 0.0, 0.5, 1.0));
}

TEST(AlembicTransforms, MissingPartsAreTheIdentity) {
    DraftProperty operations{".ops", DraftProperty::scalar, DraftProperty::u8, 3, {{0x00, 0x10, 0x40}}, 0, "", {}, -1};
    for (const std::vector<DraftProperty>& properties : {std::vector<DraftProperty>{}, {operations}}) {
        const Scene scene = load({draft_xform(properties)});
        const auto x = static_cast<std::size_t>(&node_named(scene, "x") - scene.nodes.data());
        EXPECT_EQ(pose(scene, 0.0).world[x], glm::dmat4(1.0));
    }
}

/// A shutter as long as the frame: the sample that closes one frame and the one that opens the next share a time.
TEST(AlembicTransforms, CyclesThatTouch) {
    const ScratchFolder folder;
    OgawaDraft draft;
    draft.cyclic = true;
    draft.times = {0.0, 1.0};
    draft.period = 1.0;
    std::vector<std::vector<float>> points;
    for (const float z : {0.0f, 1.0f, 5.0f, 2.0f}) points.push_back({0, 0, z, 1, 0, z, 0, 1, z});
    const Scene scene =
        load_scene(write_draft(folder / "c.abc", draft.finish({draft_mesh("m", points, {{3}}, {{0, 1, 2}})})));
    const PointCache& cache = scene.point_caches.at(0);
    EXPECT_EQ(sample_points(cache, 0.5)[0].z, 0.5);
    EXPECT_EQ(sample_points(cache, 1.0)[0].z, 1.0);
    EXPECT_EQ(sample_points(cache, 1.5)[0].z, 1.5);
    EXPECT_EQ(sample_points(cache, 2.0)[0].z, 2.0);
}

/// A scene file that includes an archive: its own rate and range count, the content hangs below its node.
TEST(AlembicInclude, HangsBelowANodeOfASceneFile) {
    const ScratchFolder folder;
    std::filesystem::copy_file(archive_path("polymesh_anim"), folder / "p.abc");
    std::ofstream(folder / "s.json") << R"({"aleph": 1, "fps": 30, "frames": [0, 8], "nodes": [
        {"name": "stage", "translation": [0, 5, 0], "include": "p.abc"}]})";
    const Scene scene = load_scene(folder / "s.json");
    EXPECT_EQ(scene.frame_rate, (FrameRate{30, 1}));
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 8}));
    ASSERT_EQ(scene.includes.size(), 1u);
    const ScenePose frame = pose(scene, 2.0 / 24.0), own = pose(load("polymesh_anim"), 2.0 / 24.0);
    const Scene alone = load("polymesh_anim");
    for (const char* name : {"wave", "pentagon", "growing"}) {
        const auto at = static_cast<std::size_t>(&node_named(scene, name) - scene.nodes.data());
        const auto there = static_cast<std::size_t>(&node_named(alone, name) - alone.nodes.data());
        EXPECT_EQ(frame.world[at][3], own.world[there][3] + glm::dvec4(0, 5, 0, 0)) << name;
        EXPECT_EQ(scene.nodes[at].include, 0);
    }
    save_scene(scene, folder / "again.json");
    Scene again = load_scene(folder / "again.json");
    again.file = scene.file, again.warnings = scene.warnings;
    EXPECT_EQ(again.nodes, scene.nodes);
    EXPECT_EQ(again.meshes, scene.meshes);
    EXPECT_EQ(again.point_caches, scene.point_caches);
}

/// Archives of others: what there is to see.
TEST(AlembicForeign, WhatThereIsToSee) {
    for (const std::string& name : foreign_archives)
        if (!std::filesystem::exists(archive_path(name))) GTEST_SKIP() << "not here: " << archive_path(name);
    const Scene cube = load("indexedTextureCoordinates");
    EXPECT_EQ(mesh_of(cube, "CubeShape").triangles.size(), 12u);
    EXPECT_EQ(mesh_of(cube, "CubeShape").vertex_points.size(), mesh_of(cube, "CubeShape").uv[0].size());
    const Scene nested = load("nestedInstancing");
    EXPECT_EQ(list_instances(nested).size(), 12u);  // 3 meshes, 4 times each
    EXPECT_EQ(nested.meshes.size(), 3u);
    for (const Mesh& mesh : nested.meshes) {
        EXPECT_EQ(mesh.triangles.size(), 12u);
        for (const glm::uvec3& t : mesh.triangles)
            EXPECT_GT(glm::dot(triangle_normal(mesh.positions, t), glm::dvec3(mesh.normals[t.x])), 0.0);
    }
    const Scene camera = load("testAbcCamera");
    EXPECT_EQ(camera.cameras.size(), 1u);
    EXPECT_TRUE(is_animated(camera.nodes[pose(camera, 0.0).cameras[0].node].visible) ||
                pose(camera, 0.1).cameras[0].position != pose(camera, 0.7).cameras[0].position);
    EXPECT_TRUE(has_warning(load("testUsdAbcXformPrimCollapsing"), "AbcGeom_Curve_v2 are not read"));
}

}  // namespace
}  // namespace aleph
