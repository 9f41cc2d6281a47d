// glTF's material extensions against the formulas of their specifications, in double, at a few directions.
// Surface materials from glTF materials; and the short way to Lambert surfaces that gather rays take.

#include "render/surface/bsdf.h"
#include "render/surface/lambert_hit.h"
#include "render/surface/surface_material.h"
#include "tests/support/lobes.h"
#include "tests/support/test.h"

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
    Material material{.base_color = glm::dvec3(0.8), .gloss = {.metallic = 1.0, .roughness = 0.5}};
    SurfaceMaterial brushed = evaluate_plain(material);
    // strength 0.6 along x
    brushed.gloss.stretch = 0.36f;
    brushed.gloss.tangent = {1.0f, 0.0f, 0.0f};
    const double at = 0.25 * (1.0 - 0.36) + 0.36, ab = 0.25;
    for (const Directions& d : some_directions()) {
        const double fresnel = schlick(0.8, 1.0, glm::dot(d.view, d.half()));
        expect_equal(scattered(brushed, d), fresnel * anisotropic_lobe(at, ab, d));
    }
}

TEST(Layers, AnisotropyTurnsWithItsAngle) {
    // Unit texture coordinates on a unit quad, so that the tangent is x.
    for (const double angle : {0.0, 0.5, 2.0}) {
        MaterialStage square({.layers = {.anisotropy = 0.6, .anisotropy_rotation = angle}});
        square.point.edges[0] = {1.0f, 0.0f, 0.0f};
        square.point.edges[1] = up;
        square.point.uv_edges[0][0] = {1.0f, 0.0f};
        square.point.uv_edges[0][1] = {0.0f, -1.0f};  // glTF's v grows downwards
        const SurfaceMaterial surface = square.evaluate();
        EXPECT_NEAR(surface.gloss.stretch, 0.36f, 1e-6f);
        EXPECT_NEAR(surface.gloss.tangent.x, std::cos(angle), 1e-6);
        EXPECT_NEAR(surface.gloss.tangent.y, std::sin(angle), 1e-6);
    }
}

TEST(Layers, Clearcoat) {
    Material material{.base_color = glm::dvec3(0.6),
                      .gloss = {.metallic = 0.0, .specular = 0.0},
                      .layers = {.clearcoat = 0.7, .clearcoat_roughness = 0.5}};
    const SurfaceMaterial coated = evaluate_plain(material);
    // clearcoat fresnel(0.04, V.H) D V, and the base by what that leaves for both directions.
    const auto coat = [](const Directions& d) {
        return 0.7 * schlick(0.04, 1.0, glm::dot(d.view, d.half())) * anisotropic_lobe(0.25, 0.25, d);
    };
    const auto left = [&](double cosine) {
        const glm::vec3 view = direction_of(static_cast<float>(cosine));
        return 1.0 - integrate_around_lobe(
                         0.25f, view,
                         [&](const glm::vec3& l) {
                             return coat({glm::dvec3(view), glm::dvec3(l)}) * l.z;
                         },
                         100);
    };
    double mean = 0.0;
    constexpr int steps = 50;
    for (int i = 0; i < steps; ++i) mean += 2.0 * (i + 0.5) / (steps * steps) * left((i + 0.5) / steps);
    SurfaceMaterial alone = coated;
    alone.diffuse = Rgb(0.0f);
    for (const Directions& d : some_directions()) {
        expect_equal(scattered(alone, d), coat(d));
        const double base = 0.6 / pi * left(d.view.z) * left(d.light.z) / mean;
        EXPECT_NEAR(scattered(coated, d) - scattered(alone, d), base, 2e-3 * base);
    }
}

TEST(Layers, Sheen) {
    Material material{.base_color = glm::dvec3(0.0),
                      .gloss = {.metallic = 0.0, .specular = 0.0},
                      .layers = {.sheen_color = glm::dvec3(0.3), .sheen_roughness = 0.6}};
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
    Material material{
        .base_color = glm::dvec3(0.6), .gloss = {.metallic = 0.0, .roughness = 0.6}, .glass = {.transmission = 1.0}};
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
    material.glass.transmission = 0.5;
    material.gloss.metallic = 0.2;
    const SurfaceMaterial mixed = evaluate_plain(material);
    EXPECT_NEAR(mixed.glass.share, 0.4f, 1e-6f);
    EXPECT_NEAR(mixed.diffuse.x, 0.6f * 0.8f * 0.5f, 1e-6f);
    EXPECT_NEAR(mixed.gloss.f0.x, 0.04f * 0.4f + 0.6f * 0.2f, 1e-6f);
}

