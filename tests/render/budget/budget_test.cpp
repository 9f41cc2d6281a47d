// `aleph render --budget`: parts of pictures and what is timed of them, predicted cost, and the error that is chosen.

#include <nlohmann/json.hpp>
#include <numeric>

#include "engine/load/load_scene.h"
#include "render/budget/cost_model.h"
#include "render/budget/cost_pilot.h"
#include "render/cli/budget.h"
#include "render/frame/sequence.h"
#include "render/pixels/picture_part.h"
#include "tests/render/cli/answers.h"
#include "tests/support/quick_settings.h"
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

TEST(CostPilot, FramesAndLightingKeyframesAreCountedForIt) {
    Scene scene;
    scene.film.range = FrameRange{0, 40};
    RenderSettings settings;
    settings.cache.accuracy = 0.1;
    settings.cache.light_step = 10;
    std::vector<int> frames(40);
    std::iota(frames.begin(), frames.end(), 0);
    const auto find = [&](int rendered, const std::vector<std::int64_t>& pilot_frames = {5, 15}) {
        return find_cost_ratios(scene, settings, frames, pilot_frames, rendered);
    };
    EXPECT_DOUBLE_EQ(find(2).frames, 20.0);
    EXPECT_DOUBLE_EQ(find(2).keyframes, 5.0 / 3.0) << "0, 10, 20, 30 and 40, of which the pilot reads three";
    EXPECT_DOUBLE_EQ(find(1, {5}).frames, 40.0);
    EXPECT_DOUBLE_EQ(find(1).frames, 1.0) << "all are copies of one";
    EXPECT_DOUBLE_EQ(find(1).keyframes, 1.0);
    const RenderSettings usual = settings;
    const auto reads_none = [&](const auto& change) {
        settings = usual;
        change();
        return find(2).keyframes == 1.0;
    };
    EXPECT_TRUE(reads_none([&] { settings.cache.light_step = 0; }));
    EXPECT_TRUE(reads_none([&] { settings.cache.accuracy = 0.0; }));
    EXPECT_TRUE(reads_none([&] { settings.light.bounces = 0; }));
    EXPECT_TRUE(reads_none([&] { settings.light.path_depth = 1; }));
    EXPECT_TRUE(reads_none([&] { settings.light.integrator = Integrator::path; }));
}

TEST(PicturePart, IsSpreadOverThePicture) {
    const PicturePart part = choose_part(320, 240, 8, 4);
    EXPECT_DOUBLE_EQ(find_share(part), 0.125);
    for (int row = 0; row < 240; row += 4) {
        int blocks = 0;
        for (int x = 0; x < 320; x += 4) {
            blocks += part(x, row);
            for (int i = 0; i < 16; ++i) EXPECT_EQ(part(x + i % 4, row + i / 4), part(x, row));  // blocks are whole
        }
        EXPECT_EQ(blocks, 10) << row;
    }
    for (int x = 0; x < 320; x += 4) {
        int blocks = 0;
        for (int y = 0; y < 32; y += 4) blocks += part(x, y);
        EXPECT_EQ(blocks, 1) << x;
    }
}

TEST(PicturePart, OneOfOneIsTheWholePicture) {
    EXPECT_DOUBLE_EQ(find_share(choose_part(7, 5, 1, 4)), 1.0);
}

class PartTiming : public testing::Test {
  protected:
    PartTiming() : scene(load_scene((source_folder() / "scenes/cornell/scene.json").string())) {}

    /// Without lighting keyframes, so that frames and parts read the same light.
    RenderSettings settings_for(double error) const {
        RenderSettings settings = quick_settings(96, 72);
        follow_error(settings, error);
        settings.cache.light_step = 0;
        return settings;
    }

    Scene scene;
};

TEST_F(PartTiming, APartOfAllPixelsDoesWhatTheFrameDoes) {
    const std::vector<RenderSettings> settings = {settings_for(8.0), settings_for(2.0)};
    const PartTimes times =
        Sequence(scene, settings.front()).time_part(4, choose_part(96, 72, 1, 4), settings, [](auto&) { return true; });
    ASSERT_EQ(times.parts.size(), 2u);
    for (std::size_t i = 0; i < settings.size(); ++i) {
        const FrameCounts counts = Sequence(scene, settings[i]).render(4).statistics.counts;
        EXPECT_EQ(times.parts[i].samples, counts.samples) << i;
        EXPECT_EQ(times.parts[i].records, counts.records) << i;
    }
    EXPECT_GT(times.parts[1].samples, times.parts[0].samples);
}

TEST_F(PartTiming, ItsSamplesAreItsShare) {
    const std::vector<RenderSettings> settings = {settings_for(0.5)};
    const auto count = [&](int every) {
        return Sequence(scene, settings.front())
            .time_part(4, choose_part(96, 72, every, 4), settings, [](auto&) { return true; })
            .parts.front();
    };
    const PartTime all = count(1), quarter = count(4);
    EXPECT_NEAR(static_cast<double>(quarter.samples), 0.25 * static_cast<double>(all.samples),
                0.05 * static_cast<double>(all.samples));
    EXPECT_LT(quarter.records, all.records);
    EXPECT_GT(quarter.records, all.records / 4) << "blocks do not share their light";
}

