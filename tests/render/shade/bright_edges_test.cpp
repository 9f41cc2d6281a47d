// Outlines of lamps and of the sky: where they are, their emission from camera rays alone, and thresholds beside lamps.

#include "render/frame/sequence.h"
#include "render/guide/stopping_rule.h"
#include "render/shade/edge_light.h"
#include "tests/support/scenes/render_scenes.h"
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

BrightEdges find_edges(const Stage& stage, double exposure = 1.0, std::uint64_t* rays_cast = nullptr) {
    std::uint64_t rays = 0;
    const SampleHits centers = cast_centers(stage.rays, stage.view, nullptr);
    BrightEdges edges = find_bright_edges(stage.lighting(), stage.view, centers, PixelFilter::blackman_harris, exposure,
                                          rays_cast != nullptr ? *rays_cast : rays);
    return edges;
}

/// 1: a pixel takes light from rays of its own.
Image<std::uint8_t> mark_edges(const BrightEdges& edges) {
    Image<std::uint8_t> marks = edges.sky;
    for (const BrightPiece& piece : edges.pieces) marks(piece.x, piece.y) = 1;
    return marks;
}

/// Light that the pixels at the outline of a lamp show by themselves.
std::vector<EdgeLight> find_light(const Stage& stage, float tolerance, int most, std::uint32_t seed) {
    std::uint64_t rays = 0;
    SamplingPlan plan;
    plan.most = most;
    plan.white = 1.0;
    if (tolerance > 0.0f) plan.tolerance = Image<float>(edges_width, edges_height, tolerance);
    const SamplePlace place{.centered = false, .filter = PixelFilter::blackman_harris, .seed = seed};
    return find_edge_light({stage.lighting(), stage.view}, place, plan, find_edges(stage), rays).pixels;
}

TEST(BrightEdges, TakeAsManyRaysAsTheirErrorAsksFor) {
    // Pixels that a faint lamp covers in part; those that are shown white need no more rays.
    constexpr float white = 1.0f;
    const Stage stage(make_quad_before(glm::dvec3(3.0), glm::dvec3(0.0)), edges_width, edges_height);
    const std::vector<EdgeLight> truth = find_light(stage, 0.0f, 4096, 9);
    for (const float tolerance : {0.03f, 0.01f}) {
        double squares = 0.0, told = 0.0;
        for (std::uint32_t seed = 0; seed < 4; ++seed) {
            const std::vector<EdgeLight> found = find_light(stage, tolerance, 4096, seed);
            ASSERT_EQ(found.size(), truth.size());
            for (std::size_t i = 0; i < found.size(); ++i) {
                if (truth[i].mean.x > white) continue;
                squares += std::pow(luminance(found[i].mean) - luminance(truth[i].mean), 2.0);
                told += double{found[i].variance};
            }
        }
        EXPECT_LT(squares, 1.2 * told) << tolerance;
        EXPECT_GT(squares, 0.1 * told) << tolerance;
        const double pixels = 4.0 * edges_width * edges_height;
        EXPECT_LT(told, 0.25 * pixels * std::pow(double{tolerance} / error_deviations, 2.0)) << "energy";
    }
}

TEST(BrightEdges, AreNotDarkerWhereFewRaysMeetALamp) {
    // A lamp of 1/250 of a pixel: the first rays of most pixels miss it, which must not bias the mean.
    const double side = std::sqrt(1.0 / 250.0) / pixels_per_meter();
    Scene scene;
    scene.environment.radiance.reset();
    add_mesh(scene, make_quad(side, side, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(250.0))));
    add_camera(scene, {0.0, 0.0, quad_distance}, glm::dvec3(0.0), quad_fov);
    const Stage stage(scene, edges_width, edges_height);
    // Between four pixels: their filters' densities over the lamp, along x and y.
    double density = 0.0;
    constexpr int steps = 1000;
    for (int i = 0; i < steps; ++i) {
        const double place = ((i + 0.5) / steps - 0.5) * std::sqrt(1.0 / 250.0);
        for (const double from : {-1.5, -0.5, 0.5, 1.5})
            density += filter_density(PixelFilter::blackman_harris, from + place) / steps;
    }
    const double expected = density * density;
    double sum = 0.0;
    constexpr std::uint32_t seeds = 100;
    for (std::uint32_t seed = 0; seed < seeds; ++seed)
        for (const EdgeLight& light : find_light(stage, 0.1f, 64, seed)) sum += double{light.mean.x} / seeds;
    EXPECT_NEAR(sum / expected, 1.0, 0.005);
}