/// KHR_materials_volume: transmittance is colour^(distance / attenuation distance).
TEST(Layers, Volume) {
    Material material{
        .gloss = {.metallic = 0.0, .roughness = 0.0, .ior = 1.4},
        .glass = {.transmission = 1.0, .attenuation_distance = 0.2, .attenuation_color = glm::dvec3(0.5, 0.25, 1.0)}};
    const SurfaceMaterial sheet = evaluate_plain(material);
    EXPECT_FALSE(sheet.glass.volume);
    EXPECT_EQ(sheet.glass.attenuation, Rgb(0.0f));
    EXPECT_FLOAT_EQ(evaluate_plain(material, false).glass.ior_ratio, 1.4f);
    material.glass.thickness = 0.01;
    for (const bool front : {true, false}) {
        const SurfaceMaterial solid = evaluate_plain(material, front);
        EXPECT_TRUE(solid.glass.volume);
        EXPECT_FLOAT_EQ(solid.glass.ior_ratio, front ? 1.4f : 1.0f / 1.4f);
        EXPECT_NEAR(std::exp(-solid.glass.attenuation.x * 0.4f), 0.25f, 1e-6f);
        EXPECT_NEAR(std::exp(-solid.glass.attenuation.y * 0.1f), 0.5f, 1e-6f);
        EXPECT_EQ(solid.glass.attenuation.z, 0.0f);
    }
    material.glass.attenuation_distance = 0.0;
    EXPECT_EQ(evaluate_plain(material).glass.attenuation, Rgb(0.0f));
    // Black lets 1e-6 through instead of none, so that the logarithm is finite.
    material.glass.attenuation_distance = 1.0;
    material.glass.attenuation_color = glm::dvec3(0.0);
    EXPECT_NEAR(evaluate_plain(material).glass.attenuation.x, 13.8155f, 1e-3f);
}

/// KHR_materials_unlit: a constant base colour; all other properties are ignored.
TEST(SurfaceMaterial, UnlitShowsItsBaseColourAndReflectsNothing) {
    Material material{.base_color = glm::dvec3(0.5, 0.25, 0.75),
                      .glow = {.color = glm::dvec3(9.0)},
                      .gloss = {.metallic = 0.5},
                      .unlit = true};
    for (const bool front : {true, false}) {
        const SurfaceMaterial surface = evaluate_plain(material, front, {0.5f, 1.0f, 1.0f, 1.0f});
        EXPECT_EQ(surface.emission, Rgb(0.25f, 0.25f, 0.75f));
        EXPECT_FALSE(surface.has_diffuse());
        EXPECT_FALSE(surface.has_glossy());
    }
}

TEST(SurfaceMaterial, NoSurfaceReflectsMoreThanItReceives) {
    const glm::vec4 bright(4.0f, 1.0f, 0.5f, 1.0f);  // of a vertex
    Material material{.base_color = glm::dvec3(0.5), .gloss = {.metallic = 0.0, .specular = 0.0}};
    EXPECT_EQ(evaluate_plain(material, true, bright).diffuse, Rgb(1.0f, 0.5f, 0.25f));
    material.gloss.metallic = 1.0;
    EXPECT_EQ(evaluate_plain(material, true, bright).gloss.f0, Rgb(1.0f, 0.5f, 0.25f));
    material.unlit = true;
    EXPECT_EQ(evaluate_plain(material, true, bright).emission, Rgb(2.0f, 0.5f, 0.25f)) << "this is light";
}

