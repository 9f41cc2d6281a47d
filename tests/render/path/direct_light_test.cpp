// Direct light against closed forms: point, directional, area and environment light; multiple importance sampling.

#include "render/path/path.h"
#include "tests/support/lobes.h"
#include "tests/support/penumbra.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// Light straight from the lights: by samples of the lights, and as many of the lobes.
Rgb compute_direct_light(const LightingContext& context, RayTask& task, const ViewedSurface& surface, int samples,
                         std::uint32_t seed) {
    const PixelSequence sequence(seed, 1, 2, 3);
    RandomStream random({seed, 1, 2, 3});
    const LitSurface lit(surface);
    const LobeShares shares = share_lobes(lit, LobeSet::specular);
    Rgb lobes(0.0f);
    for (int i = 0; i < samples && shares != LobeShares{}; ++i) {
        const ScatterSample sample = sample_scatter(lit, shares, sequence.at_1d(SampleUse::lobe_choice, i),
                                                    sequence.at_2d(SampleUse::lobe_direction, i), random.next());
        lobes += follow_sample(context, task, lit, sample, PathState{}, random);
    }
    return sample_direct_light(context, task, lit, shares, sequence, {0, samples}) +
           lobes / static_cast<float>(samples);
}

struct Lighting {
    explicit Lighting(Scene scene) : stage(std::move(scene)), task(stage.rays) {}
    Rgb at(const glm::vec3& position, const SurfaceMaterial& material, const glm::vec3& view, int samples = 1,
           std::uint32_t seed = 0) {
        return compute_direct_light(stage.lighting(), task, {make_point(position, up), material, view}, samples, seed);
    }
    Rgb quick_at(const SurfacePoint& point, const SurfaceMaterial& material, int samples) {
        return estimate_direct_light(stage.lighting(), task, {point, material, up}, samples);
    }
    /// At the origin.
    Mean mean_of(const SurfaceMaterial& material, const glm::vec3& view, int samples, int runs,
                 std::uint32_t seed = 0) {
        Mean mean;
        for (int i = 0; i < runs; ++i) mean.add(at(glm::vec3(0.0f), material, view, samples, seed++).x);
        return mean;
    }
    Stage stage;
    RayTask task;
};

TEST(DirectLight, PointLightIsCandelaOverSquaredDistance) {
    Scene scene;
    add_light(scene, Light::Kind::point, {30.0, 20.0, 10.0}, {3.0, 4.0, 0.0});
    Lighting lighting(scene);
    const Rgb found = lighting.at(glm::vec3(0.0f), make_lambert(0.5f), up);
    const double expected = 0.5 / pi * 0.8 / 25.0;  // cos = 4/5, d = 5
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected * (30.0 - 10.0 * c), 1e-5 * expected * 30.0);
    EXPECT_EQ(lighting.task.counts.shadow, 1u);
    // Without area lights, the quick estimate gives the same value.
    const Rgb quick = lighting.quick_at(make_point(glm::vec3(0.0f), up), make_lambert(0.5f), 4);
    EXPECT_NEAR(quick.x, found.x, 1e-6f);
}

TEST(DirectLight, RangeFadesAPointLightOut) {
    // KHR_lights_punctual: max(min(1 - (d / range)^4, 1), 0) / d^2.
    for (const double range : {2.0, 1.0, 0.9}) {
        Scene scene;
        add_light(scene, Light::Kind::point, glm::dvec3(pi), {0.0, 1.0, 0.0});
        scene.lights[0].range = range;
        Lighting lighting(scene);
        const double window = std::max(0.0, 1.0 - 1.0 / std::pow(range, 4.0));
        EXPECT_NEAR(lighting.at(glm::vec3(0.0f), make_lambert(1.0f), up).x, window, 1e-5) << range;
    }
}

