// Suns smaller than a pixel: parts of the environment's picture, which of them pixels aim at, and the light that they
// find.

#include "render/shade/bright_sky.h"

#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int sun_picture_width = 24, sun_picture_height = 18;
constexpr double sun_fov = 0.6;

glm::dvec3 sky_direction(double u, double v) {
    const double azimuth = (u - 0.5) * 2.0 * std::numbers::pi, polar = v * std::numbers::pi;
    return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

/// A picture with one bright texel, seen by a camera that looks past it.
struct Sun {
    int x = 0, y = 0;  ///< of the texel
    double radiance = 1000.0;
    int width = 512;
    glm::dquat turn = no_turn;  ///< of the picture

    Scene make_scene(const Rgb& sky) const {
        Scene scene;
        scene.film.exposure = 1.0;
        Image<Rgb> picture(width, width / 2, sky);
        picture(x, y) = Rgb(static_cast<float>(radiance));
        add_surroundings(scene, picture);
        scene.environment.rotation = Track<glm::dquat>(turn);
        const double away = 0.3 * sun_fov / sun_picture_height;
        const glm::dvec3 at = turn * sky_direction((x + 0.5) / width, (y + 0.5) / (width / 2));
        add_camera(scene, glm::dvec3(0.0), at + glm::dvec3(away, away, 0.5 * away), sun_fov);
        return scene;
    }

    /// The sum over all pixels, by small squares of the four cells around the texel.
    double find_sum(const Stage& stage) const {
        constexpr int steps = 200;
        const double height = width / 2, pi_ = std::numbers::pi;
        double sum = 0.0;
        for (int i = 0; i < steps * steps; ++i) {
            const double u = (x - 0.5 + 2.0 * (i % steps + 0.5) / steps) / width;
            const double v = (y - 0.5 + 2.0 * (i / steps + 0.5) / steps) / height;
            if (v < 0.0 || v > 1.0) continue;
            const glm::dvec3 at = turn * sky_direction(u, v);
            const double cosine = -glm::dot(at, stage.view.axes[2]);
            const double angle = std::sin(pi_ * v) * (2.0 / steps * pi_ / height) * (2.0 / steps * 2.0 * pi_ / width);
            sum += double{environment_radiance(stage.shading, glm::vec3(at)).x} * angle / std::pow(cosine, 3.0);
        }
        return sum * std::pow(stage.view.pixels_per_unit, 2.0);
    }
};

/// The sum of all pixels.
double find_sum_of_samples(const Stage& stage, PixelFilter filter, std::uint32_t seed) {
    RenderSettings settings = plain_settings(0.0, 1);
    settings.sampling.spp = 64;
    settings.picture.filter = filter;
    settings.seed = seed;
    double sum = 0.0;
    for (const Rgb& value : shade(stage, settings).color.pixels) sum += double{value.x};
    return sum;
}

/// In the mean over seeds.
double find_sum_of_samples(const Stage& stage, PixelFilter filter) {
    constexpr int seeds = 16;
    double sum = 0.0;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) sum += find_sum_of_samples(stage, filter, seed) / seeds;
    return sum;
}

BrightEdges find_sky_pieces(const Stage& stage, int* most_of_pixel = nullptr) {
    BrightEdges edges;
    add_bright_sky(stage.shading, stage.view, PixelFilter::blackman_harris, 1.0, edges);
    Image<int> counts(stage.view.width, stage.view.height);
    for (const BrightPiece& piece : edges.pieces) ++counts(piece.x, piece.y);
    if (most_of_pixel != nullptr) *most_of_pixel = *std::ranges::max_element(counts.pixels);
    return edges;
}

TEST(EnvironmentCells, SurroundTheDirectionsOfTheirParts) {
    std::mt19937 engine(5);
    std::normal_distribution<double> normal;
    for (const auto& [width, height, step] : {std::array{64, 32, 1}, {64, 32, 4}, {37, 11, 2}, {4096, 2048, 1}}) {
        Scene scene;
        add_surroundings(scene, Image<Rgb>(width, height, Rgb(1.0f)));
        const EnvironmentMap map = make_environment_map(scene.images[0]);
        const EnvironmentCells cells(map, step);
        for (int i = 0; i < 5000; ++i) {
            const double thin = i % 2 == 0 ? 1.0 : 0.01;  // every other one is near a pole
            const glm::dvec3 at =
                glm::normalize(glm::dvec3(thin * normal(engine), normal(engine), thin * normal(engine)));
            const int part = cells.find(glm::vec3(at));
            ASSERT_LT(part, cells.count());
            const std::array<glm::dvec3, 4> corners = cells.surround(part);
            for (int c = 0; c < 4; ++c)
                ASSERT_GE(glm::dot(glm::cross(corners[c], corners[(c + 1) % 4]), at), 0.0) << width << ' ' << part;
            int found = 0;
            cells.visit_parts(cells.find_in_cone(at, 0.05), [&](int p) { found += p == part ? 1 : 0; });
            ASSERT_EQ(found, 1) << width << ' ' << part;
        }
        std::vector<int> visits(static_cast<std::size_t>(cells.count()));
        cells.visit_parts(cells.find_in_cone({0.0, 1.0, 0.0}, std::numbers::pi), [&](int part) { ++visits[part]; });
        EXPECT_EQ(std::ranges::count(visits, 1), cells.count());
    }
}

