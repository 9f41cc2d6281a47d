// A gather's estimate of its own noise against the spread over seeds.

#include "tests/support/indirect_pictures.h"
#include "tests/support/test.h"
#include "tests/support/trial.h"

namespace aleph {
namespace {

/// The mean over points. At single points, where light varies smoothly, the estimate is up to twice the spread.
TEST(GatherNoise, TheEstimateIsTheSpreadOverSeeds) {
    Gathering room(make_cluttered_room());
    const SurfacePoint points[] = {
        make_point({-0.2f, -1.499f, -0.2f}, {0.0f, 1.0f, 0.0f}), make_point({0.3f, -1.499f, 1.2f}, {0.0f, 1.0f, 0.0f}),
        make_point({1.999f, 0.3f, 0.8f}, {-1.0f, 0.0f, 0.0f}), make_point({-1.999f, -0.6f, -0.6f}, {1.0f, 0.0f, 0.0f}),
        make_point({0.4f, 1.499f, 1.5f}, {0.0f, -1.0f, 0.0f})};
    for (const int samples : {16, 61, 256, 1024}) {
        double ratio = 0.0;
        for (const SurfacePoint& point : points) {
            Mean light, variance;
            for (std::uint32_t seed = 0; seed < 64; ++seed) {
                const IrradianceSample sample = room.gather(point, {choose_strata(samples), {seed, 7, 0, 0}});
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
    Gathering room(make_cluttered_room());
    const auto error_of = [&](int samples) {
        return room.at({-0.2f, -1.499f, -0.2f}, {0.0f, 1.0f, 0.0f}, samples).relative_error;
    };
    EXPECT_TRUE(std::isinf(error_of(1)));
    EXPECT_TRUE(std::isinf(error_of(2)));
    for (int samples = 16; samples < 64; ++samples) {
        EXPECT_TRUE(std::isfinite(error_of(samples))) << samples;
        EXPECT_GE(choose_strata(samples).rows, 2) << samples;
    }
    Scene dark;
    add_mesh(dark, make_faceted_sphere(2.0, 16, add_lambert(dark, glm::dvec3(0.5))));
    EXPECT_EQ(Gathering(std::move(dark)).at(glm::vec3(0.0f), {0.0f, 1.0f, 0.0f}, 64).relative_error, 0.0f);
}

}  // namespace
}  // namespace aleph