TEST(DirectLight, DirectionalLightIsLux) {
    Scene scene;
    add_light(scene, Light::Kind::directional, glm::dvec3(7.0), glm::dvec3(0.0),
              glm::angleAxis(-pi / 3, glm::dvec3(1.0, 0.0, 0.0)));  // 60 degrees below the horizon
    Lighting lighting(scene);
    EXPECT_NEAR(lighting.at(glm::vec3(0.0f), make_lambert(0.5f), up).x, 0.5 / pi * 7.0 * std::sin(pi / 3), 1e-5);
}

TEST(DirectLight, BehindAWallOrTheHorizonItIsDark) {
    Scene scene;
    add_light(scene, Light::Kind::point, glm::dvec3(30.0), {0.0, 2.0, 0.0});
    add_light(scene, Light::Kind::directional, glm::dvec3(30.0), glm::dvec3(0.0), z_to_up);
    add_light(scene, Light::Kind::point, glm::dvec3(30.0), {0.0, -2.0, 0.0});
    add_mesh(scene, make_quad(1.0, 1.0, add_lambert(scene, glm::dvec3(1.0))), {0.0, 1.0, 0.0}, z_to_up);
    Lighting lighting(scene);
    EXPECT_EQ(lighting.at(glm::vec3(0.0f), make_lambert(0.5f), up), Rgb(0.0f));
    EXPECT_GT(lighting.at({1.5f, 0.0f, 0.0f}, make_lambert(0.5f), up).x, 0.0f);  // past the blind, lit from above
}

Scene make_square_lamp(const glm::dquat& turn, bool double_sided, double size = 2.0, double height = 1.5) {
    Scene scene;
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(5.0), double_sided);
    add_mesh(scene, make_quad(size, size, lamp), {0.0, height, 0.0}, turn);
    return scene;
}

double square_factor(double size, double height) {
    return 4.0 * corner_factor(0.5 * size, 0.5 * size, height);
}

TEST(DirectLight, SquareLampOverhead) {
    for (const double height : {0.5, 1.5, 4.0}) {
        Lighting lighting(make_square_lamp(z_to_down, false, 2.0, height));
        const double expected = 0.6 * 5.0 * square_factor(2.0, height);
        EXPECT_TRUE(holds([&](Trial& trial) {
            const Mean mean = lighting.mean_of(make_lambert(0.6f), up, 16, trial.times(300), trial.seed);
            trial.near(mean, expected);
            EXPECT_NEAR(mean.mean(), expected, 0.01 * expected);
        }));
        // The quick estimate's fixed pattern is biased, but close.
        const Rgb quick = lighting.quick_at(make_point(glm::vec3(0.0f), up), make_lambert(0.6f), 16);
        EXPECT_NEAR(quick.x, expected, 0.1 * expected);
    }
}

TEST(DirectLight, OffsetRaysEndBeforeTheLamp) {
    // Far from the anchor, rays start half a millimetre off the surface. They must not reach the lamp because of that.
    Lighting lighting(make_square_lamp(z_to_down, false, 2.0, 0.5));
    SurfacePoint point = make_point(glm::vec3(0.0f), up, 5e-4f);
    const double expected = 0.6 * 5.0 * square_factor(2.0, 0.5);
    EXPECT_TRUE(holds([&](Trial& trial) {
        Mean mean;
        for (std::uint32_t run = 0; run < trial.times(100u); ++run) {
            const ViewedSurface surface{point, make_lambert(0.6f), up};
            const LightingContext context = lighting.stage.lighting();
            mean.add(compute_direct_light(context, lighting.task, surface, 16, run + trial.seed).x);
        }
        trial.near(mean, expected, 1e-3 * expected);
    }));
    const Rgb quick = lighting.quick_at(point, make_lambert(0.6f), 16);
    EXPECT_NEAR(quick.x, expected, 0.1 * expected);
}

