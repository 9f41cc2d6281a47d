// Lamps of one mesh share their triangles: each is as one whose mesh has its transform already.

#include "engine/scene/transforms.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

struct Placed {
    glm::dvec3 translation, scale;
    glm::dquat rotation;
};

const std::vector<Placed> places{
    {{0.0, 0.0, 0.0}, glm::dvec3(1.0), glm::dquat(1.0, 0.0, 0.0, 0.0)},
    {{2.0, -1.0, 0.5}, glm::dvec3(0.3), glm::angleAxis(0.8, glm::normalize(glm::dvec3(1.0, 2.0, 3.0)))},
    {{-3.0, 0.4, 1.0}, {-2.0, 2.0, 2.0}, glm::angleAxis(-1.1, glm::dvec3(0.0, 1.0, 0.0))},  // mirrored
    {{0.0, 3.0, 0.0}, {1.0, 0.4, 1.7}, glm::angleAxis(0.5, glm::dvec3(0.0, 0.0, 1.0))},     // uneven
    {{0.0, 3.0, -3.0}, glm::dvec3(0.3), glm::angleAxis(2.0, glm::dvec3(1.0, 0.0, 0.0))}};

Mesh make_lamp_mesh(bool few) {
    return few ? make_quad(1.0, 0.7, 0) : make_faceted_sphere(0.5, 12, 0);
}

Scene make_lamps(bool few, bool double_sided) {
    Scene scene;
    scene.environment.radiance.reset();
    add_lambert(scene, glm::dvec3(0.0), glm::dvec3(2.0), double_sided);
    for (const Placed& at : places) {
        const int node = add_mesh(scene, make_lamp_mesh(few), at.translation, at.rotation);
        scene.nodes[node].transform.scale = at.scale;
        scene.nodes[node].meshes = {0};
    }
    return scene;
}

/// The same lamp, its vertices where the transform puts them.
Scene bake(const Placed& at, bool few, bool double_sided) {
    Scene scene;
    scene.environment.radiance.reset();
    add_lambert(scene, glm::dvec3(0.0), glm::dvec3(2.0), double_sided);
    Mesh mesh = make_lamp_mesh(few);
    for (glm::vec3& p : mesh.positions) p = at.rotation * (at.scale * glm::dvec3(p)) + at.translation;
    for (glm::vec3& n : mesh.normals) n = at.rotation * (glm::dvec3(n) / at.scale);
    if (at.scale.x < 0.0)
        for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    add_mesh(scene, mesh);
    return scene;
}

/// From places around a lamp, rays that meet it have the density of its samples, and these show as large a solid angle.
/// @param alone  the same lamp as a mesh in place
/// @return rays
int compare_samples(const Stage& stage, int light, const Stage& alone) {
    const Emitter& lamp = stage.lights.emitters[light];
    RandomStream random({7, static_cast<std::uint32_t>(light), 0, 0});
    Tracer tracer(alone.rays);
    int met = 0, others = 0;
    double seen = 0.0, seen_alone = 0.0;
    for (int k = 0; k < 4000; ++k) {
        const glm::vec3 away = glm::normalize(glm::vec3(random.next(), random.next(), random.next()) - 0.5f);
        const Receiver receiver{lamp.center + (1.2f + 4.0f * random.next()) * lamp.radius * away, up};
        const glm::vec2 u = random.next_2d();
        const LightSample sample = sample_light(stage.shading, stage.lights, light, receiver, u),
                          other = sample_light(alone.shading, alone.lights, 0, receiver, u);
        if (other.pdf > 0.0f) seen_alone += 1.0 / other.pdf;
        if (!(sample.pdf > 0.0f)) continue;
        seen += 1.0 / sample.pdf;
        const Hit hit = tracer.intersect({receiver.position, sample.direction});
        if (hit.instance == no_index || std::abs(hit.distance - sample.distance) > 1e-3f * hit.distance) continue;
        const SurfacePoint point = make_surface_point(alone.shading, hit, sample.direction);
        const float cosine = std::abs(glm::dot(point.geometric, sample.direction));
        const float pdf = pdf_emitter(lamp, receiver.position, hit, cosine, hit.distance);
        others += std::abs(pdf / sample.pdf - 1.0f) > 2e-3f;  // at an edge, the triangle beside it
        ++met;
    }
    EXPECT_LE(others, met / 200) << light;
    EXPECT_NEAR(seen / seen_alone, 1.0, 0.05) << light;
    return met;
}

