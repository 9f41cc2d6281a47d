// Outlines of lamps and of the sky: emission from many camera rays of each sample.

#include "render/shade/bright_edges.h"

#include "render/frame/sequence.h"
#include "tests/support/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

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