/// Balls or a ring of 16 small lamps in one mesh, pixels, between pixels' centres.
Stage make_small_lamps(bool ring) {
    Scene scene;
    scene.environment.radiance.reset();
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(300.0));
    const double pixel = 1.0 / pixels_per_meter();
    const auto add = [&](Mesh mesh) {
        for (const double x : {-7.3, 0.0, 4.6}) add_mesh(scene, mesh, {x * pixel, 0.4 * x * pixel, 0.0});
    };
    if (ring) {
        Mesh mesh;
        for (unsigned i = 0; i < 16; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / 16.0;
            for (const glm::dvec2& corner : {glm::dvec2(0.0), {0.02, 0.0}, {0.0, 0.02}})
                mesh.positions.emplace_back(
                    pixel * glm::dvec3(0.4 * std::cos(angle) + corner.x, 0.4 * std::sin(angle) + corner.y, 0.0));
            mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
        }
        mesh.material = lamp;
        add(std::move(mesh));
    } else {
        add(make_faceted_sphere(0.4 * pixel, 24, lamp));
    }
    add_camera(scene, {0.0, 0.0, quad_distance}, glm::dvec3(0.0), quad_fov);
    return Stage(scene, edges_width, edges_height);
}

TEST(BrightEdges, LampsSmallerThanPixelsAreOnePiece) {
    const Stage stage = make_small_lamps(false);
    const BrightEdges edges = find_edges(stage);
    ASSERT_EQ(edges.outlines.size(), 3u);
    Image<int> counts(edges_width, edges_height);
    for (const BrightPiece& piece : edges.pieces) EXPECT_EQ(++counts(piece.x, piece.y), 1);
    // All of their light, by few rays: the outlines hold what the triangles show.
    double sum = 0.0;
    for (const EdgeLight& light : find_light(stage, 0.0f, 64, 1)) sum += double{light.mean.x};
    const double expected = 300.0 * 3.0 * 0.5 * 24.0 * 0.16 * std::sin(2.0 * std::numbers::pi / 24.0);
    EXPECT_NEAR(sum / expected, 1.0, 0.01);
}

TEST(BrightEdges, LampsThatLeaveMostOfTheirOutlineAreTriangles) {
    const BrightEdges edges = find_edges(make_small_lamps(true));
    EXPECT_TRUE(edges.outlines.empty());
    EXPECT_GE(edges.pieces.size(), 3u * 16u);
    for (const BrightPiece& piece : edges.pieces) EXPECT_NE(piece.primitive, no_index);
}

TEST(BrightEdges, LeaveTheSamplesOfPixelsAroundAsFewAsWithoutALamp) {
    const auto count = [](double lamp) {
        const Scene scene = make_quad_before(glm::dvec3(lamp), glm::dvec3(0.4));
        RenderSettings settings{.picture = {.width = 64, .height = 48}};
        follow_error(settings, 1.0);
        return static_cast<double>(Sequence(scene, settings).render(0).shaded.counts.samples) / (64 * 48);
    };
    EXPECT_LT(count(300.0), 1.5 * count(0.4));
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
    const Image<std::uint8_t> edges = mark_edges(find_edges(stage));
    for (const auto [x, y] : all_pixels(edges_width, edges_height)) {
        const bool near = std::abs(x - edges_width / 2) <= 1 && std::abs(y - (edges_height / 2 - 1)) <= 1;
        EXPECT_EQ(edges(x, y), near ? 1 : 0) << x << ' ' << y;
    }
    EXPECT_TRUE(find_edges(stage, 1e-3).pieces.empty()) << "dark";
}