TEST(SurfaceMaterial, SpecularZeroIsPureLambert) {
    Material material{.base_color = glm::dvec3(0.2, 0.5, 0.8), .gloss = {.metallic = 0.0, .specular = 0.0}};
    const SurfaceMaterial surface = evaluate_plain(material);
    EXPECT_FALSE(surface.has_glossy());
    EXPECT_EQ(surface.diffuse, Rgb(0.2f, 0.5f, 0.8f));
    for (const float cosine : {1.0f, 0.9f, 0.5f, 0.2f, 0.05f}) {
        EXPECT_EQ(evaluate_diffuse(surface, cosine, 0.3f).y, 0.5f / std::numbers::pi_v<float>);
        EXPECT_NEAR(diffuse_radiance(surface, cosine, Rgb(std::numbers::pi_v<float>)).z, 0.8f, 1e-6f);
    }
}

TEST(SurfaceMaterial, GltfNumbersBecomeTheTwoLayers) {
    Material plastic{.base_color = glm::dvec3(0.5), .gloss = {.metallic = 0.0, .roughness = 0.5}};
    SurfaceMaterial surface = evaluate_plain(plastic);
    EXPECT_NEAR(surface.gloss.f0.x, 0.04f, 1e-6f);  // index 1.5
    EXPECT_EQ(surface.gloss.f90, 1.0f);
    EXPECT_EQ(surface.gloss.alpha, 0.25f);
    EXPECT_EQ(surface.diffuse.x, 0.5f);

    Material metal{.base_color = glm::dvec3(0.9, 0.6, 0.2), .gloss = {.metallic = 1.0, .roughness = 0.0}};
    surface = evaluate_plain(metal);
    EXPECT_EQ(surface.gloss.f0, Rgb(0.9f, 0.6f, 0.2f));
    EXPECT_FALSE(surface.has_diffuse());
    EXPECT_EQ(surface.gloss.alpha, 0.0f);
    EXPECT_TRUE(surface.is_mirror());

    plastic.gloss.specular_color = glm::dvec3(2.0, 1.0, 0.5);  // above 1 is allowed, F0 stays at most 1
    plastic.gloss.ior = 2.0;
    surface = evaluate_plain(plastic);
    EXPECT_NEAR(surface.gloss.f0.x, 2.0f / 9.0f, 1e-6f);
    EXPECT_NEAR(surface.gloss.f0.z, 0.5f / 9.0f, 1e-6f);
    EXPECT_NEAR(surface.gloss.f0_max, 2.0f / 9.0f, 1e-6f);

    surface = evaluate_plain(metal, true, {0.5f, 1.0f, 1.0f, 1.0f});
    EXPECT_NEAR(surface.gloss.f0.x, 0.45f, 1e-6f);  // vertex colours multiply
}

TEST(SurfaceMaterial, EmissionLeavesTheFrontAndBothSidesIfDoubleSided) {
    Material lamp{.glow = {.color = glm::dvec3(1.0, 2.0, 3.0), .strength = 2.0}};
    EXPECT_EQ(evaluate_plain(lamp, true).emission, Rgb(2.0f, 4.0f, 6.0f));
    EXPECT_EQ(evaluate_plain(lamp, false).emission, Rgb(0.0f));
    lamp.double_sided = true;
    EXPECT_EQ(evaluate_plain(lamp, false).emission, Rgb(2.0f, 4.0f, 6.0f));
}

TEST(SurfaceMaterial, TexturesMultiplyTheFactors) {
    Material material{.glow = {.color = glm::dvec3(10.0)}, .gloss = {.metallic = 1.0}};
    material.textures[TextureSlot::base_color].image = material.textures[TextureSlot::metallic_roughness].image = 0;
    material.textures[TextureSlot::emission].image = material.textures[TextureSlot::specular].image = 0;
    const SurfaceMaterial surface =
        MaterialStage(material, {{.bytes = Image<glm::u8vec4>(1, 1, glm::u8vec4(255, 128, 51, 0))}}).evaluate();
    const float rough = 128.0f / 255.0f, metal = 51.0f / 255.0f, green = srgb_to_linear(128.0f / 255.0f);
    EXPECT_NEAR(surface.gloss.alpha, rough * rough, 1e-6f);
    EXPECT_NEAR(surface.diffuse.y, green * (1.0f - metal), 1e-6f);
    EXPECT_NEAR(surface.gloss.f0.x, metal, 1e-6f);  // specular 0 by the texture's A: only the metal's share is left
    EXPECT_NEAR(surface.gloss.f90, metal, 1e-6f);
    EXPECT_NEAR(surface.emission.y, 10.0f * green, 1e-5f);
}

