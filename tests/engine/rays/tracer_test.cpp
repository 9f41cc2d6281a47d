// Rays through a posed scene: invalid rays, ranges, tiny instances, one ray through every pixel.

#include "engine/pose/camera_view.h"
#include "engine/rays/ray_scene.h"
#include "engine/surface/shapes.h"
#include "tests/support/first_hits.h"
#include "tests/support/scenes/render_scenes.h"

namespace aleph {
namespace {

/// Several instances, two of one mesh, some turned and scaled.
Scene make_many() {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.5));
    add_mesh(scene, make_faceted_sphere(1.0, 24, white), {0.0, 0.0, -5.0});
    add_mesh(scene, make_box({1.0, 2.0, 1.0}, white), {2.0, 0.0, -6.0}, glm::angleAxis(0.5, glm::dvec3(0.0, 1.0, 0.0)));
    const int squashed = add_node(scene, {-2.0, 0.5, -5.0}, glm::angleAxis(1.0, glm::dvec3(0.0, 0.0, 1.0)));
    scene.nodes[squashed].meshes = {0};
    scene.nodes[squashed].transform.scale = glm::dvec3(-0.5, 1.0, 0.3);
    add_mesh(scene, make_quad(20.0, 20.0, white), {0.0, -2.0, 0.0}, z_to_up);
    return scene;
}

class RandomRays {
  public:
    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
    glm::vec3 in_cube(float half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
    Ray next() {
        return {in_cube(8.0f) - glm::vec3(0.0f, 0.0f, 5.0f), in_cube(1.0f), 0.0f,
                uniform(0.0f, 1.0f) < 0.5f ? float_infinity : 5.0f};
    }
    /// A number such as a broken computation gives.
    float special() {
        const float values[] = {0.0f,
                                -0.0f,
                                1e-45f,
                                -1e-39f,
                                1.0f,
                                -1.0f,
                                9.9e8f,
                                1.843e18f,
                                1.85e18f,
                                -3.4e38f,
                                3.4e38f,
                                float_infinity,
                                -float_infinity,
                                float_nan,
                                uniform(-9.0f, 9.0f),
                                uniform(-9.0f, 9.0f)};
        return values[std::uniform_int_distribution<std::size_t>(0, 15)(engine_)];
    }

  private:
    std::mt19937 engine_{11};
};

/// Numbers within the limit, a direction that is not 0, a range of distances from 0 on that is not reversed.
bool is_traceable_ray(const Ray& ray) {
    const auto largest = [](const glm::vec3& v) {
        const bool numbers = v.x == v.x && v.y == v.y && v.z == v.z;
        return numbers ? std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) : float_infinity;
    };
    return largest(ray.origin) < max_ray_component && largest(ray.direction) < max_ray_component &&
           largest(ray.direction) >= 1e-30f && ray.near >= 0.0f && ray.near < max_ray_component && ray.far >= ray.near;
}

