// When a pixel has enough samples: estimates from its neighbours and from itself, and the rules that read them.
// The accuracy of records: Yee 2000, eqs. 6.7 and 6.8.

#include "render/guide/stopping_rule.h"
#include "render/guide/accuracy_map.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(StoppingRule, OwnSamplesTellDifferenceAndDeviation) {
    PixelSamples pixel;
    for (const float value : {1.0f, 1.0f, 2.0f, 4.0f}) pixel.add(grey_sample(value));
    const MeanEstimate mean = estimate_own_mean(pixel);
    EXPECT_EQ(mean.samples, 4);
    EXPECT_NEAR(mean.error2, 1.0, 1e-6) << "the mean was 1 after two samples and is 2 after four";
    EXPECT_NEAR(mean.variance, 2.0, 1e-6);
}

TEST(StoppingRule, PixelsWithAnOutlineAreJudgedByOthersWithOne) {
    Image<PixelSamples> pixels(3, 3);
    Image<Outline> outlines(3, 3, Outline::none);
    for (int y = 0; y < 3; ++y) {
        outlines(1, y) = Outline::still;
        for (int x = 0; x < 3; ++x) {
            for (int i = 0; i < 2; ++i) pixels(x, y).add(grey_sample(x == 1 ? static_cast<float>(i) : 0.0f));
        }
    }
    EXPECT_NEAR(estimate_mean(pixels, outlines, 1, 1).error2, 0.25, 1e-7);
    EXPECT_EQ(estimate_mean(pixels, outlines, 0, 1).error2, 0.0);
    EXPECT_NEAR(estimate_mean(pixels, {}, 1, 1).error2, 0.25 * 2.0 / 8.0, 1e-7);
    pixels = Image<PixelSamples>(5, 5);
    outlines = Image<Outline>(5, 5, Outline::none);
    outlines(1, 1) = Outline::still;  // alone among others
    for (PixelSamples& pixel : pixels.pixels) {
        for (int i = 0; i < 2; ++i) pixel.add(grey_sample(0.0f));
    }
    for (int i = 0; i < 2; ++i) pixels(0, 1).add(grey_sample(static_cast<float>(i)));
    EXPECT_GT(estimate_mean(pixels, outlines, 1, 1).error2, 0.0);
    // Noise two pixels away, and three.
    EXPECT_EQ(estimate_mean(pixels, {}, 3, 1).error2, 0.0);
    EXPECT_GT(estimate_mean(pixels, {}, 2, 1).error2, 0.0);
}

/// Every pixel's two samples differ by twice its deviation.
Image<PixelSamples> pixels_of_deviations(int width, int height, const std::function<float(int, int)>& deviation) {
    Image<PixelSamples> pixels(width, height);
    for (const auto [x, y] : all_pixels(width, height)) {
        for (const float sign : {-1.0f, 1.0f}) pixels(x, y).add(grey_sample(10.0f + sign * deviation(x, y)));
    }
    return pixels;
}

TEST(StoppingRule, DeviationsAroundAreMeansOfOtherPixels) {
    Image<PixelSamples> pixels = pixels_of_deviations(12, 7, [](int x, int) { return x < 6 ? 1.0f : 3.0f; });
    const double one = std::sqrt(2.0) / std::sqrt(2.0 / std::numbers::pi);  // halves of one sample each
    const Image<float> around = deviations_around(pixels, 4);
    EXPECT_NEAR(around(0, 3), one, 1e-5);
    EXPECT_NEAR(around(11, 0), one * 3.0, 1e-5);
    EXPECT_NEAR(around(5, 6), one * (5.0 * 5.0 + 4.0 * 5.0 * 3.0 - 1.0) / (9.0 * 5.0 - 1.0), 1e-5);
    pixels(0, 0) = PixelSamples();  // not known
    for (const float value : {0.0f, 100.0f}) pixels(1, 0).add(grey_sample(value));
    EXPECT_NEAR(deviations_around(pixels, 4)(6, 6), around(6, 6), 1e-6) << "beyond reach";
    EXPECT_NEAR(deviations_around(pixels_of_deviations(1, 1, [](int, int) { return 2.0f; }), 4)(0, 0), 2.0 * one, 1e-5);
    Image<float> values(20, 1, 1.0f);
    values(10, 0) = 9.0f;
    EXPECT_EQ(mean_around(values, 4, false)(10, 0), 1.0f);
    EXPECT_FLOAT_EQ(mean_around(values, 4, true)(10, 0), 17.0f / 9.0f);
    EXPECT_EQ(mean_around(values, 2, true)(13, 0), 1.0f) << "beyond reach";
    EXPECT_LT(mean_around(Image<float>(3, 3, -1.0f), 4, true)(1, 1), 0.0f);
}

