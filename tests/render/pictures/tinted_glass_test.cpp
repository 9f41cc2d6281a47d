// What media take of light on its way: to lamps through rough walls, to the hits of gathers, and to a camera inside.

#include "render/cache/gather.h"
#include "render/frame/sequence.h"
#include "tests/support/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr double half_way = 1.0;  // m, over which a tinted medium takes half of the light

int add_medium(Scene& scene, double roughness, double ior, bool tinted) {
    scene.materials.push_back({.gloss = {.metallic = 0.0, .roughness = roughness, .ior = ior},
                               .glass = {.transmission = 1.0,
                                         .thickness = 1.0,
                                         .attenuation_distance = tinted ? half_way : 0.0,
                                         .attenuation_color = glm::dvec3(0.5)}});
    return static_cast<int>(scene.materials.size()) - 1;
}

RenderSettings few_samples(Integrator integrator, std::uint32_t seed) {
    RenderSettings settings = plain_settings(0.3, 64);
    settings.light.integrator = integrator;
    settings.seed = seed;
    return settings;
}

/// Mean of a small picture of a rough slab with its front at z = 0, `thick` m deep, and a lamp.
Mean picture_slab(double thick, double lamp_side, double lamp_z, bool tinted, Integrator integrator,
                  const Trial& trial) {
    Scene scene;
    add_mesh(scene, make_box({40.0, 40.0, thick}, add_medium(scene, 0.6, 1.5, tinted)), {0.0, 0.0, -0.5 * thick});
    add_lamp(scene, lamp_side, glm::dvec3(10.0), {0.0, 0.0, lamp_z}, no_turn);
    add_camera(scene, {0.0, 0.0, 3.0}, {0.0, 0.0, 0.0}, 0.1);
    const Stage stage(std::move(scene), 16, 16);
    Mean mean;
    for (std::uint32_t run = 0; run < 64u; ++run) {
        for (const Rgb& pixel : shade(stage, few_samples(integrator, trial.seed + run)).color.pixels) mean.add(pixel.x);
    }
    return mean;
}

/// Light that refraction turns as far as it can goes 1.342 times as far through the slab as straight light.
TEST(TintedGlass, TakesLightOfLampsByTheWayInsideAlone) {
    constexpr double turned = 1.342;
    for (const Integrator integrator : {Integrator::path, Integrator::cache}) {
        const Trial trial;
        const auto share = [&](double thick, double side, double z) {
            return picture_slab(thick, side, z, true, integrator, trial).mean() /
                   picture_slab(thick, side, z, false, integrator, trial).mean();
        };
        const double behind = share(1.0, 8.0, -10.0);
        EXPECT_LT(behind, 0.5) << "the lamp is outside: the air to it takes nothing";
        EXPECT_GT(behind, 0.95 * std::pow(0.5, turned));
        const double inside = share(8.0, 2.0, -4.0);
        EXPECT_LT(inside, std::pow(0.5, 4.0)) << "the lamp is in the glass";
        EXPECT_GT(inside, 0.95 * std::pow(0.5, 4.0 * turned));
    }
}

TEST(TintedGlass, ChannelsWithoutLossPassFromAnyDistance) {
    EXPECT_EQ(transmit({0.0f, 1.0f, 2.0f}, std::numeric_limits<float>::infinity()), Rgb(1.0f, 0.0f, 0.0f));
    EXPECT_EQ(transmit(Rgb(0.0f), 3.0f), Rgb(1.0f));
    EXPECT_FLOAT_EQ(transmit(Rgb(0.5f), 3.0f).x, std::exp(-1.5f));
}

/// A ball of ior 1 about a point turns no light.
TEST(TintedGlass, GathersInsideLoseLightOnTheWayToTheirHits) {
    constexpr double radius = 2.0;
    const double left = std::pow(0.5, radius / half_way);
    for (const bool walls : {false, true}) {  // light from outside, and from white walls within the medium
        Scene scene;
        scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(walls ? 0.0 : 1.0));
        const int medium = add_medium(scene, 0.0, 1.0, true);
        add_mesh(scene, make_faceted_sphere(walls ? 10.0 * radius : radius, 96, medium));
        const Stage stage(std::move(scene));
        RayTask task(stage.rays);
        GatherScratch scratch;
        if (!walls) {
            const auto found =
                gather_irradiance(stage.lighting(), task, make_point(glm::vec3(0.0f), {0.0f, 1.0f, 0.0f}),
                                  {choose_strata(1024), {1, 2, 3, 4}}, scratch, {.depth = 8});
            EXPECT_NEAR(found.irradiance.x / std::numbers::pi, left, 0.01 * left);
        }
        std::uint64_t rays = 0;
        const glm::vec3 up(0.0f, 1.0f, 0.0f);
        EXPECT_FLOAT_EQ(find_media(stage.shading, task, {glm::vec3(0.0f), up}, rays).attenuation_inside().x,
                        std::log(2.0f) / static_cast<float>(half_way));
        EXPECT_EQ(find_media(stage.shading, task, {glm::vec3(0.0f, 50.0f, 0.0f), -up}, rays).attenuation_inside().x,
                  0.0f)
            << "the ray enters the ball and leaves it";
        EXPECT_EQ(rays, 1u + 1u + 3u);
    }
}

TEST(TintedGlass, CameraInsideSeesLampsThroughTheMedium) {
    Scene scene;
    scene.film.exposure = 1.0;
    add_mesh(scene, make_faceted_sphere(20.0, 48, add_medium(scene, 0.0, 1.33, true)));
    add_lamp(scene, 10.0, glm::dvec3(1.0), {0.0, 0.0, -3.0}, no_turn);
    add_camera(scene, glm::dvec3(0.0), {0.0, 0.0, -1.0}, 0.1);
    for (const Integrator integrator : {Integrator::path, Integrator::cache}) {
        RenderSettings settings = few_samples(integrator, 1);
        settings.picture.width = settings.picture.height = 8;
        Sequence sequence(scene, settings);
        const FrameOutput frame = sequence.render(0);
        for (const Rgb& pixel : frame.shaded.color.pixels) EXPECT_NEAR(pixel.x, std::pow(0.5, 3.0 / half_way), 1e-3);
        EXPECT_EQ(frame.statistics.counts.rays.total(), frame.statistics.traced.all);
    }
}

}  // namespace
}  // namespace aleph
