// The rasterizer: against cast rays, its rule for shared edges, and what breaks rasterizers.

#include "motion/raster.h"
#include "engine/surface/shapes.h"
#include "tests/support/first_hits.h"
#include "tests/support/numbers.h"
#include "tests/support/scenes/deforming_scenes.h"
#include "tests/support/scenes/motion_scenes.h"
#include "tests/support/test.h"
#include "tests/support/with_threads.h"

namespace aleph {
namespace {

bool same_item(const Hit& a, const Hit& b) {
    return a.instance == b.instance && a.primitive == b.primitive;
}

/// Compares items with cast rays, but for pixels at an edge: where rays a fiftieth of a pixel away hit other triangles.
/// @return share of the pixels that were compared
double compare_with_rays(const Scene& scene, const PosedView& posed) {
    RayScene rays(scene);
    rays.update(posed.pose, compute_anchor(posed.view));
    const Image<Hit> items = rasterize(scene, posed), hits = cast_first_hits(rays, posed.view);
    std::vector<Image<Hit>> around;
    for (const double dx : {-0.02, 0.02})
        for (const double dy : {-0.02, 0.02}) around.push_back(cast_first_hits(rays, posed.view, 0.5 + dx, 0.5 + dy));
    std::size_t compared = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const Hit &hit = hits.pixels[i], &item = items.pixels[i];
        const auto differs = [&](const Image<Hit>& other) { return !same_item(other.pixels[i], hit); };
        if (std::any_of(around.begin(), around.end(), differs)) continue;
        ++compared;
        EXPECT_TRUE(same_item(item, hit)) << i % hits.width << ", " << i / hits.width << ": " << item.instance << "/"
                                          << item.primitive << ", not " << hit.instance << "/" << hit.primitive;
        EXPECT_NEAR(item.u, hit.u, 0.5 / 255.0 + 1e-3);
        EXPECT_NEAR(item.v, hit.v, 0.5 / 255.0 + 1e-3);
        EXPECT_EQ(item.u * 255.0f, std::round(item.u * 255.0f)) << "8 bits";
    }
    return static_cast<double>(compared) / static_cast<double>(hits.size());
}

/// Random triangles around the camera: behind it, through its plane, before its near plane, larger than the picture.
Scene make_soup(bool orthographic, int triangles, float half_size) {
    Scene scene;
    add_node(scene, Node{.meshes = {add_triangle_soup(scene, triangles, half_size)}});
    add_camera(scene);
    Camera& camera = scene.cameras[0];
    camera.near_plane = 0.5;
    camera.orthographic = orthographic;
    camera.half_height = 0.4 * half_size;
    return scene;
}

TEST(Raster, ShowsTheTriangleThatRaysHit) {
    for (const bool orthographic : {false, true}) {
        for (const auto& [triangles, size] : {std::pair(40, 3.0f), std::pair(400, 5.0f), std::pair(12, 1000.0f)}) {
            SCOPED_TRACE(testing::Message() << orthographic << " " << triangles << " " << size);
            const Scene scene = make_soup(orthographic, triangles, size);
            EXPECT_GT(compare_with_rays(scene, make_posed_view(scene, 0.0, 0, 160, 120)), 0.8);
        }
    }
}

TEST(Raster, InstancesOfOneMeshAreToldApart) {
    Scene scene;
    const int mesh = add_triangle_soup(scene, 30, 0.7f);
    for (int i = 0; i < 9; ++i) {
        Node node{.transform = {.translation = glm::dvec3(2 * (i % 3) - 2, 2 * (i / 3) - 2, -8),
                                .scale = glm::dvec3(1.0 + 0.1 * i, 0.8, i % 2 == 0 ? 1.0 : -1.0)},
                  .meshes = {mesh}};
        add_node(scene, node);
    }
    add_camera(scene);
    scene.nodes[4].visible = Track<double>{0.0};
    const PosedView posed = make_posed_view(scene, 0.0, 0, 160, 120);
    EXPECT_GT(compare_with_rays(scene, posed), 0.9);
    for (const Hit& item : rasterize(scene, posed).pixels) EXPECT_NE(item.instance, 4) << "not shown";
}

TEST(Raster, DeformingMeshesAreDrawnAsPosed) {
    Scene scene = make_sheet_scene(6);
    scene.nodes[0].transform.translation = glm::dvec3(0.0, 0.0, -3.0);
    add_cache(scene, 0, {0.0, 1.0}, [](const glm::vec3& p, std::size_t sample) {
        return p + glm::vec3(0.0f, 0.0f, sample == 0 ? 0.0f : p.x * p.y);
    });
    add_camera(scene);
    const Image<Hit> flat = rasterize(scene, make_posed_view(scene, 0.0, 0, 160, 120));
    const PosedView bent = make_posed_view(scene, 0.7, 0, 160, 120);
    EXPECT_GT(compare_with_rays(scene, bent), 0.9);
    EXPECT_NE(flat, rasterize(scene, bent));
}

/// An orthographic camera whose pixels are 1/16 m wide, 32x32 of them, before a mesh in the plane z = -1.
Scene make_flat_scene(Mesh mesh) {
    Scene scene;
    scene.meshes = {std::move(mesh)};
    add_node(scene, Node{.transform = {.translation = glm::dvec3(0.0, 0.0, -1.0)}, .meshes = {0}});
    add_camera(scene);
    scene.cameras[0].orthographic = true;
    scene.cameras[0].half_height = 1.0;
    return scene;
}

/// How many triangles of a mesh cover each pixel, each drawn alone.
Image<int> count_cover(const Mesh& mesh) {
    Image<int> count(32, 32);
    for (const glm::uvec3& triangle : mesh.triangles) {
        Mesh alone = mesh;
        alone.triangles = {triangle};
        const Scene scene = make_flat_scene(alone);
        const Image<Hit> items = rasterize(scene, make_posed_view(scene, 0.0, 0, 32, 32));
        for (std::size_t i = 0; i < items.size(); ++i) count.pixels[i] += items.pixels[i].instance != no_index;
    }
    return count;
}

TEST(Raster, SharedEdgesBelongToOneTriangle) {
    // Corners lie on pixel centres, edges run through them, and triangles meet in every direction.
    Mesh mesh = make_sheet(4);
    for (glm::vec3& p : mesh.positions) p += glm::vec3(1.0f / 32.0f, 1.0f / 32.0f, 0.0f);
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) std::swap(mesh.triangles[i].x, mesh.triangles[i].y);
    const Image<int> count = count_cover(mesh);
    // One pixel lies between the picture's border and the sheet's.
    for (int y = 0; y < 31; ++y)
        for (int x = 1; x < 32; ++x) EXPECT_EQ(count(x, y), 1) << x << ", " << y;
}

