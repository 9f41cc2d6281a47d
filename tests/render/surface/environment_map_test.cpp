// Pictures around a scene: what is cleaned, look-ups at seam and poles, the density of samples, and their light.

#include "render/surface/environment_map.h"
#include "tests/support/path_estimates.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

EnvironmentMap make_map(const Image<Rgb>& picture) {
    Scene scene;
    add_surroundings(scene, picture);
    return make_environment_map(scene.images[0]);
}

/// A picture whose texels differ by a factor of up to 1000.
Image<Rgb> make_uneven_picture(int width, int height) {
    Image<Rgb> picture(width, height);
    std::mt19937 engine(11);
    std::uniform_real_distribution<float> power(-3.0f, 0.0f);
    for (Rgb& texel : picture.pixels) texel = Rgb(std::pow(10.0f, power(engine)), 0.1f, 0.0f);
    return picture;
}

glm::vec3 direction_at(double u, double v) {
    const double azimuth = (u - 0.5) * 2.0 * pi, polar = v * pi;
    return glm::vec3(std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth));
}

TEST(EnvironmentMap, AConstantPictureIsAConstantEnvironment) {
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(2, 1), std::pair(1, 8), std::pair(16, 8)}) {
        const EnvironmentMap map = make_map(Image<Rgb>(width, height, Rgb(0.5f, 1.0f, 2.0f)));
        EXPECT_FALSE(map.black);
        EXPECT_NEAR(map.mean_luminance, luminance(Rgb(0.5f, 1.0f, 2.0f)), 1e-6);
        EXPECT_TRUE(holds([&](Trial& trial) {
            RandomStream random({2 + trial.seed, 0, 0, 0});
            Mean up;
            for (int i = 0; i < trial.times(2000); ++i) {
                const EnvironmentSample sample = sample_environment(map, random.next_2d());
                ASSERT_NEAR(sample.pdf, 1.0 / (4.0 * pi), 1e-4 / (4.0 * pi));
                ASSERT_NEAR(glm::length(sample.direction), 1.0f, 1e-6f);
                ASSERT_NEAR(look_up(map, sample.direction).z, 2.0f, 1e-6f);
                up.add(sample.direction.y);
            }
            trial.near(up, 0.0);
        }));
    }
}

TEST(EnvironmentMap, MC24_DensitiesOfManyRowsAreExactAtBothPoles) {
    constexpr int rows = 4096;
    const EnvironmentMap map = make_map(Image<Rgb>(2, rows, Rgb(1.0f)));
    for (int y = 0; y < rows; ++y) {
        const float density = pdf_environment(map, direction_at(0.3, (y + 0.5) / rows));
        ASSERT_NEAR(density * 4.0 * pi, 1.0, 1e-4) << y;
    }
}

TEST(EnvironmentMap, MC24_BadTexelsBecomeBlack) {
    Image<Rgb> picture(4, 2, Rgb(1.0f));
    picture(0, 0) = Rgb(float_nan, 0.25f, 1.0f);
    picture(1, 1) = Rgb(1.0f, float_infinity, 1.0f);
    picture(3, 1) = Rgb(-5.0f, -1.0f, 0.5f);
    const EnvironmentMap map = make_map(picture);
    EXPECT_EQ(map.texels(0, 0), Rgb(0.0f, 0.25f, 1.0f));
    EXPECT_EQ(map.texels(1, 1), Rgb(1.0f, 0.0f, 1.0f));
    EXPECT_EQ(map.texels(3, 1), Rgb(0.0f, 0.0f, 0.5f));
    EXPECT_TRUE(std::isfinite(map.mean_luminance));
}

TEST(EnvironmentMap, FX11_MC24_ABlackPictureIsNoLight) {
    Scene scene;
    add_surroundings(scene, Image<Rgb>(8, 4, Rgb(0.0f)));
    add_mesh(scene, make_quad(8.0, 8.0, add_lambert(scene, glm::dvec3(0.8))), {0.0, 0.0, -2.0});
    const Stage stage(std::move(scene), 8, 6);
    EXPECT_EQ(stage.lights.count(), 0);
    EXPECT_EQ(sample_environment(*stage.shading.environment.map, {0.3f, 0.4f}).pdf, 0.0f);
    const ShadedFrame out = shade(stage, path_settings(2, 4));
    for (const Rgb& pixel : out.color.pixels) EXPECT_EQ(pixel, Rgb(0.0f));
    EXPECT_EQ(out.counts.invalid_samples, 0u);
}