/// A board of two colours at its corners, partly beyond what a surface can reflect, and a turned box of one colour,
/// seen from both of their sides.
Scene make_colored_scene() {
    Scene scene;
    const int white = add_lambert(scene, {0.9, 0.8, 0.5}, glm::dvec3(0.0), true);
    Mesh board = make_quad(2.0, 2.0, white);
    for (std::size_t i = 0; i < board.positions.size(); ++i) {
        board.colors.push_back(i % 2 == 0 ? glm::vec4(3.0f, 0.2f, -0.1f, 1.0f) : glm::vec4(0.1f, 0.4f, 1.0f, 1.0f));
    }
    add_mesh(scene, board, {0.0, 0.0, -1.0});
    add_mesh(scene, make_box({0.5, 0.4, 0.3}, white), {0.2, 0.1, 0.0}, glm::angleAxis(0.7, glm::dvec3(0.6, 0.8, 0.0)));
    add_light(scene, Light::Kind::point, glm::dvec3(1.0), {0.0, 1.0, 2.0});
    add_camera(scene, {0.0, 0.0, 2.0}, glm::dvec3(0.0), 0.9);
    return scene;
}

/// Both kinds of objects, those of the flat tree and those that move, by single rays and in packets.
TEST(LambertHit, IsTheSurfaceOfTheFullWay) {
    Scene scene = make_colored_scene();
    add_mesh(scene, make_box({0.3, 0.3, 0.3}, 0), {-0.6, -0.4, 0.2});
    scene.nodes.back().transform.axis_rotation = AxisRotation{{0.0, 0.6, 0.8}, Track<double>({0.0, 1.0}, {0.1, 0.9})};
    const Stage stage(std::move(scene), 40, 30);
    const SampleHits centers = cast_centers(stage.rays, stage.view, nullptr);
    std::vector<Ray> rays;
    for (const auto [x, y] : all_pixels(40, 30)) {
        const CameraRay ray = make_sample_ray(stage.view, centers.place, x, y);
        rays.push_back({glm::vec3(ray.origin - stage.rays.anchor()), glm::vec3(ray.direction)});
    }
    Tracer tracer(stage.rays);
    std::vector<Hit> hits(rays.size());
    std::vector<glm::vec3> normals(rays.size());
    tracer.intersect(rays, hits, normals);
    int met[2] = {};
    bool varied = false;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        glm::vec3 normal(0.0f);
        const Hit hit = tracer.intersect(rays[i], &normal);
        ASSERT_EQ(hit.instance, hits[i].instance);
        if (hit.instance == no_index) continue;
        ASSERT_TRUE(stage.shading.materials[stage.shading.instances[hit.instance].material].plain_lambert);
        const bool is_flat = stage.rays.is_flat(hit.instance);
        ++met[is_flat ? 1 : 0];
        EXPECT_LT(glm::length(normals[i] - normal), 1e-6f * glm::length(normal));
        const SurfacePoint point = make_surface_point(stage.shading, hit, rays[i].direction);
        const SurfacePlace place = make_surface_place(stage.shading, hit, rays[i].direction);
        const LambertHit single = make_lambert_hit(stage.shading, rays[i], hit, normal, 1e-3f);
        const LambertHit packed = make_lambert_hit(stage.shading, rays[i], hits[i], normals[i], 1e-3f);
        EXPECT_LT(glm::length(single.position - place.position), 1e-6f);
        EXPECT_LT(glm::length(single.geometric - point.geometric), is_flat ? 1e-6f : 2e-6f);
        EXPECT_LT(glm::length(packed.geometric - point.geometric), 2e-6f);
        EXPECT_LT(glm::length(single.albedo - evaluate_material(stage.shading, point, {}).diffuse), 1e-6f);
        EXPECT_LE(largest_channel(single.albedo), 1.0f);
        varied = varied || single.albedo.x < 0.5f;
    }
    EXPECT_GT(met[0], 20);
    EXPECT_GT(met[1], 200);
    EXPECT_TRUE(varied);
}

}  // namespace
}  // namespace aleph
