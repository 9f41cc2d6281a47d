// The flat tree: what belongs to it, and that rays meet the same there as through an instance for every node.

#include "engine/rays/state.h"
#include "engine/surface/shapes.h"
#include "tests/engine/rays/ray_patterns.h"
#include "tests/support/scenes/deforming_scenes.h"

namespace aleph {
namespace {

Node make_node(int mesh, const glm::dvec3& place) {
    return {.transform = {.translation = place}, .meshes = {mesh}};
}

/// Spheres, boxes and masked sheets: turned, scaled, mirrored, some shared; the last node moves.
Scene make_objects(const glm::dvec3& place) {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[0].opacity.mode = Opacity::Mode::mask;
    scene.materials[1].opacity.mode = Opacity::Mode::blend;
    scene.materials[1].opacity.alpha = 0.5;
    scene.meshes = {make_shape_mesh({.kind = Shape::Kind::sphere, .segments = 24}),
                    make_shape_mesh({.kind = Shape::Kind::box, .size = {1.0, 3.0, 0.5}}), make_sheet(6), make_sheet(3)};
    for (std::size_t i = 0; i < scene.meshes[2].positions.size(); ++i)
        scene.meshes[2].colors.emplace_back(1.0f, 1.0f, 1.0f, i % 2 == 0 ? 1.0f : 0.0f);
    scene.meshes[2].material = 0;
    scene.meshes[3].material = 1;
    for (int i = 0; i < 12; ++i) {
        Node node = make_node(i % 4, place + glm::dvec3(2.5 * (i % 3) - 2.5, 2.5 * (i / 3) - 3.0, 0.7 * (i % 5)));
        node.transform.rotation = glm::angleAxis(0.4 * i, glm::normalize(glm::dvec3(1.0, i, -2.0)));
        node.transform.scale = glm::dvec3(i % 2 == 0 ? 1.0 : -0.8, 1.0, 1.0 + 0.1 * i);
        scene.nodes.push_back(node);
    }
    scene.nodes.back().transform.translation =
        Track<glm::dvec3>({0.0, 1.0}, {place, place + glm::dvec3(0.0, 0.0, 1.0)});
    return scene;
}

std::vector<Ray> make_random_rays(std::size_t count, const glm::vec3& middle) {
    std::mt19937 random(23);
    std::uniform_real_distribution<float> number(-1.0f, 1.0f);
    const auto any = [&] { return glm::vec3(number(random), number(random), number(random)); };
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        ray.origin = middle + 8.0f * any();
        ray.direction = middle + 4.0f * any() - ray.origin;
    }
    return rays;
}

/// The share of rays that meet another triangle, or the same at another place.
/// @param tolerance  of distances, in lengths of the direction
double count_differences(const RayScene& a, const RayScene& b, const std::vector<Ray>& rays, Blend blend,
                         double tolerance) {
    const std::vector<Hit> hits = trace(a, rays, true, blend), others = trace(b, rays, true, blend);
    std::size_t different = 0, met = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Hit &x = hits[i], &y = others[i];
        met += x.instance != no_index;
        different += x.instance != y.instance || x.primitive != y.primitive ||
                     std::abs(x.distance - y.distance) > tolerance || std::abs(x.u - y.u) > 0.05f ||
                     std::abs(x.v - y.v) > 0.05f;
    }
    EXPECT_GT(met, rays.size() / 6);
    const std::vector<std::uint8_t> blocked = find_blocked(a, rays, blend),
                                    others_blocked = find_blocked(b, rays, blend);
    for (std::size_t i = 0; i < rays.size(); ++i) different += blocked[i] != others_blocked[i];
    return static_cast<double>(different) / static_cast<double>(2 * rays.size());
}

TEST(FlatTree, RaysMeetTheSameAsThroughInstances) {
    const Scene scene = make_objects(glm::dvec3(0.0));
    RayScene first(scene), flat = first.share_meshes();
    RayScene nodes = make_ray_scene(scene, std::make_unique<EmbreeDevice>(), false);
    EXPECT_EQ(trace(flat, make_random_rays(100, glm::vec3(0.0f))), std::vector<Hit>(100));  // not yet placed
    first.update(pose(scene, 0.0), glm::dvec3(0.0, 0.0, 32.0));                             // another anchor
    EXPECT_TRUE(flat.is_flat(0));
    EXPECT_FALSE(flat.is_flat(11));
    EXPECT_FALSE(nodes.is_flat(0));
    for (const glm::dvec3 anchor : {glm::dvec3(0.0), glm::dvec3(16.0, -32.0, 48.0)}) {
        for (const double seconds : {0.0, 1.0}) {
            flat.update(pose(scene, seconds), anchor);
            nodes.update(pose(scene, seconds), anchor);
            const std::vector<Ray> rays = make_random_rays(8000, glm::vec3(-anchor));
            for (const Blend blend : {Blend::cutout, Blend::random})
                EXPECT_LT(count_differences(flat, nodes, rays, blend, 1e-4), 2e-4);
        }
    }
}

