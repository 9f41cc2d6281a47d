// Paths against a dense gather at every sample, and against the cache: the same picture.

#include "tests/support/path_estimates.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

enum class Walls { plain, glossy, textured, mirrors };

Scene make_box_scene(Walls walls) {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.75), glm::dvec3(0.0), true);
    const int red = add_lambert(scene, {0.6, 0.1, 0.1}, glm::dvec3(0.0), true);
    add_small_room(scene, white, red, {9.0, 8.0, 6.0}, 0.6);
    add_mesh(scene, make_box({0.6, 0.8, 0.6}, white), {0.3, -0.6, -0.2}, turn_about_y(0.4));
    if (walls == Walls::glossy) {
        scene.materials[0].gloss.specular = 1.0;
        scene.materials[0].gloss.roughness = 0.5;
    }
    if (walls == Walls::mirrors) {  // the red wall is one, and a pane of glass hangs under the lamp
        scene.materials[1] = {};
        scene.materials[1].gloss.roughness = 0.0;
        scene.materials.push_back({.gloss = {.metallic = 0.0, .roughness = 0.0}, .glass = {.transmission = 1.0}});
        add_mesh(scene, make_quad(1.2, 1.2, 3), {0.0, 0.6, 0.0}, z_to_down);
    }
    if (walls == Walls::textured) {
        SceneImage image{.floats = Image<glm::vec4>(8, 8)};
        for (int i = 0; i < 64; ++i) image.floats.pixels[i] = glm::vec4((i + i / 8) % 2 == 0 ? 1.0f : 0.3f);
        scene.images.push_back(image);
        scene.materials[0].textures[TextureSlot::base_color].image = 0;
    }
    add_camera(scene, {0.0, 0.0, 3.4}, {0.0, 0.0, 0.0}, 0.7);
    return scene;
}

class PathGather : public testing::TestWithParam<Walls> {};

TEST_P(PathGather, OneBounceIsThePictureOfTheGather) {
    constexpr int width = 20, height = 15;
    constexpr std::uint32_t seeds = 40;
    const Stage stage(make_box_scene(GetParam()), width, height);
    EXPECT_TRUE(holds([&](Trial& trial) {
        PictureMeans paths, gathers;
        for (std::uint32_t seed = trial.seed; seed < trial.seed + trial.times(seeds); ++seed) {
            RenderSettings settings = path_settings(1, GetParam() == Walls::mirrors ? 16 : 4, seed);
            paths.add(shade(stage, settings).color);
            settings.light.integrator = Integrator::cache;
            settings.cache.accuracy = 0.0;
            settings.cache.gather = 8;
            settings.seed = seed + 1000;
            gathers.add(shade(stage, settings).color);
        }
        trial.near(paths.all, gathers.all);
        EXPECT_LT(paths.all.error(), 0.01 * paths.all.mean());
        int beyond = 0;
        for (std::size_t i = 0; i < paths.pixels.size(); ++i) {
            const Mean &a = paths.pixels[i], &b = gathers.pixels[i];
            if (std::abs(a.mean() - b.mean()) > 3.0 * std::hypot(a.error(), b.error()) + 1e-6) ++beyond;
        }
        // About one of 300 pixels is expected. Under mirrors, rare paths bring much of the light of some pixels, whose
        // spread over few renders says too little.
        trial.at_most(beyond, 0.0, GetParam() == Walls::mirrors ? width * height / 50 : width * height / 100);
    }));
}

/// Means of independent pictures with the cache and of paths.
TEST_P(PathGather, IC23_ThreeBouncesWithTheCacheToo) {
    constexpr int width = 20, height = 15;
    const Stage stage(make_box_scene(GetParam()), width, height);
    const auto mean = [&](RenderSettings settings, std::uint32_t runs) {
        PictureMeans pictures;
        for (std::uint32_t run = 0; run < runs; ++run, ++settings.seed) pictures.add(shade(stage, settings).color);
        return pictures.all;
    };
    EXPECT_TRUE(holds([&](Trial& trial) {
        RenderSettings settings = path_settings(3, 16, trial.seed);
        const Mean paths = mean(settings, trial.times(32u));
        settings.light.integrator = Integrator::cache;
        settings.light.light_samples = 64;
        settings.seed += 1000;
        for (const double accuracy : {0.0, 0.3}) {
            settings.cache.accuracy = accuracy;
            settings.cache.gather = accuracy > 0.0 ? 64 : 4;
            const Mean gathers = mean(settings, trial.times(6u));
            trial.near(gathers, paths, 0.005 * paths.mean());
            EXPECT_LT(std::hypot(paths.error(), gathers.error()),
                      (GetParam() == Walls::mirrors ? 0.03 : 0.006) * paths.mean());
        }
    }));
}

INSTANTIATE_TEST_SUITE_P(Boxes, PathGather,
                         testing::Values(Walls::plain, Walls::glossy, Walls::textured, Walls::mirrors));

}  // namespace
}  // namespace aleph
