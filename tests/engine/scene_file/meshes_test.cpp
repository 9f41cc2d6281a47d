// Meshes, points over time and subdivision cages in scene files: the meaning of the keys, and what is refused.

#include "engine/pose/pose.h"
#include "tests/engine/scene_file/scene_texts.h"

namespace aleph {
namespace {

const std::string cube_cage = R"("positions": [[-1,-1,1], [1,-1,1], [-1,1,1], [1,1,1], [-1,1,-1], [1,1,-1], [-1,-1,-1],
    [1,-1,-1]], "faces": [[0,1,3,2], [2,3,5,4], [4,5,7,6], [6,7,1,0], [1,7,5,3], [6,0,2,4]])";

TEST(SceneJsonMeshes, ListsMayBeFlatOrInGroups) {
    const Scene flat = read(R"(, "nodes": [{"name": "a", "shape": {"type": "mesh", "positions": [0,0,0, 1,0,0, 0,1,0],
        "triangles": [0,1,2], "normals": [0,0,1, 0,0,1, 0,0,1], "uv": [0,1, 1,1, 0,0], "uv1": [0,0, 0,0, 0,0.5],
        "colors": [1,0,0,1, 0,1,0,1, 0,0,1,0.5]}}])");
    const Scene grouped =
        read(R"(, "nodes": [{"name": "a", "shape": {"type": "mesh", "positions": [[0,0,0], [1,0,0], [0,1,0]],
        "triangles": [[0,1,2]], "normals": [[0,0,1], [0,0,1], [0,0,1]], "uv": [[0,1], [1,1], [0,0]],
        "uv1": [[0,0], [0,0], [0,0.5]], "colors": [[1,0,0,1], [0,1,0,1], [0,0,1,0.5]]}}])");
    EXPECT_EQ(flat, grouped);
    ASSERT_EQ(flat.meshes.size(), 1u);
    const Mesh& mesh = flat.meshes[0];
    EXPECT_EQ(mesh.name, "a");
    EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}}));
    EXPECT_EQ(mesh.normals.size(), 3u);
    EXPECT_EQ(mesh.uv[0][1], glm::vec2(1, 1));
    EXPECT_EQ(mesh.uv[1][2], glm::vec2(0, 0.5));
    EXPECT_EQ(mesh.colors[2], glm::vec4(0, 0, 1, 0.5));
    EXPECT_FALSE(mesh.shape);
    EXPECT_EQ(again(flat), flat);
}

TEST(SceneJsonMeshes, KeyedPositionsMove) {
    const Scene scene = read(R"(, "fps": 10, "meshes": {"flag": {"shape": {"type": "mesh",
        "positions": {"keys": [[0, [0,0,0, 1,0,0, 0,1,0]], [20, [0,0,4, 1,0,0, 0,3,0]]]}, "triangles": [0,1,2]}}},
        "nodes": [{"mesh": "flag"}])");
    ASSERT_EQ(scene.point_caches.size(), 1u);
    EXPECT_EQ(scene.point_caches[0].name, "flag");
    EXPECT_EQ(scene.point_caches[0].sampling.times, (std::vector<double>{0.0, 2.0}));
    EXPECT_EQ(scene.meshes[0].deformation.points, 0);
    EXPECT_EQ(scene.meshes[0].positions, scene.point_caches[0].positions[0]);
    const ScenePose frame = pose(scene, 0.5);
    ASSERT_EQ(frame.meshes[0].positions.size(), 3u);
    EXPECT_EQ(frame.meshes[0].positions[0], glm::dvec3(0, 0, 1));
    EXPECT_EQ(frame.meshes[0].positions[2], glm::dvec3(0, 1.5, 0));
    EXPECT_EQ(again(scene), scene);
    const std::string saved = write_scene_text(scene, "test.json");
    EXPECT_NE(saved.find("\"points\": {\"flag\": {\"keys\""), std::string::npos) << saved;
}

