// RC-07, RC-06: which of several surfaces at one distance is hit depends neither on how Embree's trees were built nor
// on whether rays are cast one by one or in packets.

#include <algorithm>
#include <random>

#include "engine/rays/ray_scene.h"
#include "engine/rays/traversal.h"
#include "tests/engine/rays/ray_patterns.h"
#include "tests/support/scenes/deforming_scenes.h"

namespace aleph {
namespace {

std::vector<Ray> make_rays(std::size_t count, float half_size) {
    return rays_through_square(count, {0.3f, 0.2f, 5.0f}, half_size, 11);
}

/// Rays at the edges and corners of make_sheet(cells).
std::vector<Ray> make_edge_rays(unsigned cells) {
    std::vector<Ray> rays;
    for (unsigned i = 0; i <= 4 * cells; ++i) {
        for (unsigned j = 0; j <= 4 * cells; ++j) {
            const auto at = [&](unsigned k) {
                return static_cast<float>(k) / (2.0f * static_cast<float>(cells)) - 1.0f;
            };
            Ray ray{.origin = {0.25f, 0.5f, 4.0f}};
            ray.direction = glm::vec3(at(i), at(j), 0.0f) - ray.origin;
            rays.push_back(ray);
        }
    }
    return rays;
}

/// How many rays hit another instance or primitive.
std::size_t count_differences(const std::vector<Hit>& a, const std::vector<Hit>& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += a[i].instance != b[i].instance || a[i].primitive != b[i].primitive;
    return count;
}

/// Sheets in one plane: the same one twice, a finer one and a moving one, which deforms into the plane at 1 s.
Scene make_coplanar_scene() {
    Scene scene;
    scene.meshes = {make_sheet(8), make_sheet(5), make_sheet(8)};
    scene.nodes.resize(5);
    scene.nodes[0].meshes = {1};
    scene.nodes[1].meshes = {0};
    scene.nodes[2].meshes = {2};
    scene.nodes[3].meshes = {0, 1};
    scene.nodes[4].meshes = {0};
    scene.nodes[4].transform.translation = Track<glm::dvec3>({0.0, 1.0}, {glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.0)});
    add_cache(scene, 2, {0.0, 0.5, 1.0}, [](const glm::vec3& p, std::size_t sample) {
        return p + glm::vec3(0.0f, 0.0f, sample == 2 ? 0.0f : 0.5f * p.x * p.y + 0.1f * static_cast<float>(sample));
    });
    return scene;
}

TEST(RayTies, RC07_RefitsFreshBuildsPacketsAndSingleRaysAgree) {
    const Scene scene = make_coplanar_scene();
    RayScene refitted(scene);
    const RayScene fresh = place(scene, 1.0);
    for (const double seconds : {0.0, 0.2, 0.5, 0.9, 1.0}) refitted.update(pose(scene, seconds), glm::dvec3(0.0));
    for (const std::vector<Ray>& rays : {make_rays(20000, 1.1f), make_edge_rays(8), make_edge_rays(5)}) {
        const std::vector<Hit> expected = trace(fresh, rays, false);
        std::size_t met = 0;
        for (const Hit& hit : expected) met += hit.instance != no_index;
        EXPECT_GT(met, rays.size() / 2);
        EXPECT_EQ(count_differences(trace(fresh, rays), expected), 0u);
        for (const bool in_packets : {false, true})
            EXPECT_EQ(count_differences(trace(refitted, rays, in_packets), expected), 0u) << in_packets;
    }
}

TEST(RayTies, RC07_TheLowestInstanceAndPrimitiveOfEqualSurfacesWins) {
    Scene scene;
    scene.meshes = {make_sheet(4)};
    Mesh twice = scene.meshes[0];  // every triangle twice
    twice.triangles.insert(twice.triangles.end(), twice.triangles.begin(), twice.triangles.end());
    scene.meshes.push_back(twice);
    scene.nodes.resize(7);
    for (Node& node : scene.nodes) node.meshes = {1, 0};
    scene.nodes[0].visible = 0.0;
    // Instances 2 and 3 belong to node 1, which moves: another top-level scene than the rest, where there are many.
    scene.nodes[1].transform.translation = Track<glm::dvec3>({0.0, 1.0}, {glm::dvec3(0.0), glm::dvec3(0.0, 0.0, -1.0)});
    for (const std::size_t bystanders : {0, 400}) {
        for (std::size_t i = 0; i < bystanders; ++i) {
            scene.nodes.emplace_back();
            scene.nodes.back().meshes = {0};
            scene.nodes.back().transform.translation = glm::dvec3(10.0 + static_cast<double>(i), 0.0, 0.0);
        }
        RayScene rays = place(scene);
        for (const bool in_packets : {false, true}) {
            for (const Hit& hit : trace(rays, make_rays(4000, 0.99f), in_packets)) {
                ASSERT_EQ(hit.instance, 2);
                ASSERT_LT(hit.primitive, 32);
            }
        }
        rays.update(pose(scene, 1.0), glm::dvec3(0.0));
        for (const Hit& hit : trace(rays, make_rays(4000, 0.99f))) ASSERT_EQ(hit.instance, 4);
    }
}

TEST(RayTies, RC07_OfManySheetsThatLieCloseTheSameIsMetInAnyOrder) {
    // The nearest one has the highest number: of it and the ten within Nearest::tie of it, the farthest counts.
    constexpr int sheets = 40, within = 10;
    std::vector<Crossing> crossings(sheets);
    for (int i = 0; i < sheets; ++i) {
        crossings[i].distance = 1.0 + i * Nearest::tie / (within + 0.5);
        crossings[i].instance = sheets - 1 - i;
    }
    std::mt19937 random(1);
    Nearest nearest;
    for (int order = 0; order < 1000; ++order) {
        nearest.clear();
        for (const Crossing& crossing : crossings) nearest.offer(crossing);
        ASSERT_EQ(nearest.result().instance, sheets - 1 - within) << order;
        std::ranges::shuffle(crossings, random);
    }
}

TEST(RayTies, RC06_TheNearSideOfAThinWallIsMetFromAfar) {
    // 0.1 mm thick: from a kilometre both sides are at one distance, and the far side has the lower index.
    Scene scene;
    Mesh wall = make_sheet(2);
    const auto count = static_cast<std::uint32_t>(wall.positions.size());
    for (std::uint32_t i = 0; i < count; ++i) wall.positions.push_back(wall.positions[i] + glm::vec3(0, 0, 1e-4f));
    const std::size_t half = wall.triangles.size();
    for (std::size_t t = 0; t < half; ++t) wall.triangles.push_back(wall.triangles[t] + glm::uvec3(count));
    for (std::size_t t = 0; t < half; ++t) std::swap(wall.triangles[t].y, wall.triangles[t].z);  // its back faces -z
    scene.meshes = {wall};
    scene.nodes.resize(1);
    scene.nodes[0].meshes = {0};
    for (const bool mirrored : {false, true}) {
        scene.nodes[0].transform.scale = glm::dvec3(mirrored ? -1.0 : 1.0, 1.0, 1.0);
        RayScene placed = place(scene);
        for (const float side : {1.0f, -1.0f}) {
            std::vector<Ray> rays = make_rays(2000, 0.99f);
            for (Ray& ray : rays) {
                const glm::vec3 target = ray.origin + ray.direction;
                ray.origin = glm::vec3(30.0f, 20.0f, 1000.0f * side);
                ray.direction = target - ray.origin;
            }
            for (const bool in_packets : {false, true}) {
                for (const Hit& hit : trace(placed, rays, in_packets)) {
                    ASSERT_EQ(hit.instance, 0);
                    ASSERT_EQ(hit.primitive >= static_cast<int>(half), side > 0.0f);
                }
            }
        }
    }
}

}  // namespace
}  // namespace aleph