TEST(StoppingRule, WhiteIsWhatThreeStandardErrorsLessStillAre) {
    PixelSamples lamp, outline, coloured;
    for (const float value : {40.0f, 100.0f, 100.0f, 100.0f}) lamp.add(grey_sample(value));
    for (const float value : {0.0f, 0.0f, 0.0f, 100.0f}) outline.add(grey_sample(value));
    SampleLight yellow;
    yellow[LightPart::surface] = Rgb(100.0f, 100.0f, 0.5f);
    for (int i = 0; i < 4; ++i) coloured.add(yellow);
    EXPECT_TRUE(is_shown_white(lamp, 39.9));
    EXPECT_FALSE(is_shown_white(lamp, 40.1)) << "85 less three times 15";
    EXPECT_FALSE(is_shown_white(outline, 1.0));
    EXPECT_FALSE(is_shown_white(coloured, 1.0)) << "its blue shows";
}

TEST(StoppingRule, TheEyesReachIsAnAngle) {
    EXPECT_EQ(find_seen_reach(31.0), 4);
    EXPECT_EQ(find_seen_reach(62.0), 8);
    EXPECT_EQ(find_seen_reach(2.0), 1);
    EXPECT_EQ(find_seen_reach(1e300), 1000);
}

TEST(StoppingRule, TheVarianceRuleReadsDeviationOrError) {
    const MeanEstimate mean{64, 0.0, 0.04};
    EXPECT_TRUE(is_enough(Sampling::variance, Stopping::neighbourhood, mean, 0.026));
    EXPECT_FALSE(is_enough(Sampling::variance, Stopping::neighbourhood, mean, 0.024));
    EXPECT_TRUE(is_enough(Sampling::variance, Stopping::pixel, mean, 0.21));
    EXPECT_FALSE(is_enough(Sampling::variance, Stopping::pixel, mean, 0.19));
}

TEST(StoppingRule, TheProtocolDividesTheMostSamplesByAleph) {
    EXPECT_EQ(protocol_samples(1.0, 512), 512);
    EXPECT_EQ(protocol_samples(3.0, 512), 171);
    EXPECT_EQ(protocol_samples(250.0, 512), 16);
    EXPECT_EQ(protocol_samples(0.2, 512), 512);
    EXPECT_EQ(protocol_samples(100.0, 8), 8);
    EXPECT_EQ(protocol_samples(not_a_number, 64), 64);
    EXPECT_EQ(protocol_samples(infinity, 64), 16);
}

TEST(AccuracyMap, CompressKnownAnswers) {
    for (const double a : {1e-6, 0.05, 0.1, 0.5, 1.0}) EXPECT_DOUBLE_EQ(compress_accuracy(a, 1.0), a);
    EXPECT_DOUBLE_EQ(compress_accuracy(0.1, 10.0), 1.0 / 1.9);
    EXPECT_DOUBLE_EQ(compress_accuracy(0.5, 3.0), 0.75);
    EXPECT_NEAR(compress_accuracy(0.1, 250.6), 25.06 / 25.96, 1e-12);
}

TEST(AccuracyMap, CompressAtItsEnds) {
    EXPECT_EQ(compress_accuracy(0.1, infinity), 1.0);
    EXPECT_EQ(compress_accuracy(1.0, 77.0), 1.0);
    for (const double n : {0.0, 1.0, 250.0, infinity, not_a_number}) EXPECT_EQ(compress_accuracy(0.0, n), 0.0);
    for (const double n : {0.0, -5.0, not_a_number, -infinity}) EXPECT_DOUBLE_EQ(compress_accuracy(0.1, n), 0.1);
    EXPECT_EQ(compress_accuracy(not_a_number, 2.0), 0.0);
    EXPECT_LE(compress_accuracy(0.3, 1e300), 1.0);
}

