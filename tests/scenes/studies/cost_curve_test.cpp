#include "scenes/studies/cost_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/studies/reference_light.h"

namespace aleph {
namespace {

TEST(CostCurve, IsLinearInTheLogarithms) {
    const std::vector<CostPoint> points{{10.0, 100.0, 1.0}, {0.1, 10000.0, 4.0}};
    const auto cost = cost_at(points, 1.0, 0.01);
    ASSERT_TRUE(cost);
    EXPECT_NEAR(cost->rays, 1000.0, 1e-6);
    EXPECT_NEAR(cost->seconds, 2.0, 1e-9);
}

TEST(CostCurve, CountsWhereTheCurveStaysBelow) {
    // In any order. The curve falls below 1 % at 20 rays, rises at 30 and stays below from 40 on.
    const std::vector<CostPoint> points{{0.5, 40.0, 4.0}, {4.0, 10.0, 1.0}, {0.9, 20.0, 2.0}, {2.0, 30.0, 3.0}};
    const auto cost = cost_at(points, 1.0, 0.01);
    ASSERT_TRUE(cost);
    EXPECT_NEAR(cost->rays, std::sqrt(30.0 * 40.0), 1e-6);
}

TEST(CostCurve, SaysNothingOutsideOfWhatWasMeasured) {
    const std::vector<CostPoint> points{{4.0, 10.0, 1.0}, {2.0, 20.0, 2.0}};
    EXPECT_FALSE(cost_at(points, 1.0, 0.01));  // tighter than all
    EXPECT_FALSE(cost_at(points, 5.0, 0.01));  // looser than all
    EXPECT_FALSE(cost_at({}, 1.0, 0.01));
    EXPECT_TRUE(cost_at(points, 3.0, 0.01));
}

TEST(CostCurve, ShareOfZeroCountsAsTheLeast) {
    const auto cost = cost_at({{1.0, 10.0, 1.0}, {0.0, 1000.0, 1.0}}, 0.1, 0.01);
    ASSERT_TRUE(cost);
    EXPECT_NEAR(cost->rays, 100.0, 1e-6);
}

TEST(LightError, ComparesWithThresholdAndNoise) {
    const PixelGrid grid{1};
    ReferenceLight reference{{Image<float>(4, 1, 1.0f), Image<float>(4, 1, 1.2f)}};
    reference.halves[0](3, 0) = reference.halves[1](3, 0) = -1.0f;  // nothing reflects
    Image<float> light(4, 1, 1.1f);
    light(0, 0) = 1.3f;
    const LightError error = measure_light(light, reference, grid, Image<float>(4, 1, 0.1f));
    EXPECT_EQ(error.pixels, 3u);
    EXPECT_NEAR(error.worst(), 2.0, 1e-5);
    EXPECT_NEAR(error.percent_beyond(1.0), 100.0 / 3.0, 1e-9);
    EXPECT_NEAR(error.percent_beyond(2.5), 0.0, 1e-9);
    EXPECT_NEAR(error.bias, 0.2 / 3.3, 1e-6);
    EXPECT_NEAR(error.relative_mse, 0.04 / 3.0 / (1.1 * 1.1 * 1.0001), 1e-5);
    EXPECT_NEAR(error.noise_mse, 0.01 / (1.1 * 1.1 * 1.0001), 1e-5);
}

}  // namespace
}  // namespace aleph