TEST(SceneJsonMeshes, PointsAreSharedByMeshes) {
    const Scene scene =
        read(R"(, "points": {"cloth": {"values": [[0,0,0, 1,0,0, 0,1,0, 1,1,0], [0,0,1, 1,0,1, 0,1,1, 1,1,1]],
        "period": 0.5, "unit": "seconds"}},
        "meshes": {"a": {"shape": {"type": "mesh", "points": "cloth", "vertex_points": [0,1,2,1], "triangles": [0,1,2],
          "normals": {"values": [[0,0,1, 0,0,1, 0,0,1, 0,0,1], [1,0,0, 1,0,0, 1,0,0, 1,0,0]], "period": 15}}},
        "b": {"shape": {"type": "mesh", "points": "cloth", "positions": [9,9,9, 1,0,0, 0,1,0, 1,1,0], "triangles": [1,3,2]},
          "present": {"keys": [[0, true], [7, false]]}}})");
    EXPECT_EQ(scene.meshes[0].deformation.vertex_points, (std::vector<std::uint32_t>{0, 1, 2, 1}));
    EXPECT_EQ(scene.meshes[0].positions[3], glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.meshes[0].deformation.normal_samples.size(), 2u);
    EXPECT_EQ(scene.meshes[0].deformation.normal_sampling.period, 0.5);
    EXPECT_EQ(scene.meshes[1].positions[0], glm::vec3(9, 9, 9)) << "a rest shape may differ from the first key";
    EXPECT_EQ(scene.meshes[1].present.values, (std::vector<double>{1.0, 0.0}));
    EXPECT_EQ(again(scene), scene);
}

TEST(SceneJsonMeshes, CageBecomesItsLimitSurface) {
    const Scene scene = read(R"(, "nodes": [{"name": "blob", "shape": {"type": "cage", "cage": {)" + cube_cage + R"(,
        "level": 3, "max_level": 5}}, "material": {}}])");
    ASSERT_EQ(scene.cages.size(), 1u);
    EXPECT_EQ(scene.cages[0].name, "blob");
    EXPECT_EQ(scene.cages[0].faces.sizes, (std::vector<int>(6, 4)));
    EXPECT_EQ(scene.cages[0].level, 3);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.subdivision.cage, 0);
    EXPECT_EQ(mesh.material, 0);
    EXPECT_EQ(mesh.triangles.size(), 6u * 64u * 2u);
    EXPECT_TRUE(mesh.subdivision.limit.surface);
    // The limit of a cube's corner of valence 3: weights n^2, 4 and 1 over n (n + 5).
    const double corner = (9.0 * 1.0 + 4.0 * 3.0 * (1.0 / 3.0) + 1.0 * 3.0 * (-1.0 / 3.0)) / 24.0;
    float largest = 0.0f;
    for (const glm::vec3& p : mesh.positions) largest = std::max(largest, std::min({p.x, p.y, p.z}));
    EXPECT_NEAR(largest, corner, 1e-6);
    EXPECT_EQ(again(scene), scene);
}

TEST(SceneJsonMeshes, EverythingThatACageCanSay) {
    const Scene scene = read(R"(, "cages": {"couch": {"points": "p", "scheme": "bilinear", "boundary": "edge_only",
        "uv_rule": "linear_all", "level": 1, "max_level": 4, "faces": [[0,1,3,2], [2,3,5,4], [4,5,7,6], [6,7,1,0], [1,7,5,3], [6,0,2,4]],
        "creases": [{"points": [0,1,3], "sharpness": 2.5}, {"points": [4,5], "sharpness": 10}],
        "corners": [{"point": 7, "sharpness": 0.1}], "holes": [5], "parts": [0,0,1,1,0,0], "uv": [0,0, 1,0, 1,1, 0,1],
        "face_uv": [[0,1,2,3], [0,1,2,3], [0,1,2,3], [0,1,2,3], [0,1,2,3], [3,2,1,0]]}},
        "points": {"p": {"keys": [[0, [-1,-1,1, 1,-1,1, -1,1,1, 1,1,1, -1,1,-1, 1,1,-1, -1,-1,-1, 1,-1,-1]],
          [30, [-1,-1,1, 1,-1,1, -1,1,1, 1,1,1, -1,1,-1, 1,1,-1, -1,-1,-1, 1,-1,-3]]]}},
        "nodes": [{"name": "a", "shape": {"type": "cage", "cage": "couch"}},
                  {"name": "b", "shape": {"type": "cage", "cage": "couch", "part": 1}, "material": {"roughness": 0.5}}])");
    const Cage& cage = scene.cages[0];
    EXPECT_EQ(cage.scheme, Cage::Scheme::bilinear);
    EXPECT_EQ(cage.boundary, Cage::Boundary::edge_only);
    EXPECT_EQ(cage.uv_rule, Cage::UvRule::linear_all);
    EXPECT_EQ(cage.creases.lengths, (std::vector<int>{3, 2}));
    EXPECT_EQ(cage.creases.points, (std::vector<int>{0, 1, 3, 4, 5}));
    EXPECT_EQ(cage.creases.sharpness, (std::vector<float>{2.5f, 10.0f}));
    EXPECT_EQ(cage.corners.points, (std::vector<int>{7}));
    EXPECT_EQ(cage.corners.sharpness, (std::vector<float>{0.1f}));
    EXPECT_EQ(cage.faces.holes, (std::vector<int>{5}));
    EXPECT_EQ(cage.faces.parts, (std::vector<int>{0, 0, 1, 1, 0, 0}));
    EXPECT_EQ(cage.faces.uv.size(), 24u);
    EXPECT_EQ(scene.meshes[1].subdivision.part, 1);
    EXPECT_EQ(scene.meshes[0].triangles.size(), 3u * 8u) << "a hole is not drawn";
    EXPECT_EQ(scene.meshes[1].triangles.size(), 2u * 8u);
    EXPECT_EQ(again(scene), scene);
    EXPECT_FALSE(pose(scene, 0.5).meshes[1].positions.empty());
}

