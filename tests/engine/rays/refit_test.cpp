// Rays through scenes whose meshes deform, come and go.

#include "engine/pose/plan.h"
#include "engine/rays/ray_scene.h"
#include "tests/engine/rays/ray_patterns.h"
#include "tests/support/scenes/deforming_scenes.h"

namespace aleph {
namespace {

std::vector<Ray> make_rays(std::size_t count) {
    return rays_through_square(count, {0.5f, 0.25f, 9.0f}, 4.0f, 5);
}

/// Deforming meshes are traced in object space, those that stand still in the flat tree's.
bool is_same_but_for_rounding(const Hit& a, const Hit& b) {
    return a.instance == b.instance && a.primitive == b.primitive && std::abs(a.u - b.u) < 1e-3f &&
           std::abs(a.v - b.v) < 1e-3f && std::abs(a.distance - b.distance) < 1e-5f;
}

/// The scene frozen at a time: rigid meshes of the posed points.
Scene freeze(const Scene& scene, double seconds) {
    const ScenePose frame = pose(scene, seconds);
    Scene frozen;
    frozen.meshes = scene.meshes;
    for (std::size_t m = 0; m < frozen.meshes.size(); ++m) {
        Mesh& mesh = frozen.meshes[m];
        const Mesh rest = std::move(mesh);
        mesh = {};
        mesh.positions = rest.positions;
        mesh.triangles = rest.triangles;
        for (std::size_t v = 0; v < frame.meshes[m].positions.size(); ++v)
            mesh.positions[v] = glm::vec3(frame.meshes[m].positions[v]);
    }
    for (std::size_t i = 0; i < frame.instances.size(); ++i) {  // a node each, so that each is shown by itself
        Node node;
        node.transform.matrix = frame.world[frame.instances[i].node];
        node.meshes = {frame.instances[i].mesh};
        node.visible = frame.shown[i];
        frozen.nodes.push_back(node);
    }
    return frozen;
}

TEST(RayDeform, HitsAreThoseOfTheMovedTriangles) {
    const Scene scene = make_everything_scene();
    const PosePlan plan = make_pose_plan(scene);
    RayScene rays(scene);
    ScenePose frame = pose(scene, 0.0);
    const std::vector<Ray> asked = make_rays(4000);
    for (const double seconds : {0.0, 0.4, 0.8, 2.0, 1.0, 0.1}) {
        SCOPED_TRACE(seconds);
        update_pose(scene, plan, seconds, frame);
        rays.update(frame, glm::dvec3(0.0));
        const Scene frozen = freeze(scene, seconds);
        const std::vector<Hit> hits = trace(rays, asked), of_frozen = trace(place(frozen), asked);
        std::size_t met = 0, different = 0;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            met += hits[i].instance != no_index;
            different += !is_same_but_for_rounding(hits[i], of_frozen[i]);
        }
        EXPECT_GT(met, 300u);
        EXPECT_EQ(different, 0u);
    }
}

TEST(RayDeform, ATornMeshIsBuiltAnewAndStillMet) {
    Scene scene = make_sheet_scene(32);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> anywhere(-3.0f, 3.0f);
    add_cache(scene, 0, {0.0, 1.0}, [&](const glm::vec3& p, std::size_t sample) {
        return sample == 0 ? p : glm::vec3(anywhere(random), anywhere(random), anywhere(random));
    });
    RayScene refitted(scene);
    for (const double seconds : {0.0, 0.01, 0.2, 0.6, 1.0}) refitted.update(pose(scene, seconds), glm::dvec3(0.0));
    const std::vector<Ray> rays = make_rays(5000);
    EXPECT_EQ(trace(refitted, rays), trace(place(scene, 1.0), rays));
}

TEST(RayDeform, ScenesThatShareMeshesDeformAlone) {
    Scene scene = make_sheet_scene();
    add_cache(scene, 0, {0.0, 1.0}, [](const glm::vec3& p, std::size_t sample) {
        return p + glm::vec3(0.0f, 0.0f, static_cast<float>(sample));
    });
    RayScene now(scene), next = now.share_meshes();
    EXPECT_EQ(now.update(pose(scene, 0.0), glm::dvec3(0.0)), 1u);
    EXPECT_EQ(next.update(pose(scene, 1.0), glm::dvec3(0.0)), 1u);
    const Ray ray = ray_down(0.1f, 0.2f);
    EXPECT_FLOAT_EQ(Tracer(now).intersect(ray).distance, 5.0f);
    EXPECT_FLOAT_EQ(Tracer(next).intersect(ray).distance, 4.0f);
    EXPECT_EQ(next.update(pose(scene, 1.0), glm::dvec3(0.0)), 0u);
    EXPECT_EQ(next.update(pose(scene, 2.0), glm::dvec3(0.0)), 0u);  // held
    EXPECT_EQ(next.update(pose(scene, 0.5), glm::dvec3(0.0)), 1u);
    EXPECT_FLOAT_EQ(Tracer(next).intersect(ray).distance, 4.5f);
}

TEST(RayDeform, MeshesComeAndGoBesideOthersOfTheirNode) {
    Scene scene;
    scene.meshes = {make_sheet(1), make_sheet(2), make_sheet(3)};
    scene.nodes.resize(1);
    scene.nodes[0].meshes = {0, 1, 2};
    scene.meshes[0].present = Track<double>({0.0, 1.0}, {1.0, 0.0}, Interpolation::step);
    scene.meshes[1].present = Track<double>({0.0, 1.0}, {0.0, 1.0}, Interpolation::step);
    for (glm::vec3& p : scene.meshes[2].positions) p.z = -1.0f;
    RayScene rays(scene);
    const Ray ray = ray_down(0.1f, 0.2f);
    for (const auto& [seconds, instance] : {std::pair(0.5, 0), {1.5, 1}, {0.0, 0}}) {
        rays.update(pose(scene, seconds), glm::dvec3(0.0));
        EXPECT_EQ(Tracer(rays).intersect(ray).instance, instance);
        EXPECT_TRUE(Tracer(rays).occluded(ray));
    }
}

TEST(RayDeform, UpdatesTouchOnlyWhatMoves) {
    Scene scene = make_sheet_scene();
    for (int i = 0; i < 600; ++i) {
        Node node{.transform = {.translation = glm::dvec3(3.0 * (i % 30), 3.0 * (i / 30), -2.0)}, .meshes = {0}};
        if (i % 100 == 7)
            node.transform.translation = Track<glm::dvec3>({0.0, 1.0}, {glm::dvec3(i), glm::dvec3(i + 1)});
        scene.nodes.push_back(node);
    }
    const PosePlan plan = make_pose_plan(scene);
    EXPECT_EQ(plan.nodes.size(), 6u);
    EXPECT_EQ(plan.instances.size(), 6u);
    ScenePose frame = pose(scene, 0.0);
    RayScene rays(scene);
    EXPECT_EQ(rays.update(frame, glm::dvec3(0.0)), 601u);  // the first time everything
    update_pose(scene, plan, 0.5, frame);
    EXPECT_EQ(rays.update(frame, glm::dvec3(0.0)), 6u);
    EXPECT_EQ(rays.update(frame, glm::dvec3(0.0)), 0u);
    EXPECT_EQ(rays.update(frame, glm::dvec3(16.0, 0.0, 0.0)), 601u);
    RayScene fresh(scene);
    fresh.update(frame, glm::dvec3(16.0, 0.0, 0.0));
    const std::vector<Ray> asked = make_rays(3000);
    EXPECT_EQ(trace(rays, asked), trace(fresh, asked));
}

}  // namespace
}  // namespace aleph
