// Alpha masks: rays pass through the holes, first hits and shadows alike.

#include "engine/rays/alpha_cutout.h"
#include "engine/rays/ray_scene.h"
#include "tests/engine/rays/ray_patterns.h"
#include "tests/support/scenes/deforming_scenes.h"

namespace aleph {
namespace {

/// Two by two texels: only the left column is opaque.
Scene make_masked_scene(Opacity::Mode mode) {
    Scene scene = make_sheet_scene(1);
    SceneImage image{.bytes = Image<glm::u8vec4>(2, 2, glm::u8vec4(255))};
    image.bytes(1, 0).w = image.bytes(1, 1).w = 0;
    scene.images = {image};
    scene.materials.resize(1);
    scene.materials[0].opacity.mode = mode;
    scene.materials[0].textures[TextureSlot::base_color].image = 0;
    scene.materials[0].textures[TextureSlot::base_color].nearest = true;
    Mesh& mesh = scene.meshes[0];
    mesh.material = 0;
    for (const glm::vec3& p : mesh.positions) mesh.uv[0].emplace_back(0.5f * (p.x + 1.0f), 0.5f * (1.0f - p.y));
    return scene;
}

bool is_met(const RayScene& scene, float x, float y) {
    return instance_at(scene, x, y) != no_index;
}

TEST(AlphaCutout, RaysPassThroughHoles) {
    for (const Opacity::Mode mode : {Opacity::Mode::mask, Opacity::Mode::blend, Opacity::Mode::opaque}) {
        const Scene scene = make_masked_scene(mode);
        RayScene rays = place(scene);
        EXPECT_TRUE(is_met(rays, -0.5f, 0.3f));
        EXPECT_EQ(is_met(rays, 0.5f, 0.3f), mode == Opacity::Mode::opaque);
        EXPECT_EQ(is_met(rays, 0.3f, -0.9f), mode == Opacity::Mode::opaque);
    }
}

TEST(AlphaCutout, WhatLiesBehindAHoleIsMet) {
    Scene scene = make_masked_scene(Opacity::Mode::mask);
    scene.meshes.push_back(make_sheet(1));
    scene.nodes.resize(2);
    scene.nodes[1].meshes = {1};
    scene.nodes[1].transform.translation = glm::dvec3(0.0, 0.0, -1.0);
    RayScene rays = place(scene);
    EXPECT_EQ(Tracer(rays).intersect(ray_down(-0.5f, 0.25f)).instance, 0);
    const Hit behind = Tracer(rays).intersect(ray_down(0.5f, 0.25f));
    EXPECT_EQ(behind.instance, 1);
    EXPECT_FLOAT_EQ(behind.distance, 6.0f);
}

TEST(AlphaCutout, FactorVertexColourAndCutoffCount) {
    Scene scene = make_masked_scene(Opacity::Mode::mask);
    scene.materials[0].opacity.alpha = Track<double>({0.0, 1.0}, {1.0, 0.0});
    scene.materials[0].opacity.cutoff = 0.25;
    RayScene rays(scene);
    for (const auto& [seconds, met] : {std::pair(0.0, true), {0.7, true}, {0.8, false}, {0.1, true}}) {
        rays.update(pose(scene, seconds), glm::dvec3(0.0));
        EXPECT_EQ(is_met(rays, -0.5f, 0.3f), met) << seconds;
    }
    scene.materials[0].opacity.alpha = 1.0;
    scene.meshes[0].colors.assign(4, glm::vec4(1.0f, 1.0f, 1.0f, 0.2f));
    EXPECT_FALSE(is_met(place(scene), -0.5f, 0.3f));
}

TEST(AlphaCutout, HolesMoveWithADeformingMesh) {
    Scene scene = make_masked_scene(Opacity::Mode::mask);
    add_cache(scene, 0, {0.0, 1.0}, [](const glm::vec3& p, std::size_t sample) {
        return p + glm::vec3(sample == 1 ? 1.0f : 0.0f, 0.0f, 0.0f);
    });
    RayScene rays = place(scene);
    EXPECT_FALSE(is_met(rays, 0.5f, 0.3f));
    rays.update(pose(scene, 1.0), glm::dvec3(0.0));
    EXPECT_TRUE(is_met(rays, 0.5f, 0.3f));
    EXPECT_FALSE(is_met(rays, 1.5f, 0.3f));
}

TEST(AlphaCutout, TexturesAreReadAsTheirReferenceSays) {
    Scene scene = make_masked_scene(Opacity::Mode::mask);
    TextureRef reference = scene.materials[0].textures[TextureSlot::base_color];
    const auto at = [&](float u, float v) { return make_alpha_texture(scene, reference).sample({u, v}); };
    EXPECT_EQ(at(0.25f, 0.5f), 1.0f);
    EXPECT_EQ(at(0.75f, 0.5f), 0.0f);
    EXPECT_EQ(at(1.25f, 0.5f), 1.0f);  // repeated
    EXPECT_EQ(at(-0.25f, 0.5f), 0.0f);
    reference.wrap_u = Wrap::clamp;
    EXPECT_EQ(at(1.25f, 0.5f), 0.0f);
    EXPECT_EQ(at(-0.25f, 0.5f), 1.0f);
    reference.wrap_u = Wrap::mirror;
    EXPECT_EQ(at(1.25f, 0.5f), 0.0f);
    EXPECT_EQ(at(1.75f, 0.5f), 1.0f);
    reference.nearest = false;
    reference.wrap_u = Wrap::clamp;
    EXPECT_FLOAT_EQ(at(0.5f, 0.5f), 0.5f);
    EXPECT_FLOAT_EQ(at(0.375f, 0.1f), 0.75f);
    reference.uv_rotation = 0.5 * std::numbers::pi;  // u of the texture is v of the mesh
    EXPECT_FLOAT_EQ(at(0.9f, 0.25f), 1.0f);
    EXPECT_FLOAT_EQ(at(0.9f, 0.75f), 0.0f);
    reference.uv_offset = {0.5, 0.0};
    EXPECT_FLOAT_EQ(at(0.9f, 0.25f), 0.0f);
    reference = scene.materials[0].textures[TextureSlot::base_color];
    EXPECT_EQ(at(float_nan, 0.0f), at(0.0f, 0.0f));
}

/// KHR_texture_transform: scaled, then turned, then moved.
TEST(AlphaCutout, TexturesAreTransformed) {
    Scene scene = make_masked_scene(Opacity::Mode::mask);
    scene.images[0].bytes = Image<glm::u8vec4>(5, 3, glm::u8vec4(255));
    for (int i = 0; i < 15; ++i) scene.images[0].bytes(i % 5, i / 5).w = static_cast<std::uint8_t>(37 * i % 256);
    TextureRef plain = scene.materials[0].textures[TextureSlot::base_color];
    plain.nearest = false;
    TextureRef moved = plain;
    moved.uv_rotation = 0.4;
    moved.uv_scale = {1.5, 0.7};
    moved.uv_offset = {0.1, -0.2};
    const AlphaTexture before = make_alpha_texture(scene, plain), after = make_alpha_texture(scene, moved);
    for (const glm::dvec2& uv : {glm::dvec2(0.2, 0.3), {0.9, 0.1}, {0.4, 0.8}, {-0.6, 1.7}}) {
        const double u = 1.5 * uv.x, v = 0.7 * uv.y;
        const glm::vec2 there(0.1 + std::cos(0.4) * u + std::sin(0.4) * v,
                              -0.2 + std::cos(0.4) * v - std::sin(0.4) * u);
        EXPECT_NEAR(after.sample(glm::vec2(uv)), before.sample(there), 1e-5f);
    }
}

}  // namespace
}  // namespace aleph
