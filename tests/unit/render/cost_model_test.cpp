// What frames are predicted to cost, and the error that a budget chooses.

#include "render/cost_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "render/cost_pilot.h"

namespace aleph {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Pilots at the errors 4 and 1.
std::vector<PilotRun> two_runs() {
    return {{4.0, {0.01, 0.02, 0.1, 0.2, 0.3}, 0.05}, {1.0, {0.01, 0.02, 0.3, 0.4, 1.2}, 0.05}};
}

const CostCoefficients exponents = {{0.0, 1.0, 0.8, 0.7, 0.9}, {0.0, 0.0, 0.8, 0.8, 1.0}};

TEST(CostModel, GivesThePilotBack) {
    EXPECT_NEAR(predict_seconds(two_runs(), {}, exponents, 4.0), 0.68, 1e-12);
    EXPECT_NEAR(predict_seconds(two_runs(), {}, exponents, 1.0), 1.98, 1e-12);
}

TEST(CostModel, IsAPowerLawBetweenAndBelowThePilots) {
    const std::vector<PilotRun> runs = {{4.0, {0, 0, 0, 0, 1.0}, 0.0}, {1.0, {0, 0, 0, 0, 4.0}, 0.0}};
    EXPECT_NEAR(predict_seconds(runs, {}, exponents, 2.0), 2.0, 1e-12);
    EXPECT_NEAR(predict_seconds(runs, {}, exponents, 0.5), 8.0, 1e-12);
    EXPECT_NEAR(predict_seconds(runs, {}, exponents, 8.0), 1.0, 1e-12);
}

TEST(CostModel, EachPartGrowsByItsRatios) {
    const CostRatios ratios{16.0, 10.0, 3.0};
    const std::vector<PilotRun> runs = {{1.0, {1.0, 2.0, 3.0, 4.0, 5.0}, 6.0}};
    EXPECT_NEAR(predict_seconds(runs, ratios, exponents, 1.0),
                6.0 + 10.0 * (1.0 + 2.0 * 16.0 + 3.0 * std::pow(16.0, 0.8) + 5.0 * std::pow(16.0, 0.9)) +
                    3.0 * 4.0 * std::pow(16.0, 0.7),
                1e-9);
}

TEST(CostModel, NeverFallsWhereTheErrorDoes) {
    std::vector<PilotRun> noisy = two_runs();
    noisy.push_back({2.0, {0.01, 0.02, 0.01, 0.9, 0.0}, 0.05});  // a disturbed pilot, out of order
    for (const CostCoefficients& coefficients : {exponents, fitted_coefficients()}) {
        double before = 0.0;
        for (double error = 20.0; error > 0.01; error /= 1.1) {
            const double seconds = predict_seconds(noisy, {16.0, 10.0, 3.0}, coefficients, error);
            EXPECT_GE(seconds, before * (1.0 - 1e-12)) << error;
            before = seconds;
        }
    }
}

TEST(CostModel, RefusesWhatIsNoCost) {
    const double nan = std::nan("");
    EXPECT_THROW(predict_seconds({}, {}, exponents, 1.0), std::invalid_argument);
    for (const double error : {0.0, -1.0, nan, infinity}) {
        EXPECT_THROW(predict_seconds(two_runs(), {}, exponents, error), std::invalid_argument) << error;
    }
    for (const double seconds : {-1.0, nan, infinity}) {
        EXPECT_THROW(predict_seconds({{1.0, {0, 0, 0, 0, seconds}, 0.0}}, {}, exponents, 1.0), std::invalid_argument)
            << seconds;
    }
}

TEST(ChooseError, IsTheSmallestThatFits) {
    for (const double seconds : {0.7, 0.9, 1.5, 3.0, 8.0}) {
        const double error = choose_error(two_runs(), {}, exponents, seconds);
        EXPECT_LE(predict_seconds(two_runs(), {}, exponents, error), seconds);
        const double step = error <= 1.0 ? 0.01 : 0.1;
        EXPECT_GT(predict_seconds(two_runs(), {}, exponents, error - step), seconds) << error;
    }
}

TEST(ChooseError, StaysInItsRange) {
    EXPECT_EQ(choose_error(two_runs(), {}, exponents, 1e9), least_budget_error);
    EXPECT_EQ(choose_error(two_runs(), {}, exponents, infinity), least_budget_error);
    EXPECT_EQ(choose_error(two_runs(), {}, exponents, 1e-9), most_budget_error);
    EXPECT_EQ(choose_error(two_runs(), {}, exponents, -5.0), most_budget_error);
    EXPECT_EQ(choose_error(two_runs(), {}, exponents, std::nan("")), most_budget_error);
}

TEST(CostPilot, TakesFramesFromTheWholeList) {
    EXPECT_EQ(choose_pilot_frames({7}), (std::vector<std::int64_t>{7}));
    EXPECT_EQ(choose_pilot_frames({7, 9}), (std::vector<std::int64_t>{7, 9}));
    EXPECT_EQ(choose_pilot_frames({0, 1, 2, 3, 4, 5, 6, 7, 8}), (std::vector<std::int64_t>{1, 4, 7}));
}

TEST(CostPilot, IsAQuarterButNotTiny) {
    EXPECT_EQ(find_pilot_scale(640), 0.25);
    EXPECT_EQ(find_pilot_scale(64), 0.5);
    EXPECT_EQ(find_pilot_scale(16), 1.0);
    const PictureSize wide = scale_size({65536, 1}, 0.25);
    EXPECT_EQ(wide.width, 16384);
    EXPECT_EQ(wide.height, 1);
}

}  // namespace
}  // namespace aleph