TEST(SceneJsonMeshes, CageWarningsStayWithTheScene) {
    const Scene scene = read(R"(, "nodes": [{"shape": {"type": "cage", "cage": {)" + cube_cage + R"(,
        "creases": [{"points": [0, 5], "sharpness": 3}]}}}])");
    ASSERT_EQ(scene.source.warnings.size(), 1u);
    EXPECT_NE(scene.source.warnings[0].find("crease"), std::string::npos);
    EXPECT_EQ(again(scene), scene);
}

TEST(SceneJsonMeshes, WhatDoesNotFitTogetherIsRefusedAtItsPlace) {
    const std::string tri = "\"positions\": [0,0,0, 1,0,0, 0,1,0], \"triangles\": [0,1,2]";
    const std::string faces = "\"positions\": [0,0,0, 1,0,0, 1,1,0, 0,1,0], \"faces\": [[0,1,2,3]]";
    const auto mesh = [](const std::string& body, const char* place, const char* word) {
        return shape("\"type\": \"mesh\", " + body, place, word);
    };
    const auto cage = [](const std::string& body, const char* place, const char* word) {
        return shape("\"type\": \"cage\", \"cage\": {" + body + "}", place, word);
    };
    expect_all_refused({
        mesh("\"triangles\": [0,1,2]", "", "needs \"positions\""),
        mesh("\"positions\": [0,0,0]", "", "\"triangles\" is missing"),
        mesh("\"positions\": [0,0], \"triangles\": []", "/positions", "groups of 3"),
        mesh("\"positions\": [[0,0,0], [1,1]], \"triangles\": []", "/positions/1", "expected 3 numbers, found 2"),
        mesh("\"positions\": [[0,0,0], 1], \"triangles\": []", "/positions/1", "array"),
        mesh("\"positions\": [0,0,\"x\"], \"triangles\": []", "/positions/2", "number"),
        mesh("\"positions\": [0,0,1e19], \"triangles\": []", "/positions/2", "1e+18"),
        mesh("\"positions\": [0,0,0], \"triangles\": [0,0,1]", "/triangles/2", "no vertex 1"),
        mesh("\"positions\": [0,0,0], \"triangles\": [0,0,-1]", "/triangles/2", "must lie within"),
        mesh("\"positions\": [0,0,0], \"triangles\": [0,0,0.5]", "/triangles/2", "integer"),
        mesh(tri + ", \"normals\": [0,0,1]", "/normals", "1 normals for 3 vertices"),
        mesh(tri + ", \"uv\": [0,0]", "/uv", "texture coordinates"),
        mesh(tri + ", \"colors\": [0,0,0,1]", "/colors", "colors"),
        mesh(tri + ", \"vertex_points\": [0]", "/vertex_points", "goes with"),
        mesh(tri + ", \"normals\": {\"values\": [[0,0,1, 0,0,1, 0,0,1]]}", "/normals", "over time"),
        mesh(tri + ", \"points\": \"cloth\"", "/points", "no list of points called"),
        mesh(tri + ", \"radius\": 1", "/radius", "a mesh has no \"radius\""),
        mesh("\"positions\": {\"keys\": [[0, [0,0,0]], [1, [0,0,0, 1,1,1]]]}, \"triangles\": []", "/positions/keys/1/1",
             "number cannot change"),
        mesh("\"positions\": {\"keys\": [[0, [0,0,0]], [0, [0,0,0]]]}, \"triangles\": []", "/positions/keys/1/0",
             "ascend"),
        mesh("\"positions\": {\"values\": [[]]}, \"triangles\": []", "/positions", "no points"),
        mesh("\"positions\": {\"values\": [[0,0,0]], \"interpolation\": \"cubic\"}, \"triangles\": []",
             "/positions/interpolation", "unknown key"),
        cage(faces + ", \"level\": 11", "/cage/level", "from 0 to 10"),
        cage(faces + ", \"level\": 7", "/cage", "\"max_level\" (6) is below"),
        cage("\"positions\": [0,0,0, 1,0,0, 1,1,0], \"faces\": [[0,1,3]]", "/cage/faces/0/2", "no point 3"),
        cage("\"positions\": [0,0,0, 1,0,0, 1,1,0], \"faces\": [[0,1]]", "/cage/faces/0", "at least 3"),
        cage("\"positions\": [0,0,0, 1,0,0, 1,1,0], \"faces\": [[0,1,1]]", "/cage", "twice"),
        cage("\"faces\": [[0,1,2]]", "/cage", "either \"positions\" or \"points\""),
        cage("\"positions\": [0,0,0]", "/cage", "\"faces\" is missing"),
        cage(faces + ", \"scheme\": \"loop\"", "/cage", "triangles only"),
        cage(faces + ", \"scheme\": \"catmark\"", "/cage/scheme", "\"catmull_clark\""),
        cage(faces + ", \"holes\": [1]", "/cage/holes/0", "no face 1"),
        cage(faces + ", \"parts\": [0, 0]", "/cage/parts", "2 numbers for 1 faces"),
        cage(faces + ", \"creases\": [{\"points\": [0, 1]}]", "/cage/creases/0", "\"sharpness\" is missing"),
        cage(faces + ", \"creases\": [{\"points\": [0, 9], \"sharpness\": 1}]", "/cage/creases/0/points/1",
             "no point 9"),
        cage(faces + ", \"creases\": [{\"points\": [0, 1], \"sharpness\": -1}]", "/cage/creases/0/sharpness",
             "at least 0"),
        cage(faces + ", \"corners\": [{\"point\": 4, \"sharpness\": 1}]", "/cage/corners/0/point", "no point 4"),
        cage(faces + ", \"uv\": [0,0]", "/cage/uv", "\"face_uv\""),
        cage(faces + ", \"face_uv\": [[0,0,0,0]]", "/cage/face_uv", "missing"),
        cage(faces + ", \"uv\": [0,0], \"face_uv\": [[0,0,0]]", "/cage/face_uv/0", "face of 4"),
        cage(faces + ", \"uv\": [0,0], \"face_uv\": [[0,0,0,1]]", "/cage/face_uv/0/3", "no texture coordinate 1"),
        shape("\"type\": \"cage\", \"cage\": \"couch\"", "/cage", "no cage called"),
        shape("\"type\": \"cage\"", "", "\"cage\" is missing"),
        shape("\"type\": \"cage\", \"part\": 1, \"cage\": {" + faces + "}", "/part", "must lie within"),
    });
}

TEST(SceneJsonMeshes, TooManyTrianglesOfACageAreRefusedBeforeTheyAreMade) {
    std::string faces = "[0,1,2,3]";
    for (int i = 0; i < 20; ++i) faces += ", [0,1,2,3]";
    expect_refused(shape(R"("type": "cage", "cage": {"positions": [0,0,0, 1,0,0, 1,1,0, 0,1,0], "faces": [)" + faces +
                             R"(], "level": 10, "max_level": 10})",
                         "", "lower the cage's \"level\""));
}

}  // namespace
}  // namespace aleph