TEST(DirectLight, EmittersShineFromTheirFrontOrFromBoth) {
    EXPECT_TRUE(holds([&](Trial& trial) {
        const auto light_below = [&](const glm::dquat& turn, bool double_sided) {
            Lighting lighting(make_square_lamp(turn, double_sided));
            return lighting.mean_of(make_lambert(0.6f), up, 16, trial.times(100), trial.seed);
        };
        EXPECT_EQ(light_below(z_to_up, false).mean(), 0.0);
        const Mean front = light_below(z_to_down, false);
        for (const Mean& mean : {light_below(z_to_up, true), light_below(z_to_down, true)}) trial.near(mean, front);
    }));
}

TEST(DirectLight, EnvironmentOnAnOpenLambertPlaneIsAlbedoTimesRadiance) {
    Scene scene;
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(2.0, 1.0, 0.5));
    Lighting lighting(scene);
    const Rgb found = lighting.at(glm::vec3(0.0f), make_lambert(0.6f), up, 16);
    EXPECT_NEAR(found.x, 1.2f, 1e-5f);
    EXPECT_NEAR(found.y, 0.6f, 1e-5f);
    EXPECT_NEAR(found.z, 0.3f, 1e-5f);
    lighting.task.counts = {};
    EXPECT_NEAR(lighting.quick_at(make_point(glm::vec3(0.0f), up), make_lambert(0.6f), 16).x, 1.2f, 1e-5f);
    EXPECT_EQ(lighting.task.counts.shadow, 16u) << "as for lamps";
}

TEST(DirectLight, WhiteMetalInAWhiteFurnace) {
    Scene scene;
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(1.0));
    Lighting lighting(scene);
    for (const float alpha : {0.01f, 0.1f, 0.4f, 1.0f}) {
        for (const float cosine : {1.0f, 0.6f, 0.15f}) {
            const SurfaceMaterial metal = make_metal(alpha);
            const glm::vec3 view(std::sqrt(1.0f - cosine * cosine), cosine, 0.0f);
            const glm::vec3 local = make_basis(up).to_local(view);
            const double expected = integrate_around_lobe(
                alpha, local, [&](const glm::vec3& light) { return evaluate_glossy(metal, local, light).x * light.z; });
            EXPECT_TRUE(holds([&](Trial& trial) {
                const Mean mean = lighting.mean_of(metal, view, 64, trial.times(200), trial.seed);
                trial.near(mean, expected, 1e-3);
                trial.at_most(mean, 1.0 + 1e-4);
            })) << alpha
                << ' ' << cosine;
        }
    }
}

TEST(DirectLight, MC23_AThousandLightsShareTheSamples) {
    Scene scene;
    double expected = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 at(0.1 * (i % 32) - 1.6, 1.5 + 0.3 * std::sin(1.7 * i), 0.1 * (i / 32) - 1.6);
        add_light(scene, Light::Kind::point, glm::dvec3(0.1), at);
        expected += 0.6 / pi * 0.1 * at.y / std::pow(glm::dot(at, at), 1.5);
    }
    Lighting lighting(std::move(scene));
    EXPECT_TRUE(holds([&](Trial& trial) {
        const int runs = trial.times(100);
        lighting.task.counts = {};
        trial.near(lighting.mean_of(make_lambert(0.6f), up, 32, runs, trial.seed), expected);
        EXPECT_EQ(lighting.task.counts.shadow, static_cast<unsigned>(runs) * 32u);
    }));
    lighting.task.counts = {};
    // The quick estimate has the same points at every surface.
    const SurfacePoint point = make_point(glm::vec3(0.0f), up);
    const Rgb quick = lighting.quick_at(point, make_lambert(0.6f), 4);
    EXPECT_EQ(lighting.task.counts.shadow, 4u * 16u);
    EXPECT_EQ(quick, lighting.quick_at(point, make_lambert(0.6f), 4));
    EXPECT_NEAR(quick.x, expected, 0.05 * expected);
}

}  // namespace
}  // namespace aleph
