// Blended surfaces in a picture: what the camera sees, their shadow, and lamps that are blended themselves.

#include "tests/support/path_estimates.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr double alpha = 0.3;

int add_blended(Scene& scene, double albedo, double emission = 0.0) {
    const int material = add_lambert(scene, glm::dvec3(albedo), glm::dvec3(emission), true);
    scene.materials[material].opacity.alpha = alpha;
    scene.materials[material].opacity.mode = Opacity::Mode::blend;
    return material;
}

TEST(BlendRender, AVeilBeforeTheSkyShowsItsShare) {
    Scene scene;
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(2.0));
    add_mesh(scene, make_quad(20.0, 20.0, add_blended(scene, 0.6)), {0.0, 0.0, -2.0});
    const Stage stage(std::move(scene), 16, 12);
    SampleOptions options;
    options.blended = true;
    EXPECT_TRUE(holds([&](Trial& trial) {
        const ShadedFrame out = shade(stage, path_settings(1, trial.times(64), trial.seed), options);
        Mean coverage, red;
        for (std::size_t i = 0; i < out.color.size(); ++i) {
            coverage.add(out.coverage.pixels[i]);
            red.add(out.color.pixels[i].x);
        }
        trial.near(coverage, alpha);
        trial.near(red, alpha * 0.6 * 2.0 + (1.0 - alpha) * 2.0);
        EXPECT_LT(coverage.error(), 0.01);
    }));
}

TEST(BlendRender, AVeilCastsItsShareOfShadow) {
    Scene scene;
    add_mesh(scene, make_quad(20.0, 20.0, add_blended(scene, 0.0)), {0.0, 1.0, 0.0}, z_to_up);
    add_light(scene, Light::Kind::directional, glm::dvec3(std::numbers::pi), {0.0, 3.0, 0.0}, z_to_up);
    const Stage stage(std::move(scene));
    RayTask task(stage.rays);
    EXPECT_TRUE(holds([&](Trial& trial) {
        Mean lit;
        for (int i = 0; i < trial.times(10'000); ++i) {  // from different places: a ray and a veil decide once
            const glm::vec3 position(static_cast<float>(i % 100) * 0.01f, 0.0f, static_cast<float>(i / 100) * 0.01f);
            RandomStream random({1 + trial.seed, 2, 3, static_cast<std::uint32_t>(i)});
            const ViewedSurface surface{
                make_point(position, {0.0f, 1.0f, 0.0f}), make_lambert(1.0f), {0.0f, 1.0f, 0.0f}};
            lit.add(by_paths(0, 1)(stage, task, surface, random).x);
        }
        trial.near(lit, 1.0 - alpha);
    }));
}

TEST(BlendRender, LampsWithHolesGiveTheirShareOfLight) {
    // Blended, and masked by a picture of which a quarter is there.
    for (const bool masked : {false, true}) {
        Scene scene;
        add_mesh(scene, make_quad(2.0, 2.0, add_blended(scene, 0.0, 4.0)), {0.0, 1.0, 0.0}, z_to_down);
        if (masked) {
            SceneImage image{.floats = Image<glm::vec4>(2, 2, glm::vec4(1.0f, 1.0f, 1.0f, 0.0f))};
            image.floats(0, 0).w = 1.0f;
            scene.images.push_back(image);
            scene.materials[0].opacity.mode = Opacity::Mode::mask;
            scene.materials[0].opacity.alpha = 1.0;
            scene.materials[0].textures[TextureSlot::base_color] = {
                .image = 0, .wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp, .nearest = true};
        }
        const Stage stage(std::move(scene));
        const ViewedSurface surface{
            make_point(glm::vec3(0.0f), {0.0f, 1.0f, 0.0f}), make_lambert(0.7f), {0.0f, 1.0f, 0.0f}};
        EXPECT_TRUE(holds([&](Trial& trial) {
            const Mean lobes = estimate(stage, surface, trial.times(20'000), by_lobes(1), 1 + trial.seed);
            for (const int bounces : {0, 1}) {
                trial.near(estimate(stage, surface, trial.times(10'000), by_paths(bounces, 1), 2 + trial.seed), lobes);
            }
        }));
    }
}

}  // namespace
}  // namespace aleph