TEST(Raster, AFanOfThinTrianglesHasNoCracks) {
    Mesh fan;
    fan.positions = {{1.0f / 32.0f, 1.0f / 32.0f, 0.0f}};
    constexpr unsigned blades = 100;
    for (unsigned i = 0; i < blades; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / blades;
        fan.positions.emplace_back(2.0 * std::cos(angle), 2.0 * std::sin(angle), 0.0);
        fan.triangles.emplace_back(0, i + 1, (i + 1) % blades + 1);
    }
    EXPECT_EQ(count_cover(fan), Image<int>(32, 32, 1));
}

TEST(Raster, TheInsideOfAClosedSurfaceHasNoHoles) {
    Scene scene;
    scene.meshes = {make_shape_mesh({.kind = Shape::Kind::sphere, .radius = 1.0, .segments = 64})};
    add_node(scene, Node{.meshes = {0}});
    add_camera(scene, no_index, 2.5);
    for (const Hit& item : rasterize(scene, make_posed_view(scene, 0.0, 0, 320, 240)).pixels)
        ASSERT_NE(item.instance, no_index);
}

TEST(Raster, TrianglesSmallerThanPixelsLeaveNoGaps) {
    const Scene scene = make_flat_scene(make_sheet(300));
    for (const Hit& item : rasterize(scene, make_posed_view(scene, 0.0, 0, 32, 32)).pixels) EXPECT_EQ(item.instance, 0);
}

TEST(Raster, AFloorReachesFromBehindTheCameraToTheHorizon) {
    Scene scene;
    add_endless_floor(scene);
    add_camera(scene);
    const Image<Hit> items = rasterize(scene, make_posed_view(scene, 0.0, 0, 80, 60));
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 80; ++x) EXPECT_EQ(items(x, y).instance, y < 30 ? no_index : 0) << x << ", " << y;
}

TEST(Raster, OfSurfacesAtOneDepthTheFirstIsShown) {
    Scene scene = make_flat_scene(make_sheet(3));
    scene.nodes.push_back(scene.nodes[0]);
    const PosedView posed = make_posed_view(scene, 0.0, 0, 32, 32);
    for (const Hit& item : rasterize(scene, posed).pixels) EXPECT_EQ(item.instance, 0);
}

TEST(Raster, ACutOutHidesWhatIsBehindIt) {
    Scene scene = make_flat_scene(make_sheet(1));
    scene.materials.resize(1);
    scene.materials[0].opacity.mode = Opacity::Mode::mask;
    scene.materials[0].opacity.alpha = Track<double>{0.0};
    scene.meshes[0].material = 0;
    const PosedView posed = make_posed_view(scene, 0.0, 0, 32, 32);
    EXPECT_EQ(cast_first_hits(scene, posed)(9, 9).instance, no_index);
    EXPECT_EQ(rasterize(scene, posed)(9, 9).instance, 0);
}

TEST(Raster, WhatCannotBeTracedIsNotDrawn) {
    for (const glm::dvec3& scale : {glm::dvec3(0.0), glm::dvec3(not_a_number), glm::dvec3(1e300)}) {
        Scene scene = make_flat_scene(make_sheet(1));
        scene.nodes[0].transform.scale = scale;
        for (const Hit& item : rasterize(scene, make_posed_view(scene, 0.0, 0, 32, 32)).pixels) EXPECT_EQ(item, Hit());
    }
    Scene empty;
    add_camera(empty);
    EXPECT_EQ(rasterize(empty, make_posed_view(empty, 0.0, 0, 5, 4)), Image<Hit>(5, 4));
}

TEST(Raster, SameForAnyNumberOfThreads) {
    const Scene scene = make_soup(false, 3000, 5.0f);
    const PosedView posed = make_posed_view(scene, 0.0, 0, 97, 61);
    const auto run = [&](int threads) { return with_threads(threads, [&] { return rasterize(scene, posed); }); };
    const Image<Hit> one = run(1);
    EXPECT_EQ(one, run(2));
    EXPECT_EQ(one, run(7));
}

}  // namespace
}  // namespace aleph
