// What shines: emissive instances as lists of triangles, their densities, punctual lights, the environment.

#include "render/lights.h"
#include "render/spherical_triangle.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/base/sampling.h"
#include "tests/unit/render_scenes.h"

namespace aleph {
namespace {

constexpr double pi = std::numbers::pi;
const glm::vec3 up(0.0f, 1.0f, 0.0f);

Scene make_lamp_scene(double size, double height) {
    Scene scene;
    add_mesh(scene, make_quad(size, size, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(4.0))), {0.0, height, 0.0},
             z_to_down);
    return scene;
}

TEST(Lights, NumberedEmittersThenPunctualThenEnvironment) {
    Scene scene = make_lamp_scene(1.0, 2.0);
    add_mesh(scene, make_quad(1.0, 1.0, add_lambert(scene, glm::dvec3(0.5))));
    add_light(scene, Light::Kind::point, glm::dvec3(1.0), {0.0, 1.0, 0.0});
    add_light(scene, Light::Kind::directional, glm::dvec3(0.0), glm::dvec3(0.0));  // dark: not a light
    scene.environment = Track<glm::dvec3>(glm::dvec3(0.5));
    const Stage stage(std::move(scene));
    EXPECT_EQ(stage.lights.emitters.size(), 1u);
    EXPECT_EQ(stage.lights.punctual.size(), 1u);
    EXPECT_TRUE(stage.lights.has_environment);
    EXPECT_EQ(stage.lights.count(), 3);
    EXPECT_EQ(stage.lights.emitter_of_instance, (std::vector<int>{0, no_index}));
    const LightSample sky = sample_light(stage.shading, stage.lights, 2, glm::vec3(0.0f), up, {0.3f, 0.6f});
    EXPECT_EQ(sky.distance, std::numeric_limits<float>::infinity());
    EXPECT_NEAR(sky.pdf, glm::dot(sky.direction, up) / pi, 1e-6);
    EXPECT_NEAR(sky.incoming.x * sky.pdf, 0.5f, 1e-6f);
}

TEST(Lights, AreaAndNormalsFollowTheInstance) {
    Scene scene;
    Shape ball;
    ball.kind = Shape::Kind::sphere;
    ball.radius = 1.0;
    ball.segments = 64;
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1.0));
    const int node = add_mesh(scene, make_shape_mesh(ball, lamp));
    scene.nodes[static_cast<std::size_t>(node)].scale = glm::dvec3(-2.0, 2.0, 2.0);
    const Stage stage(std::move(scene));
    const Emitter& emitter = stage.lights.emitters.at(0);
    EXPECT_NEAR(emitter.area, 16.0 * pi, 0.01 * 16.0 * pi);
    for (const Emitter::Triangle& t : emitter.triangles) {
        const glm::vec3 middle = t.corner + (t.edge1 + t.edge2) / 3.0f - glm::vec3(-stage.shading.anchor);
        EXPECT_GT(glm::dot(t.normal, middle), 1.5f);  // outwards, mirrored as it is
    }
    EXPECT_EQ(emitter.cumulative_area.back(), 1.0f);
}

TEST(Lights, DensityMeasuresTheSolidAngle) {
    // E[1 / pdf] over light samples is the solid angle of what is seen: a square overhead has a closed form.
    const Stage stage(make_lamp_scene(2.0, 1.5));
    std::mt19937 engine(6);
    std::uniform_real_distribution<float> unit(0.0f, 0x1.fffffep-1f);
    Mean solid_angle, side;
    for (int i = 0; i < 100'000; ++i) {
        const LightSample sample =
            sample_light(stage.shading, stage.lights, 0, glm::vec3(0.0f), up, {unit(engine), unit(engine)});
        ASSERT_GT(sample.pdf, 0.0f);
        ASSERT_NEAR(sample.incoming.x * sample.pdf, 4.0f, 1e-4f);
        ASSERT_NEAR(sample.distance, 1.5f / sample.direction.y, 1e-3f);
        solid_angle.add(1.0 / sample.pdf);
        side.add(sample.direction.x * sample.distance);
    }
    const double a = 1.0 / 1.5;  // half size over height
    // So near a lamp is sampled by solid angle: 1 / pdf does not vary at all.
    EXPECT_NEAR(solid_angle.mean(), 4.0 * std::asin(a * a / (1.0 + a * a)), 1e-6);
    EXPECT_LT(solid_angle.error(), 1e-6);
    EXPECT_NEAR(side.mean(), 0.0, 3.0 * side.error());
}

TEST(Lights, FarLampsAreSampledByAreaWithTheSameMean) {
    const double height = 9.0, a = 1.0 / height;
    const Stage stage(make_lamp_scene(2.0, height));
    std::mt19937 engine(7);
    std::uniform_real_distribution<float> unit(0.0f, 0x1.fffffep-1f);
    Mean solid_angle;
    for (int i = 0; i < 100'000; ++i) {
        solid_angle.add(
            1.0 / sample_light(stage.shading, stage.lights, 0, glm::vec3(0.0f), up, {unit(engine), unit(engine)}).pdf);
    }
    EXPECT_GT(solid_angle.error(), 0.0);
    EXPECT_NEAR(solid_angle.mean(), 4.0 * std::asin(a * a / (1.0 + a * a)), 3.0 * solid_angle.error());
}

