// Path tracing in scenes whose light is known: furnaces, boxes of mirrors, Russian roulette, the variance of pixels,
// and values that are no numbers.

#include "render/path/path.h"
#include "tests/support/path_estimates.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// A closed sphere that glows inside, the camera at its centre.
Scene make_furnace(double albedo) {
    Scene scene;
    const int wall = add_lambert(scene, glm::dvec3(albedo), glm::dvec3(1.0));
    add_mesh(scene, flip_winding(make_faceted_sphere(2.0, 16, wall)));
    add_camera(scene, {0.2, 0.1, 0.3}, {0.0, 0.0, -1.0}, 1.0);
    return scene;
}

void expect_value(const Stage& stage, RenderSettings settings, double expected) {
    EXPECT_TRUE(holds([&](Trial& trial) {
        settings.seed = trial.seed;
        settings.sampling.spp = trial.times(64);
        const Mean mean = mean_of_pixels(shade(stage, settings));
        trial.near(mean, expected, 1e-4 * expected);
        EXPECT_NEAR(mean.mean(), expected, 0.01 * expected);
    }));
}

TEST(Path, MC14_AClosedSphereAddsUpAllItsBounces) {
    const Stage stage(make_furnace(0.8), 16, 12);
    RenderSettings settings = path_settings(100, 64);
    settings.light.path_depth = 100;
    expect_value(stage, settings, 5.0);
}

TEST(Path, MC14_EachBounceAddsItsTerm) {
    const Stage stage(make_furnace(0.7), 16, 12);
    double expected = 1.0, term = 1.0;
    for (int bounces = 0; bounces < 5; ++bounces) {
        SCOPED_TRACE(bounces);
        expected += term *= 0.7;  // direct light counts as none
        // The last surface samples lamps only. Points of the wall next to it bring much and are met rarely: the
        // standard error of one picture is often too small.
        const Mean mean = mean_of_pixels(shade(stage, path_settings(bounces, 64)));
        EXPECT_NEAR(mean.mean(), expected, 0.01 * expected);
        EXPECT_LT(mean.error(), 0.01 * expected);
    }
}

TEST(Path, MC14_WithoutLossTheDepthIsTheLight) {
    const Stage stage(make_furnace(1.0), 16, 12);
    for (const int depth : {1, 2, 7}) {
        SCOPED_TRACE(depth);
        RenderSettings settings = path_settings(100, 64);
        settings.light.path_depth = depth;
        expect_value(stage, settings, depth + 1.0);
    }
}

Material make_layered(double roughness) {
    return {.base_color = glm::dvec3(0.8, 0.6, 0.9),
            .gloss = {.metallic = 0.3, .roughness = roughness},
            .glass = {.transmission = 0.4},
            .layers = {
                .clearcoat = 0.7, .clearcoat_roughness = 0.4, .sheen_color = glm::dvec3(0.3), .sheen_roughness = 0.6}};
}

TEST(Path, MC14_AWallOfAllLobesGainsNoLight) {
    for (const double roughness : {0.15, 0.8}) {
        SCOPED_TRACE(roughness);
        Scene scene = make_furnace(0.0);
        scene.materials[0] = make_layered(roughness);
        scene.materials[0].glow.color = glm::dvec3(1.0);
        scene.materials[0].base_color = glm::dvec3(1.0);
        scene.materials[0].double_sided = true;
        scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(1.0));  // behind the glass
        const Stage stage(std::move(scene), 16, 12);
        const SampleHits hits = cast_centers(stage.rays, stage.view, nullptr);
        EXPECT_TRUE(holds([&](Trial& trial) {
            RenderSettings settings = path_settings(100, trial.times(32), trial.seed);
            settings.light.path_depth = 3;
            const Mean mean = mean_of_pixels(shade(stage, settings));
            trial.at_most(mean, 4.0);
            // The same without sampling lights, at the pixels' centres: the sphere looks the same all over.
            Mean lobes;
            for (int i = 0; i < 16 * 12; ++i) {
                const PixelSurface surface = make_pixel_surface(stage.shading, stage.view, hits, i % 16, i / 16);
                const auto seed = static_cast<std::uint32_t>(i) + trial.seed;
                lobes.add(1.0 + estimate(stage, surface, trial.times(32), by_lobes(3), seed).mean());
            }
            trial.near(mean, lobes);
        }));
    }
}