TEST(EnvironmentMap, MC24_SeamAndPolesAreContinuous) {
    const EnvironmentMap map = make_map(make_uneven_picture(8, 4));
    for (int i = 1; i < 50; ++i) {
        const double v = i / 50.0;
        // Bilinear: over 1e-6 of the picture a value changes by less than 8e-6 of the largest difference.
        EXPECT_NEAR(look_up(map, direction_at(1e-6, v)).x, look_up(map, direction_at(1.0 - 1e-6, v)).x, 2e-5f);
    }
    for (const float y : {1.0f, -1.0f}) {
        const Rgb pole = look_up(map, {0.0f, y, 0.0f});
        EXPECT_TRUE(is_finite(pole));
        EXPECT_GT(pdf_environment(map, {0.0f, y, 0.0f}), 0.0f);
        const int row = y > 0.0f ? 0 : 3;
        float least = 1.0f, most = 0.0f;
        for (int x = 0; x < 8; ++x) {
            least = std::min(least, map.texels(x, row).x);
            most = std::max(most, map.texels(x, row).x);
        }
        EXPECT_GE(pole.x, least);
        EXPECT_LE(pole.x, most);
    }
    // The middle column lies along -z, u grows towards +x, the top row is +y.
    Image<Rgb> picture(4, 2, Rgb(0.0f));
    picture(3, 0) = Rgb(1.0f);  // u = 7/8: between +x and +z, upper half
    const glm::vec3 there = glm::normalize(glm::vec3(1.0f, std::sqrt(2.0f), 1.0f));
    EXPECT_NEAR(look_up(make_map(picture), there).x, 1.0f, 1e-5f);
}

TEST(EnvironmentMap, SamplesFollowTheirDensity) {
    // Chi-square over 16 x 8 bins of a picture of 8 x 4 texels, against the density integrated over each bin.
    const EnvironmentMap map = make_map(make_uneven_picture(8, 4));
    constexpr int columns = 16, rows = 8;
    std::vector<double> expected(columns * rows);
    double total = 0.0;
    for (const auto [x, y] : all_pixels(columns, rows)) {
        const double solid_angle = 2.0 * pi / columns * (std::cos(pi * y / rows) - std::cos(pi * (y + 1) / rows));
        expected[y * columns + x] =
            solid_angle * pdf_environment(map, direction_at((x + 0.5) / columns, (y + 0.5) / rows));
        total += expected[y * columns + x];
    }
    EXPECT_NEAR(total, 1.0, 1e-5);
    EXPECT_TRUE(holds([&](Trial& trial) {
        const int count = trial.times(100'000);
        std::vector<double> found(columns * rows);
        RandomStream random({5 + trial.seed, 0, 0, 0});
        for (int i = 0; i < count; ++i) {
            const EnvironmentSample sample = sample_environment(map, random.next_2d());
            ASSERT_NEAR(sample.pdf, pdf_environment(map, sample.direction), 1e-4f * sample.pdf);
            const glm::vec3& d = sample.direction;
            const double u = 0.5 + std::atan2(d.x, -d.z) / (2.0 * pi), v = std::acos(std::clamp(d.y, -1.0f, 1.0f)) / pi;
            found[std::min(rows - 1, static_cast<int>(v * rows)) * columns +
                  std::min(columns - 1, static_cast<int>(u * columns))] += 1.0;
        }
        double chi2 = 0.0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double wanted = expected[i] * count;
            chi2 += (found[i] - wanted) * (found[i] - wanted) / wanted;
        }
        constexpr double freedom = columns * rows - 1;
        trial.near(chi2, std::sqrt(2.0 * freedom), freedom, 0.0);
    }));
}