TEST(FlatTree, FarFromTheOriginOfTheWorldItIsAsPrecise) {
    const glm::dvec3 place(1e6, -2e5, 3e6);
    const Scene scene = make_objects(place), near = make_objects(glm::dvec3(0.0));
    RayScene far_rays(scene), near_rays(near);
    EXPECT_TRUE(far_rays.is_flat(0));
    EXPECT_LT(glm::length(far_rays.flat_origin() - place), 8.0);
    far_rays.update(pose(scene, 0.0), place);
    near_rays.update(pose(near, 0.0), glm::dvec3(0.0));
    EXPECT_LT(count_differences(far_rays, near_rays, make_random_rays(8000, glm::vec3(0.0f)), Blend::cutout, 1e-4),
              2e-4);
}

std::vector<std::uint8_t> find_flat(const Scene& scene) {
    return make_flat_plan(scene, make_pose_plan(scene)).flat;
}

TEST(FlatTree, WhatCouldLosePrecisionStaysOutside) {
    Scene scene;
    scene.meshes = {make_sheet(2)};
    scene.nodes = {make_node(0, {0.0, 0.0, 0.0}),  make_node(0, {9.0, 0.0, 0.0}),         make_node(0, {0.0, 9.0, 0.0}),
                   make_node(0, {0.0, 3.0, 0.0}),  make_node(0, {1e3, 0.0, 0.0}),         make_node(0, {0.0, 0.0, 9.0}),
                   make_node(0, {1e20, 0.0, 0.0}), make_node(0, {not_a_number, 0.0, 0.0})};
    scene.nodes[3].transform.scale = glm::dvec3(1e3);   // a floor of 2 km
    scene.nodes[5].transform.scale = glm::dvec3(1e-3);  // 2 mm, 9 m away
    EXPECT_EQ(find_flat(scene), (std::vector<std::uint8_t>{1, 1, 1, 1, 0, 0, 0, 0}));
    // All of it a thousand times smaller, and far away.
    for (Node& node : scene.nodes) {
        node.transform.scale = glm::dvec3(1e-3) * evaluate(node.transform.scale, 0.0);
        node.transform.translation = glm::dvec3(5.0) + 1e-3 * evaluate(node.transform.translation, 0.0);
    }
    EXPECT_EQ(find_flat(scene), (std::vector<std::uint8_t>{1, 1, 1, 1, 1, 0, 0, 0}));
}

TEST(FlatTree, WhatChangesOrIsHiddenStaysOutside) {
    Scene scene = make_sheet_scene(2);
    scene.meshes.push_back(make_sheet(2));
    scene.meshes.push_back(make_sheet(2));
    scene.meshes[2].present = Track<double>({0.0, 1.0}, {1.0, 0.0});
    for (int i = 0; i < 5; ++i) scene.nodes.push_back(make_node(i == 4 ? 2 : 1, {0.0, 0.0, 0.5 * i}));
    add_cache(scene, 0, {0.0, 1.0},
              [](const glm::vec3& p, std::size_t sample) { return static_cast<float>(sample + 1) * p; });
    scene.nodes[2].visible = 0.0;
    scene.nodes[3].visible = Track<double>({0.0, 1.0}, {1.0, 0.0});
    const std::vector<std::uint8_t> flat = find_flat(scene);
    EXPECT_EQ(flat, (std::vector<std::uint8_t>{0, 1, 0, 0, 1, 0}));
}

TEST(FlatTree, SharedMeshesAreCopiedWithinABudget) {
    Scene scene;
    scene.meshes = {make_sheet(100), make_sheet(2)};  // 20,000 and 8 triangles
    for (int i = 0; i < 40; ++i)
        for (const int mesh : {0, 1}) scene.nodes.push_back(make_node(mesh, {0.1 * i, 0.0, 0.0}));
    const std::vector<std::uint8_t> flat = find_flat(scene);
    for (std::size_t i = 0; i < flat.size(); ++i) EXPECT_EQ(flat[i], i % 2) << i;
}

}  // namespace
}  // namespace aleph