TEST(BrightSky, ASunThatNoCentreMeetsIsAsBrightAsItIs) {
    const glm::dquat turn = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1.0, 2.0, -1.0)));
    for (const Sun& sun :
         {Sun{.x = 260, .y = 120}, Sun{.x = 511, .y = 90}, Sun{.x = 0, .y = 140}, Sun{.x = 40, .y = 0, .radiance = 3e4},
          Sun{.x = 300, .y = 255, .radiance = 3e4}, Sun{.x = 10, .y = 30, .turn = turn},
          Sun{.x = 2000, .y = 900, .radiance = 3e4, .width = 4096}}) {
        const Stage stage(sun.make_scene(Rgb(0.0f)), sun_picture_width, sun_picture_height);
        const double expected = sun.find_sum(stage);
        EXPECT_GT(expected, 1.0);
        for (const PixelFilter filter : {PixelFilter::box, PixelFilter::blackman_harris})
            EXPECT_NEAR(find_sum_of_samples(stage, filter) / expected, 1.0, 0.05) << sun.x << ' ' << sun.y;
    }
}

TEST(BrightSky, RaysAreEvenOverTheCellsOfASun) {
    // Cells smaller than a pixel, and larger ones, of which its filter sees little of some.
    constexpr int seeds = 16;
    for (const auto& [width, most] : {std::pair{512, 0.008}, std::pair{64, 0.0015}}) {
        const Sun sun{.x = width / 2, .y = width / 4, .width = width};
        const Stage stage(sun.make_scene(Rgb(0.0f)), sun_picture_width, sun_picture_height);
        const double mean = find_sum_of_samples(stage, PixelFilter::blackman_harris);
        double squares = 0.0;
        for (std::uint32_t seed = 0; seed < seeds; ++seed)
            squares += std::pow(find_sum_of_samples(stage, PixelFilter::blackman_harris, seed) / mean - 1.0, 2.0);
        EXPECT_LT(std::sqrt(squares / seeds), most) << width;
    }
}

TEST(BrightSky, SurfacesCoverWhatLiesBehindThem) {
    // Half of the sun.
    const Sun sun{.x = 256, .y = 128};
    Scene scene = sun.make_scene(Rgb(0.0f));
    const glm::dvec3 at = sky_direction((sun.x + 0.5) / sun.width, (sun.y + 0.5) / (sun.width / 2));
    add_mesh(scene, make_quad(2.0, 10.0, add_lambert(scene, glm::dvec3(0.0))), {at.x / -at.z * 5.0 - 1.0, 0.0, -5.0});
    const Stage stage(scene, sun_picture_width, sun_picture_height);
    EXPECT_NEAR(find_sum_of_samples(stage, PixelFilter::blackman_harris) / sun.find_sum(stage), 0.5, 0.03);
}

TEST(BrightSky, EvenSkiesAndSlowChangesHaveNoPieces) {
    const auto count = [](const auto& radiance) {
        Scene scene;
        Image<Rgb> picture(256, 128);
        for (const auto [x, y] : all_pixels(256, 128)) picture(x, y) = Rgb(static_cast<float>(radiance(x, y)));
        add_surroundings(scene, picture);
        add_camera(scene, glm::dvec3(0.0), {0.0, 0.0, -1.0}, sun_fov);
        return find_sky_pieces(Stage(scene, sun_picture_width, sun_picture_height)).pieces.size();
    };
    EXPECT_EQ(count([](int, int) { return 5.0; }), 0u);
    EXPECT_EQ(count([](int, int y) { return 0.01 * std::pow(1.5, std::abs(y - 64.0)); }), 0u) << "gradient";
    EXPECT_EQ(count([](int x, int y) { return (x + y) % 2 == 0 ? 1.0 : 0.3; }), 0u) << "clouds";
    EXPECT_EQ(count([](int x, int) { return x == 128 ? 0.4 : 0.0; }), 0u) << "dark";
    EXPECT_EQ(count([](int x, int y) { return (x + y) % 2 == 0 ? 40.0 : 1.1; }), 0u) << "white";
    EXPECT_GT(count([](int x, int) { return x == 128 ? 40.0 : 0.0; }), 0u);
}

TEST(BrightSky, PiecesAreNoSmallerThanPixelsNeed) {
    // The same sun of one degree, in pictures of ever more texels.
    for (const int width : {1024, 4096}) {
        Scene scene;
        Image<Rgb> picture(width, width / 2, Rgb(0.5f));
        for (const auto [x, y] : all_pixels(width, width / 2))
            if (std::hypot(x - 0.5 * width, y - 0.25 * width) < width / 720.0) picture(x, y) = Rgb(1000.0f);
        add_surroundings(scene, picture);
        add_camera(scene, glm::dvec3(0.0), {0.0, 0.0, -1.0}, 1.5);
        int most = 0;
        const Stage stage(scene, sun_picture_width, sun_picture_height);
        EXPECT_FALSE(find_sky_pieces(stage, &most).pieces.empty());
        EXPECT_LE(most, 30) << width;
    }
}

}  // namespace
}  // namespace aleph
