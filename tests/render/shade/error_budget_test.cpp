// Tolerances of samples, from thresholds and the error that is asked for; and what that error must not leave out.
// Outlines of lamps and of the sky: emission from many camera rays of each sample.

#include "render/frame/sequence.h"
#include "render/guide/stopping_rule.h"
#include "render/shade/bright_edges.h"
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

constexpr int edges_width = 32, edges_height = 24;
constexpr double quad_distance = 4.0, quad_fov = 0.8;

/// At the quad's distance.
double pixels_per_meter() {
    return edges_height / (2.0 * quad_distance * std::tan(0.5 * quad_fov));
}

Scene make_quad_before(const glm::dvec3& emission, const glm::dvec3& sky) {
    Scene scene;
    scene.film.exposure = 1.0;
    scene.environment.radiance = Track<glm::dvec3>(sky);
    const int lamp = add_lambert(scene, glm::dvec3(0.0), emission);
    add_mesh(scene, make_quad(1.37, 0.93, lamp), {0.11, 0.07, 0.0}, glm::angleAxis(0.3, glm::dvec3(0.0, 0.0, 1.0)));
    add_camera(scene, {0.0, 0.0, quad_distance}, glm::dvec3(0.0), quad_fov);
    return scene;
}

double sum_of_red(const Image<Rgb>& picture) {
    double sum = 0.0;
    for (const Rgb& value : picture.pixels) sum += value.x;
    return sum;
}

TEST(BrightEdges, TheSumIsTheEmittersAreaWithFewSamples) {
    const double pixels = 1.37 * 0.93 * std::pow(pixels_per_meter(), 2.0);
    for (const PixelFilter filter : {PixelFilter::box, PixelFilter::blackman_harris}) {
        for (const bool sky : {false, true}) {
            const double outside = edges_width * edges_height - pixels;
            const Stage stage(sky ? make_quad_before(glm::dvec3(0.0), glm::dvec3(300.0))
                                  : make_quad_before(glm::dvec3(300.0), glm::dvec3(0.0)),
                              edges_width, edges_height);
            for (const bool paths : {false, true}) {
                RenderSettings settings = paths ? path_settings(1, 2) : plain_settings(0.0, 1);
                settings.sampling.spp = 2;
                settings.picture.filter = filter;
                const double expected = 300.0 * (sky ? outside : pixels);
                const double found = sum_of_red(shade(stage, settings).color);
                EXPECT_NEAR(found, expected, 300.0 * 0.02 * pixels) << sky << paths;
            }
        }
    }
}

TEST(BrightEdges, APixelAtTheOutlineNeedsFewSamples) {
    const Stage stage(make_quad_before(glm::dvec3(300.0), glm::dvec3(0.0)), edges_width, edges_height);
    RenderSettings settings = plain_settings(0.0, 1);
    settings.sampling.spp = 1024;
    const Image<Rgb> truth = shade(stage, settings).color;
    settings.sampling.spp = 4;
    settings.seed = 7;
    const Image<Rgb> few = shade(stage, settings).color;
    double squares = 0.0, of_samples = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double share = truth.pixels[i].x / 300.0;
        squares += std::pow(few.pixels[i].x / 300.0 - share, 2.0);
        of_samples += share * (1.0 - share) / 4.0;  // of independent samples
    }
    EXPECT_GT(of_samples, 0.5);
    EXPECT_LT(squares, 0.05 * of_samples);
}

