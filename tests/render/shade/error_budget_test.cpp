// Tolerances of samples, from thresholds and the error that is asked for; and what that error must not leave out.

#include "render/frame/sequence.h"
#include "render/guide/stopping_rule.h"
#include "render/shade/progressive.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(ErrorBudget, MovingOutlinesKeepToTheStrictestThresholdAround) {
    Image<float> threshold(5, 5, 8.0f);
    threshold(2, 2) = 2.0f;
    const Image<float> noise(5, 5, 1.0f), aleph(5, 5, 1.0f), accuracy(5, 5, 0.1f), swing;
    Image<Outline> outlines(5, 5, Outline::none);
    outlines(1, 1) = outlines(3, 2) = Outline::moving;
    outlines(2, 1) = Outline::still;
    const VisibleLimits limits{threshold, noise, aleph, accuracy, outlines, swing, ViewingConditions{}};
    RenderSettings settings;
    settings.sampling.rule = Sampling::variance;
    settings.error = 0.5;
    const double white = limits.viewing.display_white;
    const Image<float> tolerance = compute_sampling_tolerance(limits, settings, 4.0);
    EXPECT_NEAR(tolerance(1, 1), 0.5 * 2.0 / white / 4.0, 1e-8);
    EXPECT_NEAR(tolerance(3, 2), 0.5 * 2.0 / white / 4.0, 1e-8);
    EXPECT_NEAR(tolerance(0, 0), 0.5 * 8.0 / white / 4.0, 1e-8);
    EXPECT_NEAR(tolerance(2, 1), 0.5 * 8.0 / white / 4.0, 1e-8);
    EXPECT_NEAR(tolerance(1, 2), 0.5 * 8.0 / white / 4.0, 1e-8);
    settings.sampling.rule = Sampling::uniform;
    EXPECT_TRUE(compute_sampling_tolerance(limits, settings, 4.0).empty());
}

TEST(ErrorBudget, SamplesKeepToTheNoiseThatGoesUnseen) {
    const Image<float> threshold(3, 3, 2.0f), noise(3, 3, 5.0f), aleph(3, 3, 1.0f), accuracy(3, 3, 0.1f), swing;
    const Image<Outline> outlines(3, 3, Outline::none);
    const VisibleLimits limits{threshold, noise, aleph, accuracy, outlines, swing, ViewingConditions{}};
    RenderSettings settings;
    const double unit = 5.0 / limits.viewing.display_white / 2.0;
    for (const auto& [error, times] : {std::pair(0.5, 0.5), std::pair(1.0, 1.0), std::pair(2.0, std::pow(2.0, 0.8))}) {
        follow_error(settings, error);
        EXPECT_NEAR(compute_sampling_tolerance(limits, settings, 2.0)(1, 1), times * unit, 1e-7) << error;
    }
}

/// Beside a red lamp, red is beyond white and the other channels far below.
TEST(AskedError, NoiseBeyondWhiteTakesNoSamples) {
    Scene scene;
    add_flat_view(scene, 1.0);
    scene.environment.radiance.reset();
    add_mesh(scene, make_quad(5.0, 5.0, add_lambert(scene, glm::dvec3(0.8))));
    add_lamp(scene, 2.0, {400.0, 1.0, 1.0}, {2.2, 0.0, 1.1}, turn_about_y(-0.5 * pi));
    RenderSettings settings{.picture = {.width = 16, .height = 12}};
    follow_error(settings, 0.5);
    settings.light.bounces = 0;
    const ShadedFrame out = Sequence(scene, settings).render(0).shaded;
    for (const Rgb& color : out.color.pixels) {
        EXPECT_GT(color.x, 1.0f);
        EXPECT_LT(color.y, 1.0f);
    }
    EXPECT_LE(out.counts.samples, 40u * 16 * 12);
}

TEST(AskedError, FaintLampsCountAtAnyError) {
    // One bright lamp, and eight that together add a twentieth: a small part of the error that is asked for.
    Scene scene;
    add_flat_view(scene, 1.0);
    scene.environment.radiance.reset();
    add_mesh(scene, make_quad(5.0, 5.0, add_lambert(scene, glm::dvec3(0.5))));
    std::vector<std::pair<glm::dvec3, double>> lamps{{{0.0, 0.0, 4.0}, 20.0}};
    for (int i = 0; i < 8; ++i) lamps.push_back({{0.5 * (i % 4) - 0.75, 0.5 * (i / 4) - 0.25, 4.0}, 0.14});
    for (const auto& [place, intensity] : lamps) add_light(scene, Light::Kind::point, glm::dvec3(intensity), place);
    RenderSettings settings{.picture = {.width = 16, .height = 12, .filter = PixelFilter::box}};
    follow_error(settings, 8.0);
    settings.effects.plan = EffectsPlanning::off;  // it leaves lights out, within a share of the threshold (FX-14)
    settings.light.bounces = 0;
    const ShadedFrame out = Sequence(scene, settings).render(0).shaded;
    double found = 0.0, expected = 0.0;
    for (const auto [x, y] : all_pixels(16, 12)) {
        found += luminance(out.color(x, y));
        const glm::dvec3 point((x + 0.5) / 6.0 - 16.0 / 12.0, 1.0 - (y + 0.5) / 6.0, 0.0);
        for (const auto& [place, intensity] : lamps) {
            const glm::dvec3 away = place - point;
            expected += 0.5 / std::numbers::pi * intensity * away.z / std::pow(glm::length(away), 3.0);
        }
    }
    EXPECT_NEAR(found / expected, 1.0, 0.01);
}

/// Its lobe sees the horizon against what is above: nothing of that may be left out, and the sky alone cannot be
/// sampled for it. The ground is 40 m deep, seen at grazing angles.
TEST(AskedError, GlossyGroundUnderASkyIsThatOfPaths) {
    constexpr int width = 32, height = 24;
    Scene scene;
    scene.film.exposure = 1.0;
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(0.5));
    scene.materials.push_back({.base_color = glm::dvec3(0.1), .gloss = {.metallic = 0.0, .roughness = 0.35}});
    add_mesh(scene, make_quad(200.0, 200.0, 0), glm::dvec3(0.0), z_to_up);
    add_mesh(scene, make_box(glm::dvec3(1.0), add_lambert(scene, {0.7, 0.2, 0.1})), {0.0, 0.5, -2.0});
    add_camera(scene, {0.0, 1.0, 4.0}, {0.0, 1.0, 0.0}, 0.8);
    RenderSettings asked{.picture = {.width = width, .height = height, .filter = PixelFilter::box}}, paths = asked;
    follow_error(asked, 1.0);
    paths.light.integrator = Integrator::path;
    paths.light.bounces = asked.light.bounces;
    paths.sampling.spp = 512;
    paths.seed = 1;
    paths.perception.guide = Guide::none;
    const ShadedFrame found = Sequence(scene, asked).render(0).shaded, truth = Sequence(scene, paths).render(0).shaded;
    Image<float> shown(width / 4, height / 4), expected(width / 4, height / 4);
    for (const auto [x, y] : all_pixels(width, height)) {
        shown(x / 4, y / 4) += luminance(found.color(x, y));
        expected(x / 4, y / 4) += luminance(truth.color(x, y));
    }
    for (std::size_t i = 0; i < shown.size(); ++i) EXPECT_NEAR(shown.pixels[i] / expected.pixels[i], 1.0, 0.05) << i;
    EXPECT_LT(found.error_shares.beyond, 0.01);
    EXPECT_LT(found.counts.samples, 400u * width * height);
}

}  // namespace
}  // namespace aleph
