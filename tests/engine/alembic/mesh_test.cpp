// Polygon meshes of archives: vertices, triangles, orientation, topology; archives against their truth, and small ones
// written here against the answer on paper.
#include "engine/alembic/polygons.h"
#include "engine/pose/pose.h"
#include "engine/scene/points.h"
#include "tests/engine/alembic/fixture.h"

namespace aleph {
namespace {

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
                if (mesh.deformation.vertex_points[i] != indices[corner].get<std::uint32_t>()) continue;
                if (mesh.uv[0][i] != glm::vec2(u, v) || glm::distance(posed.normals[i], normal) > 1e-6f) continue;
                found = used[i] = true;
            }
            EXPECT_TRUE(found) << "corner " << corner << " of sample " << sample;
        }
        EXPECT_TRUE(std::ranges::all_of(used, [](bool u) { return u; }));
    }
    EXPECT_EQ(mesh.triangles.size(), 32u);
    const PointCache& cache = scene.point_caches[mesh.deformation.points];
    const json& points = property_of(object, "P")["samples"];
    for (std::size_t i = 0; i < cache.positions.size(); ++i)
        for (std::size_t k = 0; k < 25; ++k) EXPECT_EQ(cache.positions[i][k], vec3_at(points[i][2], k));
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
            list.push_back(
                {static_cast<float>(mesh.deformation.vertex_points[i]), mesh.uv[0][i].x, 1.0f - mesh.uv[0][i].y});
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
    const auto uv = draft_array<float>("uv", DraftProperty::f32, 2, {{0, 0, 1, 1}}, "geoScope=fvr");
    const Scene scene = load({draft_triangle("m", {uv})});
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
    const PointCache& first = scene.point_caches[mesh_of(scene, "m", 0).deformation.points];
    EXPECT_EQ(sample_points(first, 0.5)[0], glm::dvec3(0, 0, 1));
    EXPECT_EQ(sample_points(first, 1.9)[0], glm::dvec3(0, 0, 2));  // holds: not half way to another surface
    EXPECT_EQ(evaluate(mesh_of(scene, "m", 0).present, 1.9), 1.0);
    EXPECT_EQ(evaluate(mesh_of(scene, "m", 0).present, 2.0), 0.0);
    EXPECT_EQ(evaluate(mesh_of(scene, "m", 1).present, 2.0), 1.0);
}

/// As effects are that appear and vanish: the samples of normals are not those of the one surface that is left.
TEST(AlembicMeshes, AMeshThatIsEmptyAtFirstKeepsItsNormals) {
    const std::vector<float> points{0, 0, 0, 1, 0, 0, 0, 1, 0}, normals{0, 0, 1, 0, 0, 1, 0, 0, 1};
    for (const bool at_first : {false, true}) {
        const auto order = [&]<class T>(const std::vector<T>& there) {
            return at_first ? std::vector<std::vector<T>>{{}, there} : std::vector<std::vector<T>>{there, {}};
        };
        DraftObject mesh = draft_mesh("m", order(points), order(std::vector<std::int32_t>{3}),
                                      order(std::vector<std::int32_t>{0, 1, 2}));
        mesh.properties[0].children.push_back(
            draft_array<float>("N", DraftProperty::f32, 3, order(normals), "geoScope=vtx"));
        const Scene scene = load({mesh}, {0.0, 1.0});
        EXPECT_FALSE(has_warning(scene, "normals are left out")) << at_first;
        EXPECT_EQ(mesh_of(scene, "m").normals.size(), 3u) << at_first;
    }
}

/// Alembic takes times for equal that differ by 1e-5 s: the period may be a float.
TEST(AlembicMeshes, AChangeOnAFrameCountsAtTheFrame) {
    const std::vector<float> a{0, 0, 0, 1, 0, 0, 0, 1, 0}, c{0, 0, 9, 1, 0, 9, 1, 1, 9, 0, 1, 9};
    const double late = 1.0 + 9e-6;
    const Scene scene = load({draft_mesh("m", {a, c}, {{3}, {4}}, {{0, 1, 2}, {0, 1, 2, 3}})}, {0.0, late});
    EXPECT_EQ(evaluate(mesh_of(scene, "m", 0).present, 1.0), 0.0);
    EXPECT_EQ(evaluate(mesh_of(scene, "m", 1).present, 1.0), 1.0);
    EXPECT_EQ(evaluate(mesh_of(scene, "m", 1).present, 0.999), 0.0);
}

TEST(AlembicMeshes, AConcavePolygonIsCutInsideItsOutline) {
    // An arrow and an L, counter-clockwise seen from below, from every corner on.
    const std::vector<glm::vec3> arrow{{0, 0, 0}, {2, 0, 1}, {4, 0, 0}, {2, 0, 4}},
        corner{{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}, {1, 0, 2}, {0, 0, 2}};
    for (const auto& [outline, area] : {std::pair(arrow, 6.0), std::pair(corner, 3.0)}) {
        for (std::size_t first = 0; first < outline.size(); ++first) {
            std::vector<glm::vec3> points = outline;
            std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(first), points.end());
            std::vector<std::array<std::uint32_t, 3>> triangles;
            std::uint64_t effort = 1000, none = 0;
            EXPECT_TRUE(triangulate_polygon(points, effort, triangles));
            EXPECT_EQ(triangles.size(), points.size() - 2);
            double sum = 0.0;
            for (const auto& [a, b, c] : triangles) {
                const glm::dvec3 normal = triangle_normal(points, {a, b, c});
                EXPECT_LE(normal.y, 0.0);  // all the same way: none covers what another does
                sum -= 0.5 * normal.y;
            }
            EXPECT_NEAR(sum, area, 1e-12);
            triangles.clear();
            EXPECT_FALSE(triangulate_polygon(points, none, triangles));
            EXPECT_EQ(triangles.size(), points.size() - 2);  // a fan then
        }
    }
}

}  // namespace
}  // namespace aleph
