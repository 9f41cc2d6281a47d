// Predicted cost of frames, and the error that a budget chooses.

#include "render/budget/cost_model.h"
#include "render/budget/cost_pilot.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr CostCoefficients coefficients = {
    .shade = 0.8, .overlap = 2.0, .fill = 0.1, .keyframes = 0.5, .shade_exponent = 2.0, .light_exponent = 1.0};

/// A tenth of the pixels at the errors 4 and 1.
PilotSeconds two_errors() {
    return {.start = 0.05,
            .before = 0.02,
            .share = 0.1,
            .keyframes = 2.0,
            .parts = {{4.0, 0.01, 0.03}, {1.0, 0.02, 0.07}},
            .light = {{16.0, 0.01, 0.1}, {4.0, 0.02, 0.3}}};
}

TEST(CostModel, APartIsScaledByItsShare) {
    const CostParts seconds = predict_seconds(two_errors(), {}, coefficients, 4.0);
    EXPECT_DOUBLE_EQ(seconds.start, 0.05);
    EXPECT_DOUBLE_EQ(seconds.before, 0.02);
    EXPECT_NEAR(seconds.shade, 0.3 / 0.8, 1e-12);
}

TEST(CostModel, LightGrowsFromSmallPicturesAsAPowerOfTheirPixels) {
    const CostParts seconds = predict_seconds(two_errors(), {}, coefficients, 4.0);
    EXPECT_NEAR(seconds.fill, 0.02 * 2.0, 1e-12);      // twice as much in four times as many pixels
    EXPECT_NEAR(seconds.keyframes, 0.3 * 3.0, 1e-12);  // three times
    PilotSeconds steep = two_errors();
    steep.light[0].keyframes = 1e-9;
    EXPECT_NEAR(predict_seconds(steep, {}, coefficients, 4.0).keyframes, 0.3 * std::pow(4.0, 1.3), 1e-12);
    PilotSeconds single = two_errors();
    single.light.resize(1);
    EXPECT_NEAR(predict_seconds(single, {}, coefficients, 4.0).keyframes, 0.1 * std::pow(16.0, 0.8), 1e-12);
    single.light.clear();
    EXPECT_EQ(predict_seconds(single, {}, coefficients, 4.0).keyframes, 0.0);
}

TEST(CostModel, LightOfThePartTellsHowItGrowsWithSmallerErrors) {
    const CostParts seconds = predict_seconds(two_errors(), {}, coefficients, 1.0);
    EXPECT_NEAR(seconds.fill, 0.04 + 0.1 * 0.1, 1e-12);
    EXPECT_NEAR(seconds.keyframes, 0.9 + 0.5 * 2.0 * 0.1, 1e-12);
    PilotSeconds by_frame = two_errors();
    by_frame.keyframes = 0.0;
    EXPECT_NEAR(predict_seconds(by_frame, {}, coefficients, 1.0).fill, 0.04 + 0.1 / 2.0, 1e-12);
    EXPECT_NEAR(predict_seconds(by_frame, {}, coefficients, 1.0).shade, 0.7, 1e-12);
}

TEST(CostModel, GrowthIsAPowerLawBetweenAndBelowTheErrors) {
    PilotSeconds pilot = two_errors();
    pilot.parts = {{4.0, 0.0, 0.03}, {2.0, 0.0, 0.04}, {0.5, 0.0, 0.19}};  // grows by 0.01, then by 0.16
    const auto shade = [&](double error) { return 0.08 * predict_seconds(pilot, {}, coefficients, error).shade; };
    EXPECT_NEAR(shade(8.0), 0.03, 1e-12);
    EXPECT_NEAR(shade(1.0), 0.03 + 0.04, 1e-12);
    EXPECT_NEAR(shade(0.25), 0.03 + 0.16 * 4.0, 1e-12);
}

TEST(CostModel, SumsGrowByTheirCounts) {
    const CostParts one = predict_seconds(two_errors(), {}, coefficients, 0.7);
    const CostParts many = predict_seconds(two_errors(), {10.0, 3.0}, coefficients, 0.7);
    EXPECT_NEAR(many.sum(), one.start + 10.0 * (one.before + one.fill + one.shade) + 3.0 * one.keyframes, 1e-9);
}

TEST(CostModel, NeverFallsWhereTheErrorDoes) {
    PilotSeconds noisy = two_errors();
    noisy.parts.push_back({2.0, 0.9, 0.0});  // a disturbed measurement, out of order
    for (const CostCoefficients& chosen : {coefficients, fitted_coefficients()}) {
        double before = 0.0;
        for (double error = 20.0; error > 0.01; error /= 1.1) {
            const double seconds = predict_seconds(noisy, {10.0, 3.0}, chosen, error).sum();
            EXPECT_GE(seconds, before * (1.0 - 1e-12)) << error;
            before = seconds;
        }
    }
}

TEST(ChooseError, IsTheSmallestThatFits) {
    const auto predict = [](double error) { return predict_seconds(two_errors(), {}, coefficients, error).sum(); };
    for (const double seconds : {1.5, 2.0, 5.0, 20.0}) {
        const double error = choose_error(two_errors(), {}, coefficients, seconds);
        EXPECT_LE(predict(error), seconds);
        const double step = error <= 1.0 ? 0.01 : 0.1;
        EXPECT_GT(predict(error - step), seconds) << error;
    }
}

TEST(ChooseError, StaysInItsRange) {
    EXPECT_EQ(choose_error(two_errors(), {}, coefficients, 1e9), least_budget_error);
    EXPECT_EQ(choose_error(two_errors(), {}, coefficients, infinity), least_budget_error);
    EXPECT_EQ(choose_error(two_errors(), {}, coefficients, 1e-9), most_budget_error);
    EXPECT_EQ(choose_error(two_errors(), {}, coefficients, -5.0), most_budget_error);
    EXPECT_EQ(choose_error(two_errors(), {}, coefficients, not_a_number), most_budget_error);
}

TEST(CostPilot, TakesFramesFromTheWholeList) {
    EXPECT_EQ(choose_pilot_frames({7}), (std::vector<std::int64_t>{7}));
    EXPECT_EQ(choose_pilot_frames({7, 9}), (std::vector<std::int64_t>{7, 9}));
    EXPECT_EQ(choose_pilot_frames({0, 1, 2, 3, 4, 5, 6, 7, 8}), (std::vector<std::int64_t>{1, 4, 7}));
}

TEST(CostPilot, ASizeKeepsAPixel) {
    const PictureSize wide = scale_size({65536, 1}, 0.25);
    EXPECT_EQ(wide.width, 16384);
    EXPECT_EQ(wide.height, 1);
}

}  // namespace
}  // namespace aleph
