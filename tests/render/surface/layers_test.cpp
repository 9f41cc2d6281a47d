// glTF's material extensions against the formulas of their specifications, in double, at a few directions.

#include <gtest/gtest.h>

#include "tests/support/lobes.h"
#include "tests/support/numbers.h"

namespace aleph {
namespace {

struct Directions {
    glm::dvec3 view, light;
    glm::dvec3 half() const { return glm::normalize(view + light); }
};

std::vector<Directions> some_directions() {
    return {{glm::dvec3(direction_of(0.9f, 0.2f)), glm::dvec3(direction_of(0.7f, 3.0f))},
            {glm::dvec3(direction_of(0.5f, 1.0f)), glm::dvec3(direction_of(0.4f, 4.5f))},
            {glm::dvec3(direction_of(0.2f, 5.0f)), glm::dvec3(direction_of(0.8f, 2.5f))}};
}

double schlick(double f0, double f90, double cosine) {
    return f0 + (f90 - f0) * std::pow(1.0 - cosine, 5.0);
}

/// D_GGX_anisotropic times V_GGX_anisotropic of KHR_materials_anisotropy, as printed there.
double anisotropic_lobe(double at, double ab, const Directions& d) {
    const glm::dvec3 h = d.half(), f(ab * h.x, at * h.y, at * ab * h.z);
    const double w2 = at * ab / glm::dot(f, f);
    const auto length = [&](const glm::dvec3& v) {
        return std::sqrt(at * at * v.x * v.x + ab * ab * v.y * v.y + v.z * v.z);
    };
    return at * ab * w2 * w2 / pi * 0.5 / (d.light.z * length(d.view) + d.view.z * length(d.light));
}

double scattered(const SurfaceMaterial& material, const Directions& d) {
    const ViewedSurface surface = make_viewed(material, glm::vec3(d.view));
    return scatter_towards(LitSurface(surface), glm::vec3(d.light), 0.0f, {}).x / std::abs(d.light.z);
}

void expect_equal(double found, double expected) {
    EXPECT_NEAR(found, expected, 2e-5 * expected);
}

TEST(Layers, AnisotropicLobe) {
    Material material;
    material.roughness = 0.5;
    material.base_color = glm::dvec3(0.8);
    SurfaceMaterial brushed = evaluate_plain(material);
    // strength 0.6 along x
    brushed.stretch = 0.36f;
    brushed.tangent = {1.0f, 0.0f, 0.0f};
    const double at = 0.25 * (1.0 - 0.36) + 0.36, ab = 0.25;
    for (const Directions& d : some_directions()) {
        const double fresnel = schlick(0.8, 1.0, glm::dot(d.view, d.half()));
        expect_equal(scattered(brushed, d), fresnel * anisotropic_lobe(at, ab, d));
    }
}

TEST(Layers, AnisotropyTurnsWithItsAngle) {
    // Unit texture coordinates on a unit quad, so that the tangent is x.
    for (const double angle : {0.0, 0.5, 2.0}) {
        Scene scene;
        Material material;
        material.anisotropy = 0.6;
        material.anisotropy_rotation = angle;
        scene.materials.push_back(material);
        add_mesh(scene, make_quad(1.0, 1.0, 0));
        const Stage stage(std::move(scene));
        SurfacePoint point = make_point(glm::vec3(0.0f), {0.0f, 0.0f, 1.0f});
        point.material = 0;
        point.edges[0] = {1.0f, 0.0f, 0.0f};
        point.edges[1] = {0.0f, 1.0f, 0.0f};
        point.uv_edges[0][0] = {1.0f, 0.0f};
        point.uv_edges[0][1] = {0.0f, -1.0f};  // glTF's v grows downwards
        const SurfaceMaterial surface = evaluate_material(stage.shading, point, {});
        EXPECT_NEAR(surface.stretch, 0.36f, 1e-6f);
        EXPECT_NEAR(surface.tangent.x, std::cos(angle), 1e-6);
        EXPECT_NEAR(surface.tangent.y, std::sin(angle), 1e-6);
    }
}

TEST(Layers, Clearcoat) {
    Material material;
    material.base_color = glm::dvec3(0.6);
    material.metallic = 0.0;
    material.specular = 0.0;
    material.clearcoat = 0.7;
    material.clearcoat_roughness = 0.5;
    const SurfaceMaterial coated = evaluate_plain(material);
    for (const Directions& d : some_directions()) {
        // mix(base, D V, clearcoat * fresnel(0.04, N.V))
        const double share = 0.7 * schlick(0.04, 1.0, d.view.z);
        expect_equal(scattered(coated, d), 0.6 / pi * (1.0 - share) + anisotropic_lobe(0.25, 0.25, d) * share);
    }
}

TEST(Layers, Sheen) {
    Material material;
    material.base_color = glm::dvec3(0.0);
    material.metallic = 0.0;
    material.specular = 0.0;
    material.sheen_color = glm::dvec3(0.3);
    material.sheen_roughness = 0.6;
    const SurfaceMaterial cloth = evaluate_plain(material);
    for (const Directions& d : some_directions()) {
        const double cos_h = d.half().z, n = 1.0 / 0.36;
        const double distribution = (2.0 + n) * std::pow(1.0 - cos_h * cos_h, n * 0.5) / (2.0 * pi);
        const double visibility = 1.0 / (4.0 * (d.light.z + d.view.z - d.light.z * d.view.z));
        expect_equal(scattered(cloth, d), 0.3 * distribution * visibility);
    }
}

/// KHR_materials_transmission: the light's direction is mirrored at the surface; 1 - F of it passes, tinted.
TEST(Layers, Transmission) {
    Material material;
    material.base_color = glm::dvec3(0.6);
    material.metallic = 0.0;
    material.roughness = 0.6;
    material.transmission = 1.0;
    const SurfaceMaterial frosted = evaluate_plain(material);
    EXPECT_FALSE(frosted.has_diffuse());
    EXPECT_FALSE(frosted.has_glossy());
    for (const Directions& d : some_directions()) {
        const double c = glm::dot(d.view, d.half()), t = std::sqrt(1.0 - (1.0 - c * c) / 2.25);
        const double across = (c - 1.5 * t) / (c + 1.5 * t), along = (1.5 * c - t) / (1.5 * c + t);
        const double fresnel = 0.5 * (across * across + along * along), lobe = anisotropic_lobe(0.36, 0.36, d);
        expect_equal(scattered(frosted, d), fresnel * lobe);
        expect_equal(scattered(frosted, {d.view, {d.light.x, d.light.y, -d.light.z}}), 0.6 * (1.0 - fresnel) * lobe);
    }
    // Half of the base passes light, and metal does not at all.
    material.transmission = 0.5;
    material.metallic = 0.2;
    const SurfaceMaterial mixed = evaluate_plain(material);
    EXPECT_NEAR(mixed.glass, 0.4f, 1e-6f);
    EXPECT_NEAR(mixed.diffuse.x, 0.6f * 0.8f * 0.5f, 1e-6f);
    EXPECT_NEAR(mixed.f0.x, 0.04f * 0.4f + 0.6f * 0.2f, 1e-6f);
}

/// KHR_materials_volume: transmittance is colour^(distance / attenuation distance).
TEST(Layers, Volume) {
    Material material;
    material.transmission = 1.0;
    material.metallic = 0.0;
    material.roughness = 0.0;
    material.ior = 1.4;
    material.attenuation_color = glm::dvec3(0.5, 0.25, 1.0);
    material.attenuation_distance = 0.2;
    const SurfaceMaterial sheet = evaluate_plain(material);
    EXPECT_FALSE(sheet.volume);
    EXPECT_EQ(sheet.attenuation, Rgb(0.0f));
    EXPECT_FLOAT_EQ(evaluate_plain(material, false).ior_ratio, 1.4f);
    material.thickness = 0.01;
    for (const bool front : {true, false}) {
        const SurfaceMaterial solid = evaluate_plain(material, front);
        EXPECT_TRUE(solid.volume);
        EXPECT_FLOAT_EQ(solid.ior_ratio, front ? 1.4f : 1.0f / 1.4f);
        EXPECT_NEAR(std::exp(-solid.attenuation.x * 0.4f), 0.25f, 1e-6f);
        EXPECT_NEAR(std::exp(-solid.attenuation.y * 0.1f), 0.5f, 1e-6f);
        EXPECT_EQ(solid.attenuation.z, 0.0f);
    }
    material.attenuation_distance = 0.0;
    EXPECT_EQ(evaluate_plain(material).attenuation, Rgb(0.0f));
    // Black lets 1e-6 through instead of none, so that the logarithm is finite.
    material.attenuation_distance = 1.0;
    material.attenuation_color = glm::dvec3(0.0);
    EXPECT_NEAR(evaluate_plain(material).attenuation.x, 13.8155f, 1e-3f);
}

}  // namespace
}  // namespace aleph