TEST(Path, MC19_ABoxOfMirrorsEndsByDepth) {
    Scene scene;
    scene.materials.push_back(
        {.glow = {.color = glm::dvec3(0.1)}, .gloss = {.metallic = 1.0, .roughness = 0.0}, .double_sided = true});
    add_mesh(scene, make_box({2.0, 3.0, 4.0}, 0));
    const Stage stage(std::move(scene), 16, 12);
    for (const int depth : {0, 1, 32, 500}) {
        RenderSettings settings = path_settings(1, 1);
        settings.light.path_depth = depth;
        const ShadedFrame out = shade(stage, settings);
        for (const Rgb& pixel : out.color.pixels) EXPECT_NEAR(pixel.x, 0.1 * (depth + 1), 1e-4 * (depth + 1));
        EXPECT_EQ(out.counts.rays.specular, out.color.size() * static_cast<unsigned>(depth));
    }
}

TEST(Path, MC19_RouletteIsUnbiased) {
    // A grey closed box around a point; the truth is a geometric series: 0.6 (1 + 0.6 + ...) of radiance 1.
    Scene scene;
    const int wall = add_lambert(scene, glm::dvec3(0.6), glm::dvec3(1.0), true);
    add_mesh(scene, make_box({2.0, 2.0, 2.0}, wall));
    const Stage stage(std::move(scene));
    const ViewedSurface surface{make_point({0.0f, -0.5f, 0.0f}, up), make_lambert(0.6f), up};
    EXPECT_TRUE(holds([&](Trial& trial) {
        const Mean early = estimate(stage, surface, trial.times(20'000), by_paths(1000, 1000, 0), 1 + trial.seed);
        const Mean never = estimate(stage, surface, trial.times(5'000), by_paths(30, 30, 1000), 2 + trial.seed);
        trial.near(early, never);
        trial.near(early, 1.5);
        trial.near(never, 1.5);
        EXPECT_GT(early.error() * std::sqrt(4.0), never.error());  // the price
    }));
}

TEST(Path, VarianceTellsTheErrorOfThePixel) {
    // Smooth light on a floor that fills the picture: over seeds, pixel means spread as the variance says.
    Scene scene;
    const int grey = add_lambert(scene, glm::dvec3(0.6));
    add_mesh(scene, make_quad(20.0, 20.0, grey), {0.0, -1.0, 0.0}, z_to_up);
    add_mesh(scene, make_quad(20.0, 20.0, grey), {0.0, 2.0, 0.0}, z_to_down);
    add_lamp(scene, 1.0, glm::dvec3(5.0), {0.3, 1.5, 0.0});
    add_camera(scene, glm::dvec3(0.0), {0.0, -1.0, -0.1}, 0.6);
    const Stage stage(std::move(scene), 12, 9);
    constexpr std::uint32_t seeds = 64;
    std::vector<Mean> means(12 * 9);
    double told = 0.0;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        const ShadedFrame out = shade(stage, path_settings(1, 16, seed));
        for (std::size_t i = 0; i < means.size(); ++i) {
            means[i].add(luminance(out.color.pixels[i]));
            told += out.variance.pixels[i] / seeds;
        }
    }
    double spread = 0.0;
    for (const Mean& mean : means) spread += mean.error() * mean.error() * seeds;
    // The spread of 108 pixels times 63 degrees of freedom has a standard error of about 2.5 % for such tails.
    EXPECT_NEAR(spread / told, 1.0, 0.075);
}

/// Left a floor whose material can be spoiled, right a good one behind a wall: light cannot get from one to the other.
Scene make_halves() {
    Scene scene;
    const int spoiled = add_lambert(scene, glm::dvec3(0.5)), good = add_lambert(scene, glm::dvec3(0.5));
    scene.materials[0].gloss.specular = 1.0;
    scene.materials[0].gloss.roughness = 0.5;
    add_mesh(scene, make_quad(2.0, 4.0, spoiled), {-1.0, 0.0, -3.0});
    add_mesh(scene, make_quad(2.0, 4.0, good), {1.0, 0.0, -3.0});
    add_light(scene, Light::Kind::directional, glm::dvec3(3.0), glm::dvec3(0.0));
    add_camera(scene, glm::dvec3(0.0), {0.0, 0.0, -1.0}, 0.9);
    return scene;
}

TEST(PathValues, MC03_AMaterialThatIsNotANumberIsDroppedAndCounted) {
    const auto spoil_color = [&](Material& m) { m.base_color = glm::dvec3(0.5, not_a_number, 0.5); };
    const auto spoil_roughness = [&](Material& m) { m.gloss.roughness = not_a_number; };
    const auto spoil_emission = [&](Material& m) { m.glow.color = glm::dvec3(not_a_number); };
    const auto spoil_specular = [&](Material& m) { m.gloss.specular_color = glm::dvec3(0.5, 0.5, not_a_number); };
    const std::vector<std::function<void(Material&)>> all{spoil_color, spoil_roughness, spoil_emission, spoil_specular};
    for (std::size_t which = 0; which < all.size(); ++which) {
        SCOPED_TRACE(which);
        Scene scene = make_halves();
        all[which](scene.materials[0]);
        const Stage stage(std::move(scene), 16, 12);
        const ShadedFrame out = shade(stage, path_settings(2, 4));
        double invalid = 0.0;
        for (int y = 2; y < 10; ++y) {
            for (const int x : {4, 11}) {
                const bool bad = x == 4;
                EXPECT_EQ(out.color(x, y) == Rgb(0.0f), bad) << x;
                EXPECT_EQ(out.invalid_samples(x, y), bad ? 4.0f : 0.0f) << x;
                EXPECT_TRUE(is_finite(out.color(x, y)));
            }
        }
        for (const float count : out.invalid_samples.pixels) invalid += count;
        EXPECT_EQ(invalid, static_cast<double>(out.counts.invalid_samples));
    }
}

TEST(PathValues, MC03_ALightThatIsNotANumberIsDroppedAndCounted) {
    for (const double value : {not_a_number, 1e39}) {
        for (const int lights : {1, 40}) {  // all are compared, or some are drawn
            Scene scene = make_halves();
            for (int i = 1; i < lights; ++i) add_light(scene, Light::Kind::point, glm::dvec3(1.0), glm::dvec3(0.0));
            scene.lights[0].color = glm::dvec3(value);
            const Stage stage(std::move(scene), 16, 12);
            const ShadedFrame out = shade(stage, path_settings(0, 64));
            for (const Rgb& pixel : out.color.pixels) EXPECT_TRUE(is_finite(pixel));
            EXPECT_GT(out.invalid_samples(4, 6), lights == 1 ? 63.0f : 0.0f);
        }
    }
}

TEST(Accumulation, MC13_TheMeanOfTheMostSamplesIsExact) {
    // 65,536 samples of .7, the largest number that a setting may have: a sum in single precision is off by 2e-4, and
    // by a tenth at 1e7 samples.
    Scene scene;
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(0.7, 0.1, 1e-3));
    const Stage stage(std::move(scene), 2, 1);
    RenderSettings settings = plain_settings(0.2, 16);
    settings.sampling.spp = 65'536;
    for (const Rgb& pixel : shade(stage, settings).color.pixels) EXPECT_EQ(pixel, Rgb(0.7f, 0.1f, 1e-3f));
}

}  // namespace
}  // namespace aleph
