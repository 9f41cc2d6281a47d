// Surface materials from glTF materials: unlit, Lambert, dielectric and metal; vertex colours, textures, emission.

#include <gtest/gtest.h>

#include "render/surface/bsdf.h"
#include "tests/support/lobes.h"
#include "tests/support/render_scenes.h"

namespace aleph {
namespace {

/// KHR_materials_unlit: a constant base colour; all other properties are ignored.
TEST(SurfaceMaterial, UnlitShowsItsBaseColourAndReflectsNothing) {
    Material material;
    material.unlit = true;
    material.base_color = glm::dvec3(0.5, 0.25, 0.75);
    material.emission = glm::dvec3(9.0);
    material.metallic = 0.5;
    for (const bool front : {true, false}) {
        const SurfaceMaterial surface = evaluate_plain(material, front, {0.5f, 1.0f, 1.0f, 1.0f});
        EXPECT_EQ(surface.emission, Rgb(0.25f, 0.25f, 0.75f));
        EXPECT_FALSE(surface.has_diffuse());
        EXPECT_FALSE(surface.has_glossy());
    }
}

TEST(SurfaceMaterial, SpecularZeroIsPureLambert) {
    Material material;
    material.base_color = glm::dvec3(0.2, 0.5, 0.8);
    material.metallic = 0.0;
    material.specular = 0.0;
    const SurfaceMaterial surface = evaluate_plain(material);
    EXPECT_FALSE(surface.has_glossy());
    EXPECT_EQ(surface.diffuse, Rgb(0.2f, 0.5f, 0.8f));
    for (const float cosine : {1.0f, 0.9f, 0.5f, 0.2f, 0.05f}) {
        EXPECT_EQ(evaluate_diffuse(surface, cosine, 0.3f).y, 0.5f / std::numbers::pi_v<float>);
        EXPECT_NEAR(diffuse_radiance(surface, cosine, Rgb(std::numbers::pi_v<float>)).z, 0.8f, 1e-6f);
    }
}

TEST(SurfaceMaterial, GltfNumbersBecomeTheTwoLayers) {
    Material plastic;
    plastic.base_color = glm::dvec3(0.5);
    plastic.metallic = 0.0;
    plastic.roughness = 0.5;
    SurfaceMaterial surface = evaluate_plain(plastic);
    EXPECT_NEAR(surface.f0.x, 0.04f, 1e-6f);  // index 1.5
    EXPECT_EQ(surface.f90, 1.0f);
    EXPECT_EQ(surface.alpha, 0.25f);
    EXPECT_EQ(surface.diffuse.x, 0.5f);

    Material metal;
    metal.base_color = glm::dvec3(0.9, 0.6, 0.2);
    metal.roughness = 0.0;
    surface = evaluate_plain(metal);
    EXPECT_EQ(surface.f0, Rgb(0.9f, 0.6f, 0.2f));
    EXPECT_FALSE(surface.has_diffuse());
    EXPECT_EQ(surface.alpha, 0.0f);
    EXPECT_TRUE(surface.is_mirror());

    plastic.specular_color = glm::dvec3(2.0, 1.0, 0.5);  // above 1 is allowed, F0 stays at most 1
    plastic.ior = 2.0;
    surface = evaluate_plain(plastic);
    EXPECT_NEAR(surface.f0.x, 2.0f / 9.0f, 1e-6f);
    EXPECT_NEAR(surface.f0.z, 0.5f / 9.0f, 1e-6f);
    EXPECT_NEAR(surface.f0_max, 2.0f / 9.0f, 1e-6f);

    surface = evaluate_plain(metal, true, {0.5f, 1.0f, 1.0f, 1.0f});
    EXPECT_NEAR(surface.f0.x, 0.45f, 1e-6f);  // vertex colours multiply
}

TEST(SurfaceMaterial, EmissionLeavesTheFrontAndBothSidesIfDoubleSided) {
    Material lamp;
    lamp.emission = glm::dvec3(1.0, 2.0, 3.0);
    lamp.emission_strength = 2.0;
    EXPECT_EQ(evaluate_plain(lamp, true).emission, Rgb(2.0f, 4.0f, 6.0f));
    EXPECT_EQ(evaluate_plain(lamp, false).emission, Rgb(0.0f));
    lamp.double_sided = true;
    EXPECT_EQ(evaluate_plain(lamp, false).emission, Rgb(2.0f, 4.0f, 6.0f));
}

TEST(SurfaceMaterial, TexturesMultiplyTheFactors) {
    Scene scene;
    SceneImage image;
    image.bytes = Image<glm::u8vec4>(1, 1, glm::u8vec4(255, 128, 51, 0));
    scene.images.push_back(image);
    Material material;
    material.base_color_texture.image = material.metallic_roughness_texture.image = 0;
    material.emission_texture.image = material.specular_texture.image = 0;
    material.emission = glm::dvec3(10.0);
    scene.materials.push_back(material);
    add_mesh(scene, make_quad(1.0, 1.0, 0));
    const Stage stage(std::move(scene));
    SurfacePoint point = make_point(glm::vec3(0.0f), {0.0f, 0.0f, 1.0f});
    point.material = 0;
    const SurfaceMaterial surface = evaluate_material(stage.shading, point, {});
    const float rough = 128.0f / 255.0f, metal = 51.0f / 255.0f, green = srgb_to_linear(128.0f / 255.0f);
    EXPECT_NEAR(surface.alpha, rough * rough, 1e-6f);
    EXPECT_NEAR(surface.diffuse.y, green * (1.0f - metal), 1e-6f);
    EXPECT_NEAR(surface.f0.x, metal, 1e-6f);  // specular 0 by the texture's A: only the metal's share is left
    EXPECT_NEAR(surface.f90, metal, 1e-6f);
    EXPECT_NEAR(surface.emission.y, 10.0f * green, 1e-5f);
}

}  // namespace
}  // namespace aleph
