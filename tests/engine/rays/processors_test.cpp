// RC-15: on processors of other kinds rays meet the same triangles at the same places, to the last bit.

#include "engine/rays/state.h"
#include "engine/surface/shapes.h"
#include "tests/engine/rays/ray_patterns.h"
#include "tests/support/test.h"

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
    std::vector<Hit> packets, coherent, single;
    std::vector<std::uint8_t> blocked, blocked_single;
};

/// @param configuration  null: this processor's own
Answers trace(const Scene& scene, const std::vector<Ray>& rays, const char* configuration) {
    RayScene placed = make_ray_scene(scene, std::make_unique<EmbreeDevice>(configuration));
    placed.update(pose(scene, 0.0), glm::dvec3(0.0));
    Tracer tracer(placed);
    Answers answers;
    for (std::vector<Hit>* hits : {&answers.packets, &answers.coherent, &answers.single}) hits->resize(rays.size());
    for (std::vector<std::uint8_t>* b : {&answers.blocked, &answers.blocked_single}) b->resize(rays.size());
    tracer.intersect(rays, answers.packets, false);
    tracer.intersect(rays, answers.coherent, true);
    tracer.occluded(rays, answers.blocked);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        answers.single[i] = tracer.intersect(rays[i]);
        answers.blocked_single[i] = tracer.occluded(rays[i]);
    }
    return answers;
}

/// @param configuration  Embree takes the best that this processor has, up to the kind named
void expect_same_on(const char* configuration, const Scene& scene, const Answers& own) {
    const Answers other = trace(scene, make_rays(), configuration);
    for (const std::vector<Hit>* hits : {&other.packets, &other.coherent, &other.single})
        EXPECT_TRUE(*hits == own.packets);
    EXPECT_EQ(other.blocked, own.blocked);
    EXPECT_EQ(other.blocked_single, own.blocked);
}

TEST(Processors, RC15_AllBitsOfHitsAreTheSame) {
    for (const bool turned : {false, true}) {
        const Scene scene = make_scene(turned);
        const Answers own = trace(scene, make_rays(), nullptr);
        for (const char* configuration : {"isa=sse2", "isa=sse4.2", "isa=avx", "isa=avx2"}) {
            SCOPED_TRACE(configuration);
            expect_same_on(configuration, scene, own);
        }
    }
}

}  // namespace
}  // namespace aleph