TEST(RayScene, RC01_BadRaysAreMissesAndCounted) {
    const Stage stage(make_many());
    RandomRays random;
    std::uint64_t asked = 0, sure_bad = 0, met = 0;
    const std::uint64_t before = stage.rays.rays_traced(), bad_before = stage.rays.invalid_rays();
    {
        Tracer tracer(stage.rays);
        std::vector<Ray> rays(16);
        std::vector<Hit> hits(16);
        for (int round = 0; round < 1'000'000 / 16; ++round) {
            for (std::size_t i = 0; i < rays.size(); ++i) {
                Ray& ray = rays[i];
                ray = random.next();
                float* numbers[] = {&ray.origin.x,    &ray.origin.y,    &ray.origin.z, &ray.direction.x,
                                    &ray.direction.y, &ray.direction.z, &ray.near,     &ray.far};
                const int changes = static_cast<int>(random.uniform(0.0f, 3.9f));
                for (int c = 0; c < changes; ++c)
                    *numbers[static_cast<std::size_t>(random.uniform(0.0f, 7.999f))] = random.special();
            }
            tracer.intersect(rays, hits);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const Ray& r = rays[i];
                // A ray does not depend on its neighbours in the packet.
                const Hit alone = tracer.intersect(r);
                const bool blocked = tracer.occluded(r);
                if (is_traceable_ray(r)) {
                    ASSERT_EQ(alone, hits[i]);
                    ASSERT_EQ(blocked, alone.instance != no_index);
                    met += alone.instance != no_index;
                } else {
                    ++sure_bad;
                    ASSERT_EQ(hits[i], Hit{});
                    ASSERT_EQ(alone, Hit{});
                    ASSERT_FALSE(blocked);
                }
            }
            asked += 3 * rays.size();
        }
    }
    const std::uint64_t bad = stage.rays.invalid_rays() - bad_before;
    EXPECT_EQ(stage.rays.rays_traced() - before + bad, asked);
    EXPECT_EQ(bad, 3 * sure_bad);
    EXPECT_GT(sure_bad, 100'000u);
    EXPECT_GT(met, 100'000u);
}

TEST(RayScene, RC01_RangesWithoutLengthAreMisses) {
    const Stage stage(make_many());
    const glm::vec3 anchor(stage.shading.anchor), to_sphere(0.0f, 0.0f, -1.0f);
    Tracer tracer(stage.rays);
    EXPECT_EQ(tracer.intersect({-anchor, to_sphere}).instance, 0);
    EXPECT_NEAR(tracer.intersect({-anchor, to_sphere}).distance, 4.0f, 0.02f);
    EXPECT_NEAR(tracer.intersect({-anchor, 2.0f * to_sphere}).distance, 2.0f, 0.01f);  // in lengths of the direction
    EXPECT_EQ(tracer.intersect({-anchor, to_sphere, 0.0f, 3.0f}).instance, no_index);
    EXPECT_EQ(tracer.intersect({-anchor, to_sphere, 5.0f, 4.0f}).instance, no_index);
    EXPECT_EQ(tracer.intersect({-anchor, glm::vec3(0.0f)}).instance, no_index);
    EXPECT_FALSE(tracer.occluded({-anchor, to_sphere, -0.5f}));
}

TEST(RayScene, RangesAreKeptInScaledInstances) {
    // Spheres of one mesh, whose nearest points are 1 m away.
    for (const double scale : {0.01, 1.0, 40.0}) {
        Scene scene;
        const Mesh sphere = make_faceted_sphere(1.0, 64, add_lambert(scene, glm::dvec3(0.5)));
        const int node = add_mesh(scene, sphere, {0.0, 0.0, -1.0 - scale});
        scene.nodes.push_back(scene.nodes[static_cast<std::size_t>(node)]);
        scene.nodes.back().transform.translation = glm::dvec3(500.0, 0.0, 0.0);
        for (Node& each : scene.nodes) each.transform.scale = glm::dvec3(scale);
        const Stage stage(std::move(scene));
        Tracer tracer(stage.rays);
        const glm::vec3 origin(-stage.shading.anchor);
        for (const float length : {0.1f, 1.0f, 30.0f}) {
            const glm::vec3 direction(0.0f, 0.0f, -length);
            const auto hit = [&](float near, float far) {
                const Hit met = tracer.intersect({origin, direction, near / length, far / length});
                EXPECT_EQ(tracer.occluded({origin, direction, near / length, far / length}), met.instance != no_index);
                return met.instance == no_index ? 0.0f : met.distance * length;
            };
            const float inner = static_cast<float>(1.0 + 2.0 * scale);
            EXPECT_NEAR(hit(0.0f, 1e6f), 1.0f, 2e-3f * inner) << scale;
            EXPECT_NEAR(hit(0.9f, inner), 1.0f, 2e-3f * inner) << scale;
            EXPECT_EQ(hit(0.0f, 0.9f), 0.0f) << scale;
            EXPECT_EQ(hit(1.05f * inner, 1e6f), 0.0f) << scale;
        }
    }
}

TEST(RayScene, KF19_TinyInstancesWithVolumeAreMet) {
    for (const double scale : {1e-3, 1e-8, 1e-12}) {
        Scene scene = make_many();
        scene.nodes[0].transform.scale = glm::dvec3(scale);
        const Stage stage(scene);
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
        const glm::vec3 beside = glm::vec3(1e-6f, 0.0f, 0.0f) - glm::vec3(stage.shading.anchor);
        EXPECT_NE(Tracer(stage.rays).intersect({beside, {0.0f, 0.0f, -1.0f}}).instance, 0) << scale;
    }
}

TEST(RayScene, KF19_ALargeMeshAtATinyScaleIsMet) {
    // A box of 1e9 m at a scale of 1e-9: 1 m in the world.
    for (const bool moves : {false, true}) {
        Scene scene;
        scene.meshes = {make_shape_mesh({.kind = Shape::Kind::box, .size = glm::dvec3(1e9)})};
        scene.nodes.resize(1);
        scene.nodes[0].meshes = {0};
        scene.nodes[0].transform.scale = glm::dvec3(1e-9);
        if (moves)
            scene.nodes[0].transform.translation =
                Track<glm::dvec3>({0.0, 1.0}, {glm::dvec3(0.0), glm::dvec3(1.0, 0.0, 0.0)});
        RayScene rays(scene);
        rays.update(pose(scene, 0.0), glm::dvec3(0.0));
        const Hit hit = Tracer(rays).intersect({{0.2f, 0.1f, 5.0f}, {0.0f, 0.0f, -1.0f}});
        EXPECT_EQ(hit.instance, 0);
        EXPECT_NEAR(hit.distance, 4.5f, 1e-5f);
        EXPECT_EQ(Tracer(rays).intersect({{0.6f, 0.1f, 5.0f}, {0.0f, 0.0f, -1.0f}}).instance, no_index);
    }
}

TEST(RayScene, EmptySceneIsAllMisses) {
    const Stage stage(Scene{}, 8, 6);
    for (const Hit& hit : cast_first_hits(stage.rays, stage.view).pixels) EXPECT_EQ(hit, Hit{});
    EXPECT_EQ(stage.rays.rays_traced(), 48u);
}

TEST(FirstHits, OneRayThroughEveryPixelWhateverTheSize) {
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(5, 3), std::pair(33, 7)}) {
        Scene scene = make_many();
        add_camera(scene, {0.0, 0.0, 0.0}, {0.0, 0.0, -5.0}, 1.0);
        const Stage stage(std::move(scene), width, height);
        const Image<Hit> hits = cast_first_hits(stage.rays, stage.view, 0.25, 0.75);
        EXPECT_EQ(stage.rays.rays_traced(), static_cast<std::uint64_t>(width * height));
        Tracer tracer(stage.rays);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const CameraRay ray = make_camera_ray(stage.view, x + 0.25, y + 0.75);
                const Hit alone =
                    tracer.intersect({glm::vec3(ray.origin - stage.rays.anchor()), glm::vec3(ray.direction)});
                EXPECT_EQ(hits(x, y).instance, alone.instance);
                EXPECT_EQ(hits(x, y).primitive, alone.primitive);
            }
        }
    }
}

TEST(FirstHits, ACameraOnASurfaceSeesWhatIsBehindIt) {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.5));
    add_mesh(scene, make_quad(8.0, 8.0, white), {0.0, 1.1, 0.0}, z_to_up);
    add_mesh(scene, make_quad(8.0, 8.0, white), {0.0, 0.0, -3.0});
    add_camera(scene, {0.0, 1.1, 1.5}, {0.0, 1.1, 0.0}, 1.0);
    const Stage stage(std::move(scene), 32, 24);
    for (const Hit& hit : cast_first_hits(stage.rays, stage.view, 0.3, 0.7).pixels) EXPECT_EQ(hit.instance, 1);
}

}  // namespace
}  // namespace aleph