TEST(BrightEdges, AreWhereALampLiesThatNoCentreMeets) {
    // A twentieth of a pixel wide, beside a pixel's centre.
    const double side = 0.05 / pixels_per_meter(), away = 0.3 / pixels_per_meter();
    Scene scene;
    scene.environment.radiance.reset();
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(300.0));
    add_mesh(scene, make_quad(side, side, lamp), {away, away, 0.0});
    add_mesh(scene, make_quad(side, side, lamp), {0.0, 0.0, 2.0 * quad_distance});  // behind the camera
    add_camera(scene, {0.0, 0.0, quad_distance}, glm::dvec3(0.0), quad_fov);
    const Stage stage(scene, edges_width, edges_height);
    const SampleHits centers = cast_centers(stage.rays, stage.view, nullptr);
    std::uint64_t rays = 0;
    const Image<std::uint8_t> edges = find_bright_edges(stage.lighting(), stage.view, centers, 1.0, rays);
    for (const auto [x, y] : all_pixels(edges_width, edges_height)) {
        const bool near = std::abs(x - edges_width / 2) <= 2 && std::abs(y - (edges_height / 2 - 1)) <= 2;
        EXPECT_EQ(edges(x, y), near ? 1 : 0) << x << ' ' << y;
    }
    EXPECT_EQ(find_bright_edges(stage.lighting(), stage.view, centers, 1e-3, rays).pixels,
              Image<std::uint8_t>(edges_width, edges_height).pixels)
        << "dark";
}

TEST(BrightEdges, AreWhereSomeOfTheNeighboursAreBright) {
    const Stage stage(make_quad_before(glm::dvec3(2.0), glm::dvec3(0.0)), edges_width, edges_height);
    const SampleHits centers = cast_centers(stage.rays, stage.view, nullptr);
    const auto find = [&](double exposure) {
        std::uint64_t rays = 0;
        return find_bright_edges(stage.lighting(), stage.view, centers, exposure, rays);
    };
    const Image<std::uint8_t> edges = find(1.0);
    int found = 0;
    for (const auto [x, y] : all_pixels(edges_width, edges_height)) {
        int bright = 0, all = 0;
        for (int ny = std::max(0, y - 2); ny <= std::min(edges_height - 1, y + 2); ++ny) {
            for (int nx = std::max(0, x - 2); nx <= std::min(edges_width - 1, x + 2); ++nx) {
                ++all;
                bright += centers.hits(nx, ny).instance != no_index ? 1 : 0;
            }
        }
        EXPECT_EQ(edges(x, y) != 0, bright > 0 && bright < all) << x << " " << y;
        found += edges(x, y);
    }
    EXPECT_GT(found, 30);
    EXPECT_LT(found, edges_width * edges_height / 2);
    for (const std::uint8_t edge : find(0.2).pixels) EXPECT_EQ(edge, 0) << "too dark";
}

TEST(BrightEdges, AreWhereALampBeginsOutsideThePicture) {
    // From a fifth of a pixel beyond the right border.
    const double side = 1.0, left = (edges_width / 2 + 0.2) / pixels_per_meter();
    Scene scene;
    scene.environment.radiance.reset();
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(300.0));
    add_mesh(scene, make_quad(side, side, lamp), {left + 0.5 * side, 0.0, 0.0});
    add_camera(scene, {0.0, 0.0, quad_distance}, glm::dvec3(0.0), quad_fov);
    const Stage stage(scene, edges_width, edges_height);
    std::uint64_t rays = 0;
    const Image<std::uint8_t> edges =
        find_bright_edges(stage.lighting(), stage.view, cast_centers(stage.rays, stage.view, nullptr), 1.0, rays);
    for (int x = 0; x < edges_width; ++x) EXPECT_EQ(edges(x, edges_height / 2), x >= edges_width - 2 ? 1 : 0) << x;
    EXPECT_EQ(rays, (edges_width + 4u) * (edges_height + 4u) - edges.size());
}

TEST(NoiseThreshold, AdaptationIsToWhatTheDisplayShows) {
    // A grey of half of white, with a quad of as much and with a lamp of ten thousand times as much in it.
    const auto threshold_beside = [](double lamp) {
        Scene scene = make_quad_before(glm::dvec3(lamp), glm::dvec3(0.5));
        const RenderSettings settings{.error = 1.0, .picture = {.width = 64, .height = 48}};
        const FrameOutput output = Sequence(scene, settings).render(0, {.frame = false, .maps = true, .progress = {}});
        return output.limits.threshold_noise(32, 40);  // below the quad, within the reach of adaptation
    };
    const float without = threshold_beside(0.5), with = threshold_beside(5000.0);
    EXPECT_GT(with, without);
    EXPECT_LT(with, 6.0f * without);
}

}  // namespace
}  // namespace aleph