TEST(Lights, SphericalTriangleIsUniformInSolidAngle) {
    // Moments of the direction against a fine grid over the triangle, each cell weighted by its solid angle.
    const glm::vec3 corners[3] = {{-1.0f, 0.3f, 0.6f}, {1.2f, -0.4f, 0.9f}, {0.1f, 1.5f, 0.5f}};
    glm::dvec3 truth(0.0);
    double total = 0.0;
    constexpr int n = 400;
    const glm::dvec3 p(corners[0]), e1(corners[1] - corners[0]), e2(corners[2] - corners[0]);
    const glm::dvec3 normal = glm::cross(e1, e2);
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k + i < n; ++k) {
            for (const double third : {1.0 / 3.0, 2.0 / 3.0}) {
                if (third > 0.5 && i + k + 2 > n) continue;
                const glm::dvec3 at = p + e1 * ((i + third) / n) + e2 * ((k + third) / n);
                const double r = glm::length(at);
                const double weight = std::abs(glm::dot(normal, at)) / (r * r * r) * 0.5 / n / n;
                truth += at / r * weight;
                total += weight;
            }
        }
    }
    EXPECT_NEAR(solid_angle(corners[0], corners[1], corners[2]), total, 1e-4 * total);
    std::mt19937 engine(8);
    std::uniform_real_distribution<float> unit(0.0f, 0x1.fffffep-1f);
    Mean mean[3];
    for (int i = 0; i < 100'000; ++i) {
        const glm::vec3 d = sample_spherical_triangle(corners[0], corners[1], corners[2], {unit(engine), unit(engine)});
        ASSERT_NEAR(glm::length(d), 1.0f, 1e-5f);
        for (int c = 0; c < 3; ++c) mean[c].add(d[c]);
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c].mean(), truth[c] / total, 3.0 * mean[c].error()) << c;
    EXPECT_EQ(solid_angle({1.0f, 0.0f, 0.0f}, {2.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}), 0.0f);
}

TEST(Lights, TexturedLampHasTheTexturesMeanPower) {
    Scene scene = make_lamp_scene(2.0, 1.5);
    SceneImage image;  // a float image: linear
    image.floats = Image<glm::vec4>(2, 1);
    image.floats(0, 0) = glm::vec4(0.0f);
    image.floats(1, 0) = glm::vec4(1.0f);
    scene.images.push_back(image);
    scene.materials[0].emission_texture = {.image = 0, .wrap_u = Wrap::clamp, .nearest = true};
    const Stage stage(std::move(scene));
    int dark = 0, lit = 0;
    for (int i = 0; i < 1000; ++i) {
        const LightSample s = sample_light(stage.shading, stage.lights, 0, glm::vec3(0.0f), up,
                                           {(static_cast<float>(i) + 0.5f) / 1000.0f, 0.5f});
        const float found = s.incoming.x * s.pdf;
        if (found == 0.0f) ++dark;
        if (std::abs(found - 4.0f) < 1e-4f) ++lit;
    }
    EXPECT_EQ(dark + lit, 1000);
    EXPECT_GT(dark, 200);
    EXPECT_GT(lit, 200);
}

TEST(Lights, WhatCannotBeSeenBringsNothing) {
    const Stage stage(make_lamp_scene(2.0, 1.5));
    EXPECT_EQ(sample_light(stage.shading, stage.lights, 0, {0.0f, 3.0f, 0.0f}, up, {0.3f, 0.4f}).incoming, Rgb(0.0f));
    EXPECT_EQ(pdf_emitter(stage.lights.emitters[0], {}, 0.0f, 1.0f), 0.0f);
    EXPECT_EQ(pdf_emitter(stage.lights.emitters[0], {}, -1.0f, 1.0f), 0.0f);
    Scene scene;
    add_light(scene, Light::Kind::point, glm::dvec3(1.0), {0.0, 0.0, 0.0});
    const Stage at_light(std::move(scene));
    const LightSample same_place =
        sample_light(at_light.shading, at_light.lights, 0, glm::vec3(0.0f), up, {0.5f, 0.5f});
    EXPECT_EQ(same_place.incoming, Rgb(0.0f));  // no direction, and not infinite
}

TEST(Lights, HiddenAndFlattenedEmittersAreNoLights) {
    Scene scene = make_lamp_scene(1.0, 2.0);
    scene.nodes[0].visible = 0.0;
    EXPECT_EQ(Stage(scene).lights.count(), 0);
    // A box flattened to a sheet is left out of the scene that rays see (RC-02): then it must not shine either.
    Scene flat;
    const int node = add_mesh(flat, make_box({1.0, 1.0, 1.0}, add_lambert(flat, glm::dvec3(0.0), glm::dvec3(4.0))));
    flat.nodes[static_cast<std::size_t>(node)].scale = glm::dvec3(1.0, 0.0, 1.0);
    const Stage stage(std::move(flat));
    EXPECT_EQ(stage.rays.skipped_instances(), 1u);
    EXPECT_EQ(stage.lights.count(), 0);
}

}  // namespace
}  // namespace aleph