Mean light_on_floor(const Scene& scene, int count, std::uint32_t seed = 0) {
    const Stage stage(scene);
    return estimate(stage, {make_point(glm::vec3(0.0f), up), make_lambert(0.6f), up}, count, by_paths(1, 1), seed);
}

TEST(EnvironmentMap, MC24_ATexelWithNearlyAllLightIsADirectionalLight) {
    constexpr int width = 128, height = 64, column = 90, row = 12;
    Image<Rgb> picture(width, height, Rgb(1e-3f));
    picture(column, row) = Rgb(1e5f);  // of the sphere's 8192 texels: 99.99 % of the light
    const EnvironmentMap map = make_map(picture);
    glm::dvec3 flux(0.0);  // of what exceeds the rest
    constexpr int steps = 90;
    for (int j = 0; j < steps; ++j) {
        for (int i = 0; i < steps; ++i) {
            const double u = (column - 1 + 3.0 * (i + 0.5) / steps) / width;
            const double v = (row - 1 + 3.0 * (j + 0.5) / steps) / height;
            const glm::vec3 d = direction_at(u, v);
            const double solid_angle = 2.0 * pi * pi * std::sin(v * pi) * 9.0 / (steps * steps * width * height);
            flux += glm::dvec3(d) * (solid_angle * (look_up(map, d).x - 1e-3));
        }
    }
    Scene sky, sun;
    add_surroundings(sky, picture);
    const glm::dvec3 from = glm::normalize(flux);
    add_light(sun, Light::Kind::directional, glm::dvec3(glm::length(flux)), glm::dvec3(0.0),
              glm::quatLookAt(-from, glm::dvec3(0.0, 1.0, 0.0)));
    const double expected = light_on_floor(sun, 2).mean() + 0.6e-3;
    EXPECT_TRUE(holds([&](Trial& trial) {
        const Mean found = light_on_floor(sky, trial.times(20'000), trial.seed);
        trial.near(found, expected, 1e-4 * expected);
        EXPECT_LT(found.error(), 0.01 * expected);
    }));
}

TEST(EnvironmentMap, MC24_ATurnedPictureIsATurnedScene) {
    const Image<Rgb> picture = make_uneven_picture(8, 4);
    const glm::dquat turn = glm::angleAxis(1.1, glm::normalize(glm::dvec3(0.3, 1.0, -0.2)));
    Scene still, turned;
    add_surroundings(still, picture);
    add_surroundings(turned, picture);
    turned.environment.rotation = turn;
    const Stage a(still), b(turned);
    RandomStream random({8, 0, 0, 0});
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 d = direction_at(random.next(), random.next());
        const glm::vec3 there(turn * glm::dvec3(d));
        ASSERT_NEAR(environment_radiance(a.shading, d).x, environment_radiance(b.shading, there).x, 1e-4f);
        const glm::vec2 u = random.next_2d();
        const Receiver receiver{glm::vec3(0.0f), up};
        const LightSample one = sample_light(a.shading, a.lights, 0, receiver, u);
        const LightSample other = sample_light(b.shading, b.lights, 0, receiver, u);
        ASSERT_LT(glm::length(glm::vec3(turn * glm::dvec3(one.direction)) - other.direction), 1e-5f);
        ASSERT_NEAR(one.pdf, other.pdf, 1e-4f * one.pdf);
        ASSERT_NEAR(pdf_environment(b.shading, receiver, other.direction), other.pdf, 1e-3f * other.pdf);
    }
}

TEST(EnvironmentMap, MC24_AConstantPictureIsAFurnace) {
    Scene scene;
    add_surroundings(scene, Image<Rgb>(6, 3, Rgb(1.0f)));
    add_mesh(scene, make_faceted_sphere(1.0, 32, add_lambert(scene, glm::dvec3(1.0))));
    add_camera(scene, {0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, 0.7);
    const Stage stage(std::move(scene), 16, 12);
    EXPECT_TRUE(holds([&](Trial& trial) {
        const Mean mean = mean_of_pixels(shade(stage, path_settings(3, trial.times(64), trial.seed)));
        trial.near(mean, 1.0, 1e-4);
        EXPECT_LT(mean.error(), 0.01);
    }));
}

}  // namespace
}  // namespace aleph
