// A gather's estimate of its own noise against the spread over seeds.

#include <gtest/gtest.h>

#include "tests/support/render_scenes.h"

namespace aleph {
namespace {

/// A cluttered room with lamps that cast shadows.
Scene make_room() {
    Scene scene;
    const int grey = add_lambert(scene, glm::dvec3(0.5), glm::dvec3(0.0), true);
    const int dark = add_lambert(scene, glm::dvec3(0.05), glm::dvec3(0.0), true);
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(20.0));
    add_mesh(scene, make_box({4.0, 3.0, 5.0}, grey));
    for (int i = 0; i < 32; ++i) {
        const double turn = 2.4 * i, across = 0.6 + 0.035 * i;
        add_mesh(scene, make_box({0.15, 0.3 + 0.02 * i, 0.2}, i % 2 == 0 ? dark : grey),
                 {across * std::cos(turn), -1.2 + 0.08 * i, across * std::sin(turn)},
                 glm::angleAxis(turn, glm::dvec3(0.0, 1.0, 0.0)));
    }
    for (const double x : {-1.2, 0.0, 1.2}) {
        for (const double z : {-1.5, 1.5}) add_mesh(scene, make_quad(0.2, 0.2, lamp), {x, 1.4, z}, z_to_down);
    }
    return scene;
}

/// The mean over points. At single points, where light varies smoothly, the estimate is up to twice the spread.
TEST(GatherNoise, TheEstimateIsTheSpreadOverSeeds) {
    const Stage stage(make_room());
    RayTask task(stage.rays);
    GatherScratch scratch;
    const SurfacePoint points[] = {
        make_point({-0.2f, -1.499f, -0.2f}, {0.0f, 1.0f, 0.0f}), make_point({0.3f, -1.499f, 1.2f}, {0.0f, 1.0f, 0.0f}),
        make_point({1.999f, 0.3f, 0.8f}, {-1.0f, 0.0f, 0.0f}), make_point({-1.999f, -0.6f, -0.6f}, {1.0f, 0.0f, 0.0f}),
        make_point({0.4f, 1.499f, 1.5f}, {0.0f, -1.0f, 0.0f})};
    for (const int samples : {16, 61, 256, 1024}) {
        double ratio = 0.0;
        for (const SurfacePoint& point : points) {
            Mean light, variance;
            for (std::uint32_t seed = 0; seed < 64; ++seed) {
                const IrradianceSample sample =
                    gather_irradiance(stage.lighting(), task, point, choose_strata(samples), {seed, 7, 0, 0}, scratch);
                light.add(luminance(sample.irradiance));
                variance.add(static_cast<double>(sample.relative_error) * sample.relative_error);
            }
            const double spread = light.error() * 8.0 / light.mean();
            ratio += std::sqrt(variance.mean()) / spread / 5.0;
        }
        EXPECT_NEAR(ratio, 1.0, 0.3) << samples;
    }
}

TEST(GatherNoise, EdgesOfTheEstimate) {
    const Stage stage(make_room());
    RayTask task(stage.rays);
    GatherScratch scratch;
    const SurfacePoint point = make_point({-0.2f, -1.499f, -0.2f}, {0.0f, 1.0f, 0.0f});
    const auto error_of = [&](int samples) {
        return gather_irradiance(stage.lighting(), task, point, choose_strata(samples), {}, scratch).relative_error;
    };
    EXPECT_TRUE(std::isinf(error_of(1)));
    EXPECT_TRUE(std::isinf(error_of(2)));
    for (int samples = 16; samples < 64; ++samples) {
        EXPECT_TRUE(std::isfinite(error_of(samples))) << samples;
        EXPECT_GE(choose_strata(samples).rows, 2) << samples;
    }
    Scene dark;
    add_mesh(dark, make_faceted_sphere(2.0, 16, add_lambert(dark, glm::dvec3(0.5))));
    const Stage unlit(std::move(dark));
    RayTask unlit_task(unlit.rays);
    EXPECT_EQ(gather_irradiance(unlit.lighting(), unlit_task, make_point(glm::vec3(0.0f), {0.0f, 1.0f, 0.0f}),
                                choose_strata(64), {}, scratch)
                  .relative_error,
              0.0f);
}

}  // namespace
}  // namespace aleph
