// Blended surfaces as a share of the rays that they stop.

#include "engine/base/parallel.h"
#include "engine/rays/alpha_cutout.h"
#include "engine/rays/ray_scene.h"
#include "tests/engine/rays/ray_patterns.h"
#include "tests/support/scenes/deforming_scenes.h"
#include "tests/support/trial.h"

namespace aleph {
namespace {

constexpr std::size_t ray_count = 40'000;

/// Sheets of blended material behind one another, all of one mesh, in the planes z = 0, -1, -2, ...
Scene make_blended(double alpha, std::size_t layers) {
    Scene scene = make_sheet_scene(2);
    scene.materials.resize(1);
    scene.materials[0].opacity.mode = Opacity::Mode::blend;
    scene.materials[0].opacity.alpha = alpha;
    scene.meshes[0].material = 0;
    scene.nodes.resize(layers, scene.nodes[0]);
    for (std::size_t i = 0; i < layers; ++i)
        scene.nodes[i].transform.translation = glm::dvec3(0.0, 0.0, -static_cast<double>(i));
    return scene;
}

/// Rays downwards through random points of the sheets.
std::vector<Ray> make_layer_rays(std::size_t count = ray_count, std::uint32_t seed = 0) {
    std::mt19937 random(7 + seed);
    std::uniform_real_distribution<float> place(-0.95f, 0.95f);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        const float x = place(random), y = place(random);
        ray = ray_down(x, y);
    }
    return rays;
}

std::vector<Hit> cast(const RayScene& scene, const std::vector<Ray>& rays, Blend blend = Blend::random) {
    return trace(scene, rays, true, blend);
}

/// Hits on an instance; no_index: rays that miss.
double count_on(const std::vector<Hit>& hits, int instance) {
    return static_cast<double>(std::ranges::count(hits, instance, &Hit::instance));
}

double share_on(const std::vector<Hit>& hits, int instance) {
    return count_on(hits, instance) / static_cast<double>(hits.size());
}

std::vector<Ray> make_layer_rays(const Trial& trial) {
    return make_layer_rays(trial.times(ray_count), trial.seed);
}

TEST(AlphaBlend, StopsItsShareOfTheRays) {
    const std::vector<Ray> rays = make_layer_rays();
    for (const double alpha : {0.02, 0.3, 0.5, 0.97}) {
        const RayScene one = place(make_blended(alpha, 1));
        EXPECT_TRUE(holds([&](Trial& trial) {
            const std::vector<Hit> hits = cast(one, make_layer_rays(trial));
            trial.counts(count_on(hits, 0), static_cast<double>(hits.size()), alpha);
        }));
    }
    for (const double alpha : {0.0, 1.0}) {
        const RayScene one = place(make_blended(alpha, 1));
        EXPECT_EQ(share_on(cast(one, rays), 0), alpha);
    }
}

TEST(AlphaBlend, LayersAreIndependent) {
    constexpr double alpha = 0.3;
    const RayScene three = place(make_blended(alpha, 3));
    EXPECT_TRUE(holds([&](Trial& trial) {
        const std::vector<Hit> hits = cast(three, make_layer_rays(trial));
        const double all = static_cast<double>(hits.size());
        double passed = 1.0;
        for (int layer = 0; layer < 3; ++layer) {
            trial.counts(count_on(hits, layer), all, passed * alpha);
            passed *= 1.0 - alpha;
        }
        trial.counts(count_on(hits, no_index), all, passed);
    }));
}

TEST(AlphaBlend, CoincidentSurfacesAreIndependentToo) {
    // Two meshes of one node in one plane, and both sides of a folded sheet: triangles of one mesh.
    Scene scene = make_blended(0.3, 1);
    Mesh& mesh = scene.meshes[0];
    const std::size_t triangles = mesh.triangles.size();
    for (std::size_t t = 0; t < triangles; ++t) mesh.triangles.push_back(mesh.triangles[t]);
    scene.nodes[0].meshes = {0, 0};
    const RayScene placed = place(scene);
    const double open = std::pow(0.7, 4);
    EXPECT_TRUE(holds([&](Trial& trial) {
        const std::vector<Hit> hits = cast(placed, make_layer_rays(trial));
        trial.counts(count_on(hits, no_index), static_cast<double>(hits.size()), open);
    }));
}

/// Two layers, and behind them two in one plane, of which the second is folded: five triangles in the way of each ray.
Scene make_five_layers(double alpha) {
    Scene scene = make_blended(alpha, 3);
    scene.meshes.push_back(scene.meshes[0]);
    Mesh& folded = scene.meshes[1];
    for (std::size_t t = 0, count = folded.triangles.size(); t < count; ++t)
        folded.triangles.push_back(folded.triangles[t]);
    scene.nodes[2].meshes = {0, 1};
    return scene;
}

TEST(AlphaBlend, EvenNumbersOfRaysShowSurfacesByTheirShare) {
    const RayScene placed = place(make_five_layers(0.5));
    std::vector<Ray> rays(1024, ray_down(0.3f, 0.1f));
    for (std::size_t i = 0; i < rays.size(); ++i) rays[i].choice = (static_cast<float>(i) + 0.5f) / 1024.0f;
    for (const bool in_packets : {false, true}) {
        const std::vector<Hit> hits = trace(placed, rays, in_packets, Blend::random);
        for (const auto& [instance, count] : {std::pair(0, 512), {1, 256}, {2, 128}, {3, 96}, {no_index, 32}})
            EXPECT_EQ(count_on(hits, instance), count) << instance;
    }
}

TEST(AlphaBlend, RaysGoOnFromSurfaceToSurface) {
    const RayScene placed = place(make_five_layers(0.25));
    Tracer tracer(placed, Blend::whole);
    const auto list_met = [&](const Ray& ray) {
        std::vector<int> met;
        for (Met at = tracer.meet(ray); at.hit.instance != no_index; at = tracer.meet(ray, &at)) {
            EXPECT_EQ(at.alpha, 0.25f);
            met.push_back(at.hit.instance);
        }
        return met;
    };
    EXPECT_EQ(list_met(ray_down(0.3f, 0.1f)), (std::vector{0, 1, 2, 3, 3}));
    // On the edge between two triangles a sheet is met once, and a folded one too: which of its layers is which is
    // lost.
    EXPECT_EQ(list_met(ray_down(0.5f, 0.5f)), (std::vector{0, 1, 2, 3}));
}

TEST(AlphaBlend, ShadowsArePartial) {
    const RayScene two = place(make_blended(0.4, 2));
    EXPECT_TRUE(holds([&](Trial& trial) {
        const std::vector<Ray> rays = make_layer_rays(trial);
        const std::vector<std::uint8_t> blocked = find_blocked(two, rays, Blend::random);
        trial.counts(static_cast<double>(std::ranges::count(blocked, 0)), static_cast<double>(rays.size()), 0.36);
    }));
}

TEST(AlphaBlend, SharesOfLightHaveNoChance) {
    constexpr double alpha = 0.3;
    Scene scene = make_blended(alpha, 3);
    scene.nodes[1].transform.rotation = glm::dquat(std::cos(0.2), std::sin(0.2), 0.0, 0.0);
    scene.nodes[2].meshes = {0, 0};  // two in one plane
    scene.meshes.push_back(scene.meshes[0]);
    scene.meshes[1].material = no_index;
    scene.nodes.push_back(scene.nodes[2]);
    scene.nodes[3].meshes = {1};
    scene.nodes[3].transform.translation = glm::dvec3(-1.0, 0.0, -3.0);  // behind the left half
    const double left = std::pow(1.0 - alpha, 4);
    std::vector<Ray> rays = make_layer_rays(1000);
    for (Ray& ray : rays) ray.origin.y *= 0.5f;  // through the turned one, too
    for (const float edge : {-0.5f, -0.25f, 0.3f})
        rays.insert(rays.end(), {ray_down(edge, edge), ray_down(0.5f, 0.0f), ray_down(edge, 0.0f)});  // of triangles
    for (const Blend blend : {Blend::cutout, Blend::random}) {
        const RayScene placed = place(scene);
        Tracer tracer(placed, blend);
        for (const Ray& ray : rays) {
            const bool open = ray.origin.x > 0.0f;
            EXPECT_NEAR(tracer.transmittance(ray), open ? left : 0.0, 1e-6) << ray.origin.x << ' ' << ray.origin.y;
            EXPECT_NEAR(tracer.transmittance(ray, true), left, 1e-6);
            EXPECT_EQ(tracer.intersect_others(ray).instance == no_index, open);
        }
    }
    scene.materials[0].glass.transmission = 0.5;  // light passes what blending stops
    const RayScene glass = place(scene);
    Tracer tracer(glass);
    EXPECT_EQ(tracer.transmittance(rays[0], true), 1.0f);
    EXPECT_EQ(tracer.intersect_others(rays[0]), tracer.intersect(rays[0]));
}

TEST(AlphaBlend, NearlyEqualRaysAreIndependent) {
    const RayScene one = place(make_blended(0.5, 1));
    EXPECT_TRUE(holds([&](Trial& trial) {
        std::vector<Ray> rays(trial.times(ray_count));
        for (std::size_t i = 0; i < rays.size(); ++i) {  // neighbouring floats, in direction and in origin
            rays[i].origin = {0.25f, 0.25f, 5.0f};
            rays[i].direction = {0.0f, 0.0f, -1.0f};
            rays[i].direction.x = 1e-3f + static_cast<float>(i / 2 + trial.seed % 1000) * 1e-9f;
            if (i % 2 == 1) rays[i].origin.y = std::nextafter(0.25f, 1.0f);
        }
        const std::vector<Hit> hits = cast(one, rays);
        const double all = static_cast<double>(rays.size());
        trial.counts(count_on(hits, 0), all, 0.5);
        std::size_t alike = 0;
        for (std::size_t i = 0; i < rays.size(); i += 2) alike += hits[i].instance == hits[i + 1].instance;
        trial.counts(static_cast<double>(alike), all / 2.0, 0.5);
    }));
}

TEST(AlphaBlend, TextureVertexColourAndFactorMultiply) {
    Scene scene = make_blended(0.8, 1);
    SceneImage image{.bytes = Image<glm::u8vec4>(2, 1, glm::u8vec4(255))};
    image.bytes(0, 0).w = 51;  // .2 on the left, 1 on the right
    scene.images = {image};
    scene.materials[0].textures[TextureSlot::base_color].image = 0;
    scene.materials[0].textures[TextureSlot::base_color].nearest = true;
    Mesh& mesh = scene.meshes[0];
    for (const glm::vec3& p : mesh.positions) mesh.uv[0].emplace_back(0.5f * (p.x + 1.0f), 0.5f * (1.0f - p.y));
    mesh.colors.assign(mesh.positions.size(), glm::vec4(1.0f, 1.0f, 1.0f, 0.5f));
    const RayScene placed = place(scene);
    EXPECT_TRUE(holds([&](Trial& trial) {
        const std::vector<Ray> rays = make_layer_rays(trial);
        const std::vector<Hit> hits = cast(placed, rays);
        for (const bool right : {false, true}) {
            std::size_t count = 0, met = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                if ((rays[i].origin.x > 0.0f) != right) continue;
                ++count;
                met += hits[i].instance == 0;
            }
            trial.counts(static_cast<double>(met), static_cast<double>(count), right ? 0.4 : 0.08);
        }
    }));
}