TEST(AccuracyMap, ScaleAddKnownAnswers) {
    EXPECT_DOUBLE_EQ(scale_add_accuracy(0.1, 1.0, 100.0), 0.11);
    EXPECT_DOUBLE_EQ(scale_add_accuracy(0.1, 50.0, 100.0), 0.6);
    EXPECT_DOUBLE_EQ(scale_add_accuracy(0.1, 50.0, 200.0), 0.35);
    EXPECT_EQ(scale_add_accuracy(0.1, 250.0, 100.0), 1.0);  // the equation gives 2.6
    EXPECT_EQ(scale_add_accuracy(0.1, infinity, 100.0), 1.0);
    EXPECT_EQ(scale_add_accuracy(1.0, 1.0, 100.0), 1.0);
    for (const double n : {0.0, -3.0, not_a_number}) EXPECT_DOUBLE_EQ(scale_add_accuracy(0.1, n, 100.0), 0.11);
    for (const double n : {1.0, infinity, not_a_number}) EXPECT_EQ(scale_add_accuracy(0.0, n, 100.0), 0.0);
}

TEST(AccuracyMap, MapPixelByPixel) {
    Image<float> aleph(2, 2);
    aleph.pixels = {1.0f, 10.0f, float_infinity, float_nan};
    RenderSettings settings;
    settings.cache.accuracy = 0.1;
    settings.perception.guide = Guide::saliency;
    EXPECT_EQ(compute_accuracy_map(aleph, settings).pixels,
              (std::vector<float>{0.1f, static_cast<float>(1.0 / 1.9), 1.0f, 0.1f}));
    settings.guide.adapter = Adapter::scale_add;
    settings.guide.adapter_k = 50.0;
    EXPECT_EQ(compute_accuracy_map(aleph, settings).pixels,
              (std::vector<float>{0.12f, static_cast<float>(0.3), 1.0f, 0.12f}));
    settings.guide.adapter = Adapter::none;
    EXPECT_EQ(compute_accuracy_map(aleph, settings).pixels, std::vector<float>(4, 0.1f));
}

TEST(AccuracyMap, WithoutAGuideNoAdapterCounts) {
    RenderSettings settings;
    settings.cache.accuracy = 0.1;
    settings.perception.guide = Guide::none;
    for (const Adapter adapter : {Adapter::compress, Adapter::scale_add, Adapter::none}) {
        settings.guide.adapter = adapter;
        for (const float alpha : compute_accuracy_map(Image<float>(3, 2, 100.0f), settings).pixels)
            EXPECT_EQ(alpha, 0.1f);
    }
}

/// Twice the accuracy on the left, NaN on the right.
struct LeftAdapter final : AccuracyAdapter {
    Image<float> adapt(const Image<float>& aleph, double accuracy) const override {
        Image<float> alpha(width, aleph.height, std::numeric_limits<float>::quiet_NaN());
        for (int y = 0; y < alpha.height; ++y) alpha(0, y) = static_cast<float>(20.0 * accuracy);
        return alpha;
    }
    int width = 2;
};

TEST(AccuracyMap, AnAdapterOfAProgramIsAskedAndHeldToItsRange) {
    LeftAdapter own;
    RenderSettings settings;
    settings.cache.accuracy = 0.1;
    settings.guide.own_adapter = &own;
    EXPECT_EQ(compute_accuracy_map(Image<float>(2, 1, 5.0f), settings).pixels, (std::vector<float>{1.0f, 0.1f}));
    own.width = 3;
    EXPECT_THROW(compute_accuracy_map(Image<float>(2, 1, 5.0f), settings), InputError);
    settings.perception.guide = Guide::none;
    EXPECT_EQ(compute_accuracy_map(Image<float>(2, 1, 5.0f), settings).pixels, std::vector<float>(2, 0.1f));
}

}  // namespace
}  // namespace aleph
