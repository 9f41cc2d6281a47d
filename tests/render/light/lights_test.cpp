// Lights: emissive instances as lists of triangles, their densities, punctual lights, the environment.

#include "render/light/lights.h"
#include "engine/base/sampling.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

Scene make_lamp_scene(double size, double height) {
    Scene scene;
    add_lamp(scene, size, glm::dvec3(4.0), {0.0, height, 0.0});
    return scene;
}

TEST(Lights, NumberedEmittersThenPunctualThenEnvironment) {
    Scene scene = make_lamp_scene(1.0, 2.0);
    add_mesh(scene, make_quad(1.0, 1.0, add_lambert(scene, glm::dvec3(0.5))));
    add_light(scene, Light::Kind::point, glm::dvec3(1.0), {0.0, 1.0, 0.0});
    add_light(scene, Light::Kind::directional, glm::dvec3(0.0), glm::dvec3(0.0));  // dark, so not a light
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(0.5));
    const Stage stage(std::move(scene));
    EXPECT_EQ(stage.lights.emitters.size(), 1u);
    EXPECT_EQ(stage.lights.punctual.size(), 1u);
    EXPECT_TRUE(stage.lights.has_environment);
    EXPECT_EQ(stage.lights.count(), 3);
    EXPECT_EQ(stage.lights.emitter_of_instance, (std::vector<int>{0, no_index}));
    const LightSample sky = sample_light(stage.shading, stage.lights, 2, {glm::vec3(0.0f), up}, {0.3f, 0.6f});
    EXPECT_EQ(sky.distance, float_infinity);
    EXPECT_NEAR(sky.pdf, glm::dot(sky.direction, up) / pi, 1e-6);
    EXPECT_NEAR(sky.incoming.x * sky.pdf, 0.5f, 1e-6f);
}

TEST(Lights, ASunParallelToASurfaceBringsNothing) {
    Scene scene = make_lamp_scene(1.0, 2.0);
    add_light(scene, Light::Kind::directional, glm::dvec3(3.0), glm::dvec3(0.0));
    const Stage stage(std::move(scene));
    const glm::vec3 towards = sample_light(stage.shading, stage.lights, 1, {glm::vec3(0.0f), up}, {}).direction;
    const glm::vec3 across = make_basis(towards).tangent;
    for (const float cosine : {-6e-17f, 6e-17f, 1e-3f, 1.0f}) {
        const Receiver receiver{glm::vec3(0.0f), glm::normalize(across * (1.0f - cosine) + towards * cosine)};
        const LightSample sample = sample_light(stage.shading, stage.lights, 1, receiver, {});
        EXPECT_EQ(sample.incoming.x, std::abs(cosine) > 1e-4f ? 3.0f : 0.0f) << cosine;
    }
}

TEST(Lights, AreaAndNormalsFollowTheInstance) {
    Scene scene;
    Shape ball{.kind = Shape::Kind::sphere, .radius = 1.0, .segments = 64};
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1.0));
    const int node = add_mesh(scene, make_shape_mesh(ball, lamp));
    scene.nodes[node].transform.scale = glm::dvec3(-2.0, 2.0, 2.0);
    const Stage stage(std::move(scene));
    const Emitter& emitter = stage.lights.emitters.at(0);
    EXPECT_NEAR(emitter.area, 16.0 * pi, 0.01 * 16.0 * pi);
    for (std::size_t i = 0; i < emitter.size(); ++i) {
        const Emitter::Triangle t = emitter.triangle(i);
        const glm::vec3 middle = t.corner + (t.edge1 + t.edge2) / 3.0f - glm::vec3(-stage.shading.anchor);
        EXPECT_GT(glm::dot(t.normal, middle), 1.5f);  // outwards, although mirrored
    }
    EXPECT_EQ(emitter.shape->cumulative.back(), 1.0f);
}

/// Up to a few rounding errors before the lamp: a shade 1 mm below a lamp that is 100 m away hides it.
TEST(Lights, ShadowRaysEndCloseToTheLamp) {
    for (const double height : {0.1, 10.0, 100.0}) {
        Scene scene = make_lamp_scene(1.0, height);
        add_light(scene, Light::Kind::point, glm::dvec3(1.0), {0.0, height, 0.0});
        const Stage stage(std::move(scene));
        const Receiver floor{glm::vec3(glm::dvec3(0.0) - stage.shading.anchor), up};
        for (int light = 0; light < 2; ++light) {
            const LightSample sample = sample_light(stage.shading, stage.lights, light, floor, {0.5f, 0.5f});
            const double reach = sample.distance * sample.direction.y;
            EXPECT_LT(reach, height) << light;
            EXPECT_GT(reach, height * (1.0 - 3e-5)) << light;
        }
    }
}