TEST(BrightEdges, AreWhereALampIsTooThinForCentres) {
    // Twenty pixels wide and a tenth of one high, just below the centres of a row.
    Scene scene;
    scene.environment.radiance.reset();
    const double pixel = 1.0 / pixels_per_meter();
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(300.0));
    add_mesh(scene, make_quad(20.0 * pixel, 0.1 * pixel, lamp), {0.0, 0.2 * pixel, 0.0});
    add_mesh(scene, make_quad(20.0 * pixel, 0.1 * pixel, lamp), {0.0, -9.0 * pixel, 0.0},
             glm::angleAxis(std::numbers::pi, glm::dvec3(0.0, 1.0, 0.0)));  // seen from behind
    add_camera(scene, {0.0, 0.0, quad_distance}, glm::dvec3(0.0), quad_fov);
    const Stage stage(scene, edges_width, edges_height);
    const Image<std::uint8_t> edges = mark_edges(find_edges(stage));
    for (const auto [x, y] : all_pixels(edges_width, edges_height)) {
        const bool near = x >= 5 && x < 27 && std::abs(y - (edges_height / 2 - 1)) <= 1;
        EXPECT_EQ(edges(x, y), near ? 1 : 0) << x << ' ' << y;
    }
    double sum = 0.0;
    for (const EdgeLight& light : find_light(stage, 0.3f, 4096, 0)) sum += double{light.mean.x};
    EXPECT_NEAR(sum / 300.0, 2.0, 0.03);
}

TEST(BrightEdges, AreWhereTheFilterCrossesAnOutline) {
    const Stage stage(make_quad_before(glm::dvec3(2.0), glm::dvec3(0.0)), edges_width, edges_height);
    const auto is_lit = [&](double x, double y) {
        const CameraRay ray = make_camera_ray(stage.view, x, y);
        return Tracer(stage.rays).intersect(to_scene(stage.rays, ray)).instance != no_index;
    };
    const Image<std::uint8_t> edges = mark_edges(find_edges(stage));
    int found = 0;
    for (const auto [x, y] : all_pixels(edges_width, edges_height)) {
        int lit = 0;
        constexpr int steps = 20;
        for (int i = 0; i < steps * steps; ++i)
            lit += is_lit(x - 1.0 + 3.0 * (i % steps + 0.5) / steps, y - 1.0 + 3.0 * (i / steps + 0.5) / steps) ? 1 : 0;
        if (lit == 0) found += edges(x, y);
        if (lit == 0 || lit == steps * steps) continue;
        EXPECT_EQ(edges(x, y), 1) << x << " " << y;
    }
    EXPECT_LE(found, 8) << "corners between the places";
    for (const std::uint8_t edge : mark_edges(find_edges(stage, 0.2)).pixels) EXPECT_EQ(edge, 0) << "too dark";
}

TEST(BrightEdges, AreNotInsideOfAHiddenLamp) {
    Scene scene = make_quad_before(glm::dvec3(300.0), glm::dvec3(0.0));
    add_mesh(scene, make_quad(3.0, 3.0, add_lambert(scene, glm::dvec3(0.5))), {0.0, 0.0, 0.1});
    const Stage stage(scene, edges_width, edges_height);
    EXPECT_EQ(mark_edges(find_edges(stage))(edges_width / 2, edges_height / 2), 0);
    for (const EdgeLight& light : find_light(stage, 0.3f, 4096, 0)) EXPECT_EQ(light.mean, Rgb(0.0f));
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
    const Image<std::uint8_t> edges = mark_edges(find_edges(stage, 1.0, &rays));
    for (int x = 0; x < edges_width; ++x) EXPECT_EQ(edges(x, edges_height / 2), x >= edges_width - 1 ? 1 : 0) << x;
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