TEST_F(PartTiming, EndsWhenItsCallerSaysSo) {
    const std::vector<RenderSettings> settings = {settings_for(8.0), settings_for(4.0), settings_for(2.0)};
    int asked = 0;
    const PartTimes times =
        Sequence(scene, settings.front()).time_part(4, choose_part(96, 72, 4, 4), settings, [&](auto&) {
            return ++asked < 2;
        });
    EXPECT_EQ(times.parts.size(), 2u);
    EXPECT_GT(times.before, 0.0);
}

TEST_F(PartTiming, SmallPicturesOfLightDifferEnoughToTellItsGrowth) {
    for (const auto& [width, height] : {std::pair(16, 12), {80, 60}, {160, 120}}) {
        RenderSettings settings = settings_for(10.0);
        set_size(settings, width, height);
        const PilotSeconds seconds =
            run_pilot({scene, "", {4}, {settings}, [](const PilotSeconds&, double) { return true; }}).seconds;
        ASSERT_EQ(seconds.light.size(), 2u);
        const double first = seconds.light[0].pixels, second = seconds.light[1].pixels;
        EXPECT_NEAR(std::max(first, second) / std::min(first, second), 4.0, 0.01) << width;
        EXPECT_EQ(first < second, width < 128) << "where time may allow only one";
    }
}

TEST_F(PartTiming, LightIsTimedOnceForEachMoment) {
    RenderSettings settings = settings_for(8.0);
    settings.cache.light_step = 10;
    Sequence sequence(scene, settings);
    EXPECT_GT(sequence.time_light(4).keyframes, 0.0);
    EXPECT_EQ(sequence.time_light(5).keyframes, 0.0);
    settings.cache.light_step = 0;
    EXPECT_EQ(Sequence(scene, settings).time_light(4).keyframes, 0.0);
    EXPECT_GT(Sequence(scene, settings).time_light(4).fill, 0.0);
}

class Budgets : public RenderCommand {
  protected:
    int run(const std::vector<std::string>& more) { return RenderCommand::run({"--size", "4x3", "-t", "1"}, more); }
};

TEST_F(Budgets, WrongOnesAreRefused) {
    for (const char* text : {"0", "-1", "nan", "inf", "", "1 s", "1e-400x"}) {
        EXPECT_EQ(run({"--frames", "0", "-o", file("a.exr"), "--budget", text}), exit_bad_input) << text;
        EXPECT_THAT(errors, HasSubstr("--budget"));
        EXPECT_FALSE(fs::exists(file("a.exr"))) << text;
    }
}

TEST_F(Budgets, ChooseTheErrorAlone) {
    for (const Words& beside : {Words{"--error", "1"},
                                {"--set", "error=1"},
                                {"--cache", file("light")},
                                {"--spp", "4"},
                                {"--sampling", "uniform"},
                                {"--gather", "64"},
                                {"--set", "accuracy=0.1"}}) {
        EXPECT_EQ(run(joined({"--frames", "0", "-o", file("a.exr"), "--budget", "5"}, beside)), exit_bad_input)
            << beside.front();
        EXPECT_THAT(errors, HasSubstr("give one of the two"));
        EXPECT_FALSE(fs::exists(file("a.exr")));
    }
}

TEST_F(Budgets, TheErrorMakesTheSameBytesAgain) {
    for (const char* budget : {"1e-9", "1e9"}) {
        ASSERT_EQ(run({"--frames", "3", "--budget", budget, "-o", file("a.exr"), "--stats", file("a.json")}), exit_done)
            << errors;
        const auto json = nlohmann::json::parse(read_bytes(file("a.json")));
        const double error = json.at("budget").at("error");
        EXPECT_EQ(error, std::string(budget) == "1e9" ? least_budget_error : most_budget_error);
        EXPECT_EQ(json.at("settings").at("error"), error);
        EXPECT_GT(json.at("budget").at("took"), json.at("budget").at("pilot"));
        EXPECT_GT(json.at("budget").at("predicted"), 0.0);
        ASSERT_EQ(run({"--frames", "3", "--error", fmt::format("{:g}", error), "-o", file("b.exr"), "--stats",
                       file("b.json")}),
                  exit_done);
        EXPECT_EQ(read_bytes(file("a.exr")), read_bytes(file("b.exr"))) << error;
        EXPECT_FALSE(nlohmann::json::parse(read_bytes(file("b.json"))).contains("budget"));
    }
}

TEST(BudgetText, SaysWhatWasPredictedAndWhatItTook) {
    BudgetStatistics budget{60.0, 1.3, 55.0, 58.0, 2.1};
    EXPECT_EQ(describe_budget(budget), "aleph: budget 60 s: error 1.3 chosen, predicted 55 s, took 58 s\n");
    EXPECT_THAT(describe_choice(budget), Not(HasSubstr("warning")));
    budget.predicted = 90.0;
    EXPECT_THAT(describe_choice(budget), HasSubstr("predicted to take 90 s"));
}

}  // namespace
}  // namespace aleph