TEST(EmitterShape, LampsAreAsIfTheirMeshWereInPlace) {
    for (const bool few : {false, true}) {
        for (const bool double_sided : {false, true}) {
            const Stage stage(make_lamps(few, double_sided));
            ASSERT_EQ(stage.lights.emitters.size(), places.size());
            for (std::size_t i = 0; i < places.size(); ++i) {
                const Stage alone(bake(places[i], few, double_sided));
                const Emitter &lamp = stage.lights.emitters[i], &baked = alone.lights.emitters[0];
                EXPECT_NEAR(lamp.area / baked.area, 1.0, 1e-5);
                EXPECT_NEAR(lamp.radius / baked.radius, 1.0, 1e-5);
                EXPECT_LT(glm::distance(lamp.center, baked.center), 1e-5f);
                ASSERT_EQ(lamp.size(), baked.size());
                const LightNode node = make_light_nodes(stage.shading, stage.lights)[i],
                                baked_node = make_light_nodes(alone.shading, alone.lights)[0];
                EXPECT_NEAR(node.cos_cone, baked_node.cos_cone, 1e-4);
                EXPECT_GT(compare_samples(stage, static_cast<int>(i), alone), 800) << i << few << double_sided;
            }
        }
    }
}

TEST(EmitterShape, OneShapeServesAllThatAreTurnedAndScaledEvenly) {
    const Stage stage(make_lamps(false, false));
    const std::vector<Emitter>& lamps = stage.lights.emitters;
    EXPECT_EQ(lamps[0].shape, lamps[1].shape);
    EXPECT_EQ(lamps[0].shape, lamps[2].shape) << "mirrored";
    EXPECT_NE(lamps[0].shape, lamps[3].shape) << "uneven";
    EXPECT_TRUE(lamps[4].shape->origin == lamps[0].shape->origin);
}

TEST(EmitterShape, SetsOfOtherTimesSaveWorkAndChangeNothing) {
    const Stage stage(make_lamps(false, false));
    const LightSet again = make_light_set(stage.shading, stage.lights), anew = make_light_set(stage.shading);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Emitter &a = again.emitters[i], &b = anew.emitters[i];
        EXPECT_EQ(a.shape, stage.lights.emitters[i].shape);
        EXPECT_EQ(a.shape->cumulative, b.shape->cumulative);
        EXPECT_EQ(a.center, b.center);
        EXPECT_EQ(a.area, b.area);
        EXPECT_EQ(a.turn, b.turn);
    }
    // Of a time when a lamp had another transform, another shape.
    ShadingScene later = stage.shading;
    later.instances[3].linear[1] *= 1.25f;
    later.instances[4].linear *= 2.0f;
    const LightSet after = make_light_set(later, stage.lights);
    EXPECT_EQ(after.emitters[2].shape, stage.lights.emitters[2].shape);
    EXPECT_NE(after.emitters[3].shape, stage.lights.emitters[3].shape);
    EXPECT_GT(after.emitters[3].area, 1.05f * stage.lights.emitters[3].area);
    EXPECT_EQ(after.emitters[4].shape, stage.lights.emitters[4].shape);
    EXPECT_EQ(after.emitters[4].area, 4.0f * stage.lights.emitters[4].area);
}

TEST(InstanceBounds, HoldTheVerticesAndAreExactForBalls) {
    Scene scene = make_lamps(false, false);
    for (Node& node : scene.nodes) {
        // What moves is bounded by its mesh's bounds.
        const glm::dvec3 at = key_value(node.transform.translation, 0);
        node.transform.translation = Track<glm::dvec3>({0.0, 1.0}, {at, at + glm::dvec3(1.0, 0.0, 0.0)});
    }
    const Stage stage(std::move(scene));
    for (std::size_t i = 0; i < places.size(); ++i) {
        const PosedInstance& instance = stage.shading.instances[i];
        ASSERT_FALSE(instance.flat);
        const MeshBounds bounds = find_bounds(instance);
        float farthest = 0.0f, area = 0.0f;
        for (std::uint32_t v = 0; v < instance.mesh->positions.size(); ++v) {
            const glm::vec3 p = instance.place(v);
            farthest = std::max(farthest, glm::distance(p, bounds.sphere.center));
            EXPECT_TRUE(glm::all(glm::greaterThan(p, bounds.box.low - 1e-5f)) &&
                        glm::all(glm::lessThan(p, bounds.box.high + 1e-5f)));
        }
        for (const glm::uvec3& t : instance.mesh->triangles) {
            const glm::vec3 corner = instance.place(t.x);
            area += 0.5f * glm::length(glm::cross(instance.place(t.y) - corner, instance.place(t.z) - corner));
        }
        EXPECT_GE(bounds.sphere.radius, farthest * (1.0f - 1e-5f));
        EXPECT_LE(bounds.area, area * (1.0f + 1e-4f));
        if (i == 3) continue;  // uneven
        EXPECT_LE(bounds.sphere.radius, farthest * (1.0f + 1e-5f));
        EXPECT_GE(bounds.area, area * (1.0f - 1e-4f));
        const glm::vec3 size = bounds.box.high - bounds.box.low;
        EXPECT_LE(std::max({size.x, size.y, size.z}), 2.0f * farthest * (1.0f + 1e-5f)) << "of a ball";
    }
}

}  // namespace
}  // namespace aleph