TEST(Lights, DensityMeasuresTheSolidAngle) {
    // E[1 / pdf] over light samples is the visible solid angle. For a square overhead it has a closed form.
    const Stage stage(make_lamp_scene(2.0, 1.5));
    EXPECT_TRUE(holds([&](Trial& trial) {
        RandomStream random({6 + trial.seed, 0, 0, 0});
        Mean solid_angle, side;
        for (int i = 0; i < trial.times(100'000); ++i) {
            const LightSample sample =
                sample_light(stage.shading, stage.lights, 0, {glm::vec3(0.0f), up}, random.next_2d());
            ASSERT_GT(sample.pdf, 0.0f);
            ASSERT_NEAR(sample.incoming.x * sample.pdf, 4.0f, 1e-4f);
            ASSERT_NEAR(sample.distance, 1.5f / sample.direction.y, 1e-3f);
            solid_angle.add(1.0 / sample.pdf);
            side.add(sample.direction.x * sample.distance);
        }
        const double a = 1.0 / 1.5;  // half size over height
        // A lamp this near is sampled by solid angle: 1 / pdf is constant.
        EXPECT_NEAR(solid_angle.mean(), 4.0 * std::asin(a * a / (1.0 + a * a)), 1e-6);
        EXPECT_LT(solid_angle.error(), 1e-6);
        trial.near(side, 0.0);
    }));
}

TEST(Lights, FarLampsAreSampledByAreaWithTheSameMean) {
    const double height = 9.0, a = 1.0 / height;
    const Stage stage(make_lamp_scene(2.0, height));
    EXPECT_TRUE(holds([&](Trial& trial) {
        RandomStream random({7 + trial.seed, 0, 0, 0});
        Mean solid_angle;
        for (int i = 0; i < trial.times(100'000); ++i) {
            solid_angle.add(1.0 /
                            sample_light(stage.shading, stage.lights, 0, {glm::vec3(0.0f), up}, random.next_2d()).pdf);
        }
        EXPECT_GT(solid_angle.error(), 0.0);
        trial.near(solid_angle, 4.0 * std::asin(a * a / (1.0 + a * a)));
    }));
}

TEST(Lights, SphericalTriangleIsUniformInSolidAngle) {
    // Moments of the direction against those of a fine grid over the triangle, weighted by solid angle.
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
    EXPECT_TRUE(holds([&](Trial& trial) {
        RandomStream random({8 + trial.seed, 0, 0, 0});
        Mean mean[3];
        for (int i = 0; i < trial.times(100'000); ++i) {
            const glm::vec3 d = sample_spherical_triangle(corners[0], corners[1], corners[2], static_cast<float>(total),
                                                          random.next_2d());
            ASSERT_NEAR(glm::length(d), 1.0f, 1e-5f);
            for (int c = 0; c < 3; ++c) mean[c].add(d[c]);
        }
        for (int c = 0; c < 3; ++c) trial.near(mean[c], truth[c] / total);
    }));
    EXPECT_EQ(solid_angle({1.0f, 0.0f, 0.0f}, {2.0f, 0.0f, 0.0f}, up), 0.0f);
}

TEST(Lights, TexturedLampHasTheTexturesMeanPower) {
    Scene scene = make_lamp_scene(2.0, 1.5);
    SceneImage image;  // a float image: linear
    image.floats = Image<glm::vec4>(2, 1);
    image.floats(0, 0) = glm::vec4(0.0f);
    image.floats(1, 0) = glm::vec4(1.0f);
    scene.images.push_back(image);
    scene.materials[0].textures[TextureSlot::emission] = {.image = 0, .wrap_u = Wrap::clamp, .nearest = true};
    const Stage stage(std::move(scene));
    int dark = 0, lit = 0;
    for (int i = 0; i < 1000; ++i) {
        const LightSample s = sample_light(stage.shading, stage.lights, 0, {glm::vec3(0.0f), up},
                                           {(static_cast<float>(i) + 0.5f) / 1000.0f, 0.5f});
        const float found = s.incoming.x * s.pdf;
        if (found == 0.0f) ++dark;
        if (std::abs(found - 4.0f) < 1e-4f) ++lit;
    }
    EXPECT_EQ(dark + lit, 1000);
    EXPECT_GT(dark, 200);
    EXPECT_GT(lit, 200);
}

/// The quick estimate's few points represent the whole lamp: its texture is averaged over their shares.
TEST(Lights, ASharesTextureIsAveraged) {
    Scene scene = make_lamp_scene(2.0, 1.5);
    SceneImage image{.floats = Image<glm::vec4>(64, 64)};
    for (const auto [x, y] : all_pixels(64, 64)) image.floats(x, y) = glm::vec4((x + y) % 2 == 0 ? 1.0f : 0.0f);
    scene.images.push_back(image);
    scene.materials[0].textures[TextureSlot::emission] = {.image = 0, .nearest = true};
    const Stage stage(std::move(scene));
    for (int i = 0; i < 20; ++i) {
        const glm::vec2 u((static_cast<float>(i) + 0.5f) / 20.0f, 0.37f);
        const LightSample s = sample_light(stage.shading, stage.lights, 0, {glm::vec3(0.0f), up}, u, 0.25f);
        EXPECT_NEAR(s.incoming.x * s.pdf, 2.0f, 1e-4f);
    }
}

/// A spot light that shines straight down.
Stage make_spot(double inner, double outer, double range = 0.0) {
    Scene scene;
    add_light(scene, Light::Kind::spot, {8.0, 4.0, 2.0}, {0.0, 2.0, 0.0}, z_to_up);
    scene.lights[0].inner_cone = inner;
    scene.lights[0].outer_cone = outer;
    scene.lights[0].range = range;
    return Stage(std::move(scene));
}

TEST(Lights, SpotFallsOffAsTheExtensionSays) {
    // KHR_lights_punctual: clamp((cos - cos outer) / (cos inner - cos outer), 0, 1)^2 of candela over distance squared.
    for (const auto& [inner, outer] :
         {std::pair(0.0, pi / 4.0), std::pair(0.3, 0.5), std::pair(0.2, pi / 2.0), std::pair(0.004, 0.01)}) {
        const Stage stage = make_spot(inner, outer);
        for (int i = 0; i <= 40; ++i) {
            const double angle = outer * 1.2 * i / 40.0;
            if (angle > 1.5) break;
            const glm::vec3 at(static_cast<float>(2.0 * std::tan(angle)), 0.0f, 0.0f);
            const LightSample s = sample_light(stage.shading, stage.lights, 0, {at, up}, {0.5f, 0.5f});
            const double share =
                std::clamp((std::cos(angle) - std::cos(outer)) / (std::cos(inner) - std::cos(outer)), 0.0, 1.0);
            const double distance2 = 4.0 / (std::cos(angle) * std::cos(angle));
            EXPECT_NEAR(s.incoming.x, 8.0 * share * share / distance2, 2e-3)
                << inner << " " << outer << " at " << angle;
            EXPECT_NEAR(s.incoming.y, 0.5 * s.incoming.x, 1e-6);
        }
    }
}

TEST(Lights, SpotsEndSharplyWhereConesMeetAndAtTheirRange) {
    const Stage sharp = make_spot(0.4, 0.4);
    const auto at_angle = [](const Stage& stage, double angle) {
        const glm::vec3 at(static_cast<float>(2.0 * std::tan(angle)), 0.0f, 0.0f);
        return sample_light(stage.shading, stage.lights, 0, {at, up}, {0.5f, 0.5f}).incoming.x;
    };
    EXPECT_NEAR(at_angle(sharp, 0.39), 8.0 * std::pow(std::cos(0.39), 2) / 4.0, 1e-5);
    EXPECT_EQ(at_angle(sharp, 0.41), 0.0f);
    // No light behind the spot, even with the widest cone.
    const Stage wide = make_spot(0.0, pi / 2.0);
    EXPECT_EQ(sample_light(wide.shading, wide.lights, 0, {{0.1f, 4.0f, 0.0f}, up}, {0.5f, 0.5f}).incoming, Rgb(0.0f));
    EXPECT_EQ(at_angle(make_spot(0.1, 0.5, 1.5), 0.0), 0.0f);  // 2 m away
    EXPECT_NEAR(at_angle(make_spot(0.1, 0.5, 3.0), 0.0), 8.0 / 4.0 * (1.0 - std::pow(2.0 / 3.0, 4)), 1e-5);
}

TEST(Lights, UnlitSurfacesAreNoLights) {
    Scene scene = make_lamp_scene(1.0, 2.0);
    scene.materials[0].unlit = true;
    EXPECT_EQ(Stage(std::move(scene)).lights.count(), 0);
}

TEST(Lights, UnlitSurfacesAreSeenAsTheyAreAndLightNothing) {
    // The left half is unlit and faces away, the right half is white. First without any light, then with a lamp.
    for (const bool lamp : {false, true}) {
        Scene scene;
        const int unlit = add_lambert(scene, {0.3, 0.6, 0.9});
        scene.materials[0].unlit = true;
        add_mesh(scene, flip_winding(make_quad(2.0, 4.0, unlit)), {-1.0, 0.0, -3.0});
        add_mesh(scene, make_quad(2.0, 4.0, add_lambert(scene, glm::dvec3(1.0))), {1.0, 0.0, -3.0}, turn_about_y(-0.8));
        if (lamp) add_light(scene, Light::Kind::point, glm::dvec3(5.0), glm::dvec3(0.0, 0.0, -1.0));
        const Stage stage(std::move(scene), 32, 24);
        const ShadedFrame frame = shade(stage, plain_settings(0.0, 64));
        EXPECT_EQ(frame.color(8, 12), Rgb(0.3f, 0.6f, 0.9f));
        const float white = luminance(frame.color(22, 12));
        EXPECT_EQ(white > 0.0f, lamp);
    }
}

TEST(Lights, WhatCannotBeSeenBringsNothing) {
    const Stage stage(make_lamp_scene(2.0, 1.5));
    EXPECT_EQ(sample_light(stage.shading, stage.lights, 0, {{0.0f, 3.0f, 0.0f}, up}, {0.3f, 0.4f}).incoming, Rgb(0.0f));
    EXPECT_EQ(pdf_emitter(stage.lights.emitters[0], {}, {}, 0.0f, 1.0f), 0.0f);
    EXPECT_EQ(pdf_emitter(stage.lights.emitters[0], {}, {}, -1.0f, 1.0f), 0.0f);
    Scene scene;
    add_light(scene, Light::Kind::point, glm::dvec3(1.0), {0.0, 0.0, 0.0});
    const Stage at_light(std::move(scene));
    const LightSample same_place =
        sample_light(at_light.shading, at_light.lights, 0, {glm::vec3(0.0f), up}, {0.5f, 0.5f});
    EXPECT_EQ(same_place.incoming, Rgb(0.0f));  // no direction, and not infinite
}

TEST(Lights, HiddenAndFlattenedEmittersAreNoLights) {
    Scene scene = make_lamp_scene(1.0, 2.0);
    scene.nodes[0].visible = 0.0;
    EXPECT_EQ(Stage(scene).lights.count(), 0);
    // Rays leave out a box that is flattened to a sheet, so it must not emit light either (RC-02).
    Scene flat;
    const int node = add_mesh(flat, make_box({1.0, 1.0, 1.0}, add_lambert(flat, glm::dvec3(0.0), glm::dvec3(4.0))));
    flat.nodes[node].transform.scale = glm::dvec3(1.0, 0.0, 1.0);
    const Stage stage(std::move(flat));
    EXPECT_EQ(stage.lights.count(), 0);
}

TEST(Lights, ThoseThatAreLeftOutChangeTheNumbersOfOthers) {
    Scene scene = make_lamp_scene(1.0, 2.0);
    add_mesh(scene, make_quad(2.0, 2.0, 0), {0.0, 3.0, 0.0}, z_to_down);
    for (const double candela : {1.0, 2.0, 3.0})
        add_light(scene, Light::Kind::point, glm::dvec3(candela), {0.0, 1.0, 0.0});
    const Stage stage(std::move(scene));
    LightSet lights = make_light_set(stage.shading);
    remove_lights(stage.shading, {0}, {1}, lights);
    EXPECT_EQ(lights.emitter_of_instance, (std::vector<int>{left_out_emitter, 0}));
    ASSERT_EQ(lights.emitters.size(), 1u);
    EXPECT_EQ(lights.emitters[0].area, 4.0f);
    ASSERT_EQ(lights.punctual.size(), 2u);
    EXPECT_EQ(lights.punctual[0].intensity.x, 1.0f);
    EXPECT_EQ(lights.punctual[1].intensity.x, 3.0f);
    EXPECT_EQ(lights.tree.lights, 3);
}

}  // namespace
}  // namespace aleph
