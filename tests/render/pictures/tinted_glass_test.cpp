// Media take light on its way: to lamps through rough walls, to the hits of gathers, and to a camera inside.

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

/// Mean radiance over the hemisphere above the origin, as a gather finds it.
double gather_at_origin(const Stage& stage) {
    RayTask task(stage.rays);
    GatherScratch scratch;
    const auto found = gather_irradiance(stage.lighting(), task, make_point(glm::vec3(0.0f), up),
                                         {choose_strata(1024), {1, 2, 3, 4}}, scratch, {.depth = 8});
    return found.irradiance.x / std::numbers::pi;
}

/// A ball of ior 1 about a point turns no light.
TEST(TintedGlass, GathersInsideLoseLightOnTheWayOut) {
    constexpr double radius = 2.0;
    Scene scene;
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(1.0));
    add_mesh(scene, make_faceted_sphere(radius, 96, add_medium(scene, 0.0, 1.0, true)));
    const double left = std::pow(0.5, radius / half_way);
    EXPECT_NEAR(gather_at_origin(Stage(std::move(scene))), left, 0.01 * left);
}

/// A point light and a gather at the centre of a white ball within the medium: light goes to the wall and back.
TEST(TintedGlass, GathersInsideLoseLightOnTheWayToWallsAndFromThemToLamps) {
    constexpr double radius = 2.0, albedo = 0.5, intensity = 8.0;
    const double expected =
        albedo / std::numbers::pi * intensity / (radius * radius) * std::pow(0.5, 2.0 * radius / half_way);
    for (const double specular : {0.0, 1e-3}) {  // plain Lambert surfaces have code of their own
        Scene scene;
        const int white = add_lambert(scene, glm::dvec3(albedo), glm::dvec3(0.0), true);
        scene.materials[white].gloss.specular = specular;
        add_mesh(scene, make_faceted_sphere(10.0, 48, add_medium(scene, 0.0, 1.0, true)));
        add_mesh(scene, make_faceted_sphere(radius, 96, white));
        add_light(scene, Light::Kind::point, glm::dvec3(intensity), glm::dvec3(0.0));
        EXPECT_NEAR(gather_at_origin(Stage(std::move(scene))), expected, 0.01 * expected) << specular;
    }
}

TEST(TintedGlass, MediaAroundAPointAreThoseThatARayLeaves) {
    Scene scene;
    add_mesh(scene, make_faceted_sphere(2.0, 48, add_medium(scene, 0.0, 1.5, true)));
    add_mesh(scene, make_faceted_sphere(20.0, 48, add_medium(scene, 0.0, 1.33, false)));
    const Stage stage(std::move(scene));
    RayTask task(stage.rays);
    const auto find = [&](float height, const glm::vec3& direction, std::uint64_t expected_rays) {
        std::uint64_t rays = 0;
        const Media media = find_media(stage.shading, task, {glm::vec3(0.0f, height, 0.0f), direction}, rays);
        EXPECT_EQ(rays, expected_rays) << height;
        return media;
    };
    const Media both = find(0.0f, up, 3);
    EXPECT_EQ(both.ior(), 1.5f) << "the innermost";
    EXPECT_FLOAT_EQ(both.attenuation_inside().x, std::log(2.0f) / static_cast<float>(half_way));
    EXPECT_EQ(find(5.0f, -up, 4).ior(), 1.33f) << "the ray enters the ball and leaves it";
    EXPECT_EQ(find(50.0f, -up, 5).ior(), 1.0f);
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
