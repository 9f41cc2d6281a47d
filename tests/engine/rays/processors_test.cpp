// RC-15: on processors of other kinds rays meet the same triangles at the same places, to the last bit.

#include "engine/rays/state.h"
#include "engine/surface/shapes.h"
#include "tests/engine/rays/ray_patterns.h"

namespace aleph {
namespace {

/// A sphere, a torus and a floor, which lets rays pass by an alpha mask.
Scene make_scene(bool turned) {
    Scene scene;
    Shape sphere, torus, floor;
    sphere.kind = Shape::Kind::sphere;
    torus.kind = Shape::Kind::torus;
    floor.kind = Shape::Kind::quad;
    floor.size = {8.0, 8.0, 1.0};
    scene.materials.resize(1);
    scene.materials[0].opacity.mode = Opacity::Mode::mask;
    scene.meshes = {make_shape_mesh(sphere), make_shape_mesh(torus), make_shape_mesh(floor, 0)};
    Mesh& holed = scene.meshes[2];
    for (std::size_t i = 0; i < holed.positions.size(); ++i)
        holed.colors.emplace_back(1.0f, 1.0f, 1.0f, i % 2 == 0 ? 1.0f : 0.0f);
    scene.nodes.resize(3);
    for (int i = 0; i < 3; ++i) scene.nodes[i].meshes = {i};
    scene.nodes[2].transform.translation = glm::dvec3(0.0, 0.0, -2.0);
    if (!turned) return scene;
    scene.nodes[1].transform.rotation = glm::angleAxis(0.9, glm::normalize(glm::dvec3(1.0, 2.0, -1.0)));
    scene.nodes[1].transform.scale = glm::dvec3(1.5, 0.7, 2.0);
    return scene;
}

/// From outside: next to a surface, a distance is a difference of larger numbers.
std::vector<Ray> make_rays() {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> number(-1.0f, 1.0f);
    std::vector<Ray> rays(30'000);
    for (Ray& ray : rays) {
        ray.origin = {6.0f * number(random), 6.0f * number(random), number(random) < 0.0f ? 6.0f : -6.0f};
        ray.direction = 2.0f * glm::vec3(number(random), number(random), number(random)) - ray.origin;
    }
    return rays;
}

struct Answers {
    std::vector<Hit> packets, single;
    std::vector<std::uint8_t> blocked;

    bool operator==(const Answers&) const = default;
};

/// @param configuration  Embree takes the best that this processor has, up to the kind named; null: the best
Answers ask(const Scene& scene, const std::vector<Ray>& rays, const char* configuration) {
    RayScene placed = make_ray_scene(scene, std::make_unique<EmbreeDevice>(configuration));
    placed.update(pose(scene, 0.0), glm::dvec3(0.0));
    return {trace(placed, rays), trace(placed, rays, false), find_blocked(placed, rays)};
}

TEST(Processors, RC15_AllBitsOfHitsAreTheSame) {
    for (const bool turned : {false, true}) {
        const Scene scene = make_scene(turned);
        const std::vector<Ray> rays = make_rays();
        const Answers own = ask(scene, rays, nullptr);
        EXPECT_TRUE(own.packets == own.single);
        for (const char* configuration : {"isa=sse2", "isa=sse4.2", "isa=avx", "isa=avx2"})
            EXPECT_TRUE(ask(scene, rays, configuration) == own) << configuration;
    }
}

}  // namespace
}  // namespace aleph
