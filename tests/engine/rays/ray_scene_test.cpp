// Posed scenes for rays: updates of what moved, instances that are left out, meshes that are refused.

#include "engine/rays/ray_scene.h"
#include "engine/pose/pose.h"
#include "engine/surface/shapes.h"
#include "tests/engine/rays/many_instances.h"
#include "tests/support/keyed_track.h"
#include "tests/support/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(RayScene, UpdateTouchesWhatMoved) {
    Scene scene = make_many();
    Track<glm::dvec3> moving;
    moving.sampling.kind = TimeSampling::Kind::acyclic;
    moving.sampling.times = {0.0, 1.0};
    moving.values = {glm::dvec3(0.0, 0.0, -5.0), glm::dvec3(3.0, 0.0, -5.0)};
    scene.nodes[0].transform.translation = moving;
    RayScene rays(scene);
    ScenePose frame = pose(scene, 0.0);
    EXPECT_EQ(rays.update(frame, glm::dvec3(0.0)), 4u);
    EXPECT_EQ(rays.update(frame, glm::dvec3(0.0)), 0u);
    frame = pose(scene, 0.5);
    EXPECT_EQ(rays.update(frame, glm::dvec3(0.0)), 1u);
    {
        Tracer tracer(rays);
        EXPECT_EQ(tracer.intersect({{1.5f, 0.0f, 0.0f}, {0.0f, 0.0f, -1.0f}}).instance, 0);
        EXPECT_NE(tracer.intersect({{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -1.0f}}).instance, 0);
    }
    EXPECT_EQ(rays.update(frame, glm::dvec3(64.0, 0.0, 0.0)), 4u);  // another anchor moves all
    {
        Tracer tracer(rays);
        EXPECT_EQ(tracer.intersect({{1.5f - 64.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -1.0f}}).instance, 0);
    }
    // Moved back: the same as when it was built.
    frame = pose(scene, 0.0);
    rays.update(frame, glm::dvec3(0.0));
    RayScene fresh(scene), shared = rays.share_meshes();
    fresh.update(frame, glm::dvec3(0.0));
    shared.update(pose(scene, 1.0), glm::dvec3(0.0));
    Tracer a(rays), b(fresh), c(shared);
    RandomRays random;
    for (int i = 0; i < 2000; ++i) {
        const Ray ray = random.next();
        ASSERT_EQ(a.intersect(ray).instance, b.intersect(ray).instance);
        ASSERT_EQ(a.intersect(ray).primitive, b.intersect(ray).primitive);
    }
    EXPECT_EQ(c.intersect({{3.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -1.0f}}).instance, 0);  // its own placement
}

TEST(RayScene, KF19_TinyInstancesWithVolumeAreMet) {
    for (const double scale : {1e-3, 1e-8, 1e-12}) {
        Scene scene = make_many();
        scene.nodes[0].transform.scale = glm::dvec3(scale);
        const Stage stage(scene);
        EXPECT_EQ(stage.rays.skipped_instances(), 0u) << scale;
        Tracer tracer(stage.rays);
        const glm::vec3 anchor(stage.shading.anchor);
        // Rays of the largest valid size, too.
        EXPECT_EQ(tracer.intersect({-anchor, {0.0f, 0.0f, -1.0f}}).instance, 0) << scale;
        EXPECT_EQ(tracer.intersect({-anchor, {0.0f, 0.0f, -9.9e8f}}).instance, 0) << scale;
        EXPECT_EQ(tracer.intersect({glm::vec3(9.9e8f), glm::vec3(9.9e8f)}).instance, no_index) << scale;
    }
    // Smaller than the rounding of a distance: a point, which does not disturb anything else.
    for (const double scale : {1e-20, 1e-30, 1e-200, 1e-300}) {
        Scene scene = make_many();
        scene.nodes[0].transform.scale = glm::dvec3(scale);
        const Stage stage(scene);
        EXPECT_EQ(stage.rays.skipped_instances(), 0u) << scale;
        const glm::vec3 beside = glm::vec3(1e-6f, 0.0f, 0.0f) - glm::vec3(stage.shading.anchor);
        EXPECT_NE(Tracer(stage.rays).intersect({beside, {0.0f, 0.0f, -1.0f}}).instance, 0) << scale;
    }
}

TEST(RayScene, KF19_ALargeMeshAtATinyScaleIsMet) {
    // A box of 1e9 m at a scale of 1e-9: 1 m in the world.
    Shape box;
    box.kind = Shape::Kind::box;
    box.size = glm::dvec3(1e9);
    for (const bool moves : {false, true}) {
        Scene scene;
        scene.meshes = {make_shape_mesh(box)};
        scene.nodes.resize(1);
        scene.nodes[0].meshes = {0};
        scene.nodes[0].transform.scale = glm::dvec3(1e-9);
        if (moves)
            scene.nodes[0].transform.translation =
                keyed<glm::dvec3>({0.0, 1.0}, {glm::dvec3(0.0), glm::dvec3(1.0, 0.0, 0.0)});
        RayScene rays(scene);
        rays.update(pose(scene, 0.0), glm::dvec3(0.0));
        EXPECT_EQ(rays.skipped_instances(), 0u);
        const Hit hit = Tracer(rays).intersect({{0.2f, 0.1f, 5.0f}, {0.0f, 0.0f, -1.0f}});
        EXPECT_EQ(hit.instance, 0);
        EXPECT_NEAR(hit.distance, 4.5f, 1e-5f);
        EXPECT_EQ(Tracer(rays).intersect({{0.6f, 0.1f, 5.0f}, {0.0f, 0.0f, -1.0f}}).instance, no_index);
    }
}

TEST(RayScene, HiddenNodesAreNotMet) {
    Scene scene = make_many();
    scene.nodes[0].visible = 0.0;
    const Stage stage(scene);
    EXPECT_EQ(stage.rays.skipped_instances(), 0u);
    Tracer tracer(stage.rays);
    EXPECT_NE(tracer.intersect({-glm::vec3(stage.shading.anchor), {0.0f, 0.0f, -1.0f}}).instance, 0);
}

}  // namespace
}  // namespace aleph
