// Geometry that Embree would drop without a word, read beyond its end, or end the process for.

#include "engine/rays/state.h"
#include "tests/engine/rays/ray_patterns.h"
#include "tests/support/scenes/deforming_scenes.h"

namespace aleph {
namespace {

TEST(BadGeometry, RC02_KF18_InstancesWithoutVolumeAreLeftOut) {
    for (const glm::dvec3& scale :
         {glm::dvec3(0.0), glm::dvec3(not_a_number), glm::dvec3(1.0, 0.0, 1.0), glm::dvec3(1.0, 1.0, 1e-30),
          glm::dvec3(1.0, 1e-20, 1.0), glm::dvec3(1.0, 1.0, not_a_number), glm::dvec3(1e300), glm::dvec3(infinity)}) {
        Scene scene = make_sheet_scene(1);
        scene.nodes.push_back(scene.nodes[0]);
        scene.nodes[1].transform.translation = glm::dvec3(0.0, 0.0, -1.0);
        scene.nodes[0].transform.scale = scale;
        RayScene rays = place(scene);
        SCOPED_TRACE(testing::PrintToString(std::array{scale.x, scale.y, scale.z}));
        EXPECT_EQ(instance_at(rays, 0.3f, 0.2f), 1);
        EXPECT_EQ(instance_at(rays, 0.0f, 0.0f), 1);
    }
    for (const double scale : {1e-30, 1e-20}) {  // with volume: met where it is, and nowhere else
        Scene scene = make_sheet_scene(1);
        scene.nodes[0].transform.scale = glm::dvec3(scale);
        RayScene rays = place(scene);
        EXPECT_EQ(instance_at(rays, 0.0f, 0.0f), 0);
        EXPECT_EQ(instance_at(rays, 1e-15f, 0.0f), no_index);
    }
}

TEST(BadGeometry, RC08_MeshesThatEmbreeWouldDropAreRefusedByName) {
    const auto expect_refused = [](const Scene& scene, const std::string& word) {
        const Refusal found = find_refusal([&] { RayScene rays(scene); });
        EXPECT_NE(found.place.find("mesh 0 \"sheet\""), std::string::npos) << word << ": " << found.message;
        EXPECT_NE(found.reason.find(word), std::string::npos) << found.message;
    };
    Scene good = make_sheet_scene(2);
    good.meshes[0].name = "sheet";
    for (const float bad : {float_nan, float_infinity, -float_infinity, 1.85e18f, -3e38f}) {
        for (int k = 0; k < 3; ++k) {
            Scene scene = good;
            scene.meshes[0].positions[8][k] = bad;
            expect_refused(scene, "not finite or too large");
        }
    }
    for (const std::uint32_t index : {9u, 0x7fffffffu, 0xffffffffu}) {
        Scene scene = good;
        scene.meshes[0].triangles[7].y = index;
        expect_refused(scene, "of 9");
    }
    Scene largest = good;  // within Embree's limits
    largest.meshes[0].positions[8].x = 1.8e18f;
    RayScene rays = place(largest);
    EXPECT_EQ(instance_at(rays, -0.5f, -0.4f), 0);
}

TEST(BadGeometry, RC08_ADeformingMeshIsLeftOutWhileItsPointsAreBad) {
    for (const float bad : {float_nan, float_infinity, 1.85e18f}) {
        Scene scene = make_sheet_scene(2);
        add_cache(scene, 0, {0.0, 1.0, 2.0}, [&](const glm::vec3& p, std::size_t sample) {
            return sample == 1 && p.x > 0.5f ? glm::vec3(p.x, bad, p.z) : p;
        });
        RayScene rays(scene);
        for (const auto& [seconds, instance] : {std::pair(0.0, 0), {1.0, no_index}, {2.0, 0}}) {
            rays.update(pose(scene, seconds), glm::dvec3(0.0));
            EXPECT_EQ(instance_at(rays, 0.3f, 0.2f), instance) << bad << " " << seconds;
        }
    }
}

TEST(BadGeometry, RC09_RC12_TrianglesWithoutAreaAreNeverMet) {
    Scene scene = make_sheet_scene(1);
    Mesh& mesh = scene.meshes[0];
    const auto add = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {a, b, c});
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    };
    add({0.5f, 0.5f, 1.0f}, {0.5f, 0.5f, 1.0f}, {0.5f, 0.5f, 1.0f});       // a point
    add({-0.5f, 0.5f, 1.0f}, {0.0f, 0.5f, 1.0f}, {0.5f, 0.5f, 1.0f});      // a line
    add({0.25f, 0.25f, 1.0f}, {0.25f, 0.25f, 1.0f}, {0.5f, 0.25f, 1.0f});  // two corners are one
    add({0.0f, 0.0f, 1.0f}, {3e-13f, 0.0f, 1.0f}, {0.0f, 3e-13f, 1.0f});   // 5e-26 m2: a float normal of length 0
    RayScene rays = place(scene);
    Tracer tracer(rays);
    for (const auto& [x, y] : {std::pair(0.5f, 0.5f), {0.0f, 0.5f}, {0.25f, 0.25f}, {0.3f, 0.25f}}) {
        const Hit hit = tracer.intersect(ray_down(x, y));
        EXPECT_EQ(hit.instance, 0);
        EXPECT_LT(hit.primitive, 2) << x << " " << y;  // the sheet behind
    }
    EXPECT_EQ(instance_at(rays, 1e-13f, 1e-13f), 0);  // the tiny one, or the sheet behind it
}

TEST(BadGeometry, RC10_NoTrianglesAreNoGeometry) {
    Scene scene = make_sheet_scene(1);
    scene.meshes[0].triangles.clear();
    scene.meshes.push_back({});
    scene.nodes[0].meshes = {0, 1};
    RayScene rays = place(scene);
    EXPECT_EQ(instance_at(rays, 0.0f, 0.0f), no_index);
}

TEST(BadGeometry, RC14_TrianglesAreKeptInBlocksOfTheirOwn) {
    // Embree reads no vertex buffer: it only knows the boxes of blocks, which hold copies. The sanitizers run this.
    Scene scene = make_sheet_scene(3);
    add_cache(scene, 0, {0.0, 1.0}, [](const glm::vec3& p, std::size_t) { return p; });
    scene.meshes.push_back(make_sheet(3));
    scene.nodes.resize(2);
    scene.nodes[1].meshes = {1};
    scene.nodes[1].transform.translation = glm::dvec3(0.0, 0.0, -1.0);
    RayScene rays(scene);
    {
        ScenePose posed = pose(scene, 0.5);
        rays.update(posed, glm::dvec3(0.0));
    }  // neither the pose nor, from here, the scene is needed
    for (Mesh& mesh : scene.meshes) {
        mesh.positions = {};
        mesh.triangles = {};
    }
    scene.point_caches.clear();
    Tracer tracer(rays);
    for (const float at : {-0.95f, -0.2f, 0.4f, 0.95f}) {  // the last one in the triangle of the last vertex
        EXPECT_EQ(tracer.intersect(ray_down(at, at - 0.01f)).instance, 0);
        Ray from_below = ray_down(at, at - 0.01f);
        from_below.origin.z = -5.0f;
        from_below.direction.z = 1.0f;
        EXPECT_EQ(tracer.intersect(from_below).instance, 1);
    }
}

}  // namespace
}  // namespace aleph