TEST(AlphaBlend, OneRayHasOneAnswer) {
    // Alone, in packets of any kind and place, on any thread, twice; for first hits and for occlusion.
    Scene scene = make_blended(0.5, 3);
    scene.nodes[1].transform.rotation = glm::dquat(std::cos(0.2), std::sin(0.2), 0.0, 0.0);
    scene.nodes[1].transform.scale = glm::dvec3(1.3, 0.7, 2.0);
    const RayScene placed = place(scene);
    const std::vector<Ray> rays = make_layer_rays(4001);
    const std::vector<Hit> hits = cast(placed, rays);
    EXPECT_EQ(cast(placed, rays), hits);
    const std::vector<Ray> rest(rays.begin() + 3, rays.end());
    const std::vector<Hit> shifted = cast(placed, rest);
    const std::vector<std::uint8_t> blocked = find_blocked(placed, rays, Blend::random);
    Tracer tracer(placed, Blend::random);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Hit alone = tracer.intersect(rays[i]);
        ASSERT_EQ(hits[i].instance, alone.instance) << i;
        ASSERT_EQ(hits[i].primitive, alone.primitive) << i;
        if (i >= 3) {
            ASSERT_EQ(shifted[i - 3].instance, alone.instance) << i;
        }
        ASSERT_EQ(blocked[i] != 0, alone.instance != no_index) << i;
    }
    for (const int threads : {1, 2, 3}) {
        const ThreadLimit limit(threads);
        std::vector<Hit> parallel(rays.size());
        parallel_for(rays.size(), 100, [&](std::size_t begin, std::size_t end) {
            Tracer mine(placed, Blend::random);
            mine.intersect(std::span(rays).subspan(begin, end - begin),
                           std::span(parallel).subspan(begin, end - begin));
        });
        for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_EQ(parallel[i].instance, hits[i].instance) << i;
    }
}

TEST(AlphaBlend, CutoutsAndMasksAreNotRandom) {
    const std::vector<Ray> rays = make_layer_rays(1000);
    for (const auto& [alpha, met] : {std::pair(0.49, 0.0), std::pair(0.51, 1.0)}) {
        Scene scene = make_blended(alpha, 2);
        EXPECT_EQ(share_on(cast(place(scene), rays, Blend::cutout), 0), met);
        scene.materials.push_back(scene.materials[0]);  // a mask beside a blended surface
        scene.materials[0].opacity.mode = Opacity::Mode::mask;
        scene.meshes.push_back(scene.meshes[0]);
        scene.meshes[1].material = 1;
        scene.nodes[1].meshes = {1};
        const RayScene placed = place(scene);
        EXPECT_EQ(share_on(cast(placed, rays), 0), met);
        EXPECT_EQ(share_on(cast(placed, rays, Blend::cutout), 0), met);
    }
}

TEST(AlphaBlend, OnlySurfacesThatLetRaysPassCount) {
    Scene scene = make_blended(1.0, 1);
    EXPECT_FALSE(has_blended(scene));
    EXPECT_FALSE(has_cutout(scene, scene.meshes[0]));
    scene.materials[0].opacity.alpha = Track<double>({0.0, 1.0}, {1.0, 0.5});
    EXPECT_TRUE(has_blended(scene));
    scene.nodes[0].meshes.clear();  // not drawn
    EXPECT_FALSE(has_blended(scene));
    scene = make_blended(1.0, 1);
    scene.meshes[0].colors.assign(9, glm::vec4(1.0f));
    EXPECT_FALSE(has_blended(scene));
    scene.meshes[0].colors[4].w = 0.5f;
    EXPECT_TRUE(has_blended(scene));
    scene = make_blended(1.0, 1);
    scene.images.resize(1);
    scene.images[0].floats = Image<glm::vec4>(2, 2, glm::vec4(1.0f));
    scene.materials[0].textures[TextureSlot::base_color].image = 0;
    EXPECT_FALSE(has_blended(scene));
    scene.images[0].floats(1, 1).w = 0.9f;
    EXPECT_TRUE(has_blended(scene));
    scene.materials[0].opacity.mode = Opacity::Mode::mask;
    EXPECT_FALSE(has_blended(scene));
    EXPECT_TRUE(has_cutout(scene, scene.meshes[0]));
    scene = make_blended(1.0, 1);
    scene.materials[0].opacity.mode = Opacity::Mode::mask;
    EXPECT_FALSE(has_cutout(scene, scene.meshes[0]));
    scene.materials[0].opacity.cutoff = 1.1;  // nothing is there
    EXPECT_TRUE(has_cutout(scene, scene.meshes[0]));
}

}  // namespace
}  // namespace aleph
