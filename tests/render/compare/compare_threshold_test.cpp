// Errors in units of the threshold, and the noise of the reference, against values worked out by hand and the normal
// distribution.

#include "render/compare/compare_threshold.h"
#include "render/compare/compare.h"
#include "tests/support/grey_image.h"
#include "tests/support/test.h"
#include "tests/support/trial.h"

namespace aleph {
namespace {

void add_channel(ChannelImage& image, const std::string& name, float value) {
    const Image<float>& size = image.channels.front().values;
    image.channels.push_back({name, Image<float>(size.width, size.height, value)});
}

/// Grey pictures of a known noise: every pixel is `mean` plus a normal number of deviation `sigma`.
ChannelImage noisy(int width, int height, float mean, float sigma, unsigned seed) {
    ChannelImage image = grey_image(width, height, mean);
    std::mt19937 random(seed);
    std::normal_distribution<float> normal(0.0f, sigma);
    for (std::size_t i = 0; i < image.channels[0].values.size(); ++i) {
        const float noise = normal(random);
        for (Channel& channel : image.channels) channel.values.pixels[i] += noise;
    }
    add_channel(image, "variance.Y", sigma * sigma);
    return image;
}

/// Share of a normal distribution beyond `limit` standard deviations, on both sides.
double two_sided(double limit) {
    return std::erfc(limit / std::numbers::sqrt2);
}

TEST(RatioHistogram, NoDifferenceIsZeroWhateverTheThreshold) {
    RatioHistogram histogram;
    EXPECT_EQ(histogram.percentile(0.99), 0.0);
    histogram.add(0.0, 0.0);
    histogram.add(0.0, 1e-30);
    EXPECT_EQ(histogram.beyond(), 0u);
    EXPECT_EQ(histogram.percentile(1.0), 0.0);
    histogram.add(1e-30, 0.0);
    EXPECT_EQ(histogram.beyond(), 1u);
    EXPECT_EQ(histogram.worst(), infinity);
}

TEST(RatioHistogram, WhatIsNotFiniteIsBeyond) {
    RatioHistogram histogram;
    for (const auto& [difference, threshold] :
         {std::pair{not_a_number, 1.0}, {1.0, not_a_number}, {1.0, infinity}, {0.0, -1.0}, {infinity, 1.0}}) {
        histogram.add(difference, threshold);
    }
    EXPECT_EQ(histogram.count(), 5u);
    EXPECT_EQ(histogram.beyond(), 5u);
    EXPECT_EQ(histogram.percentile(0.5), infinity);
}

TEST(CompareNoise, ByHand) {
    // Standard error .01 of Y is 1 cd/m2. The error is 2, 4.5 and 0 cd/m2, the threshold 1: 4.5 > 1 + 3.
    ChannelImage b = grey_image(3, 1, 0.5f), a = b;
    add_channel(b, "variance.Y", 1e-4f);
    for (Channel& channel : a.channels) {
        channel.values(0, 0) += 0.02f;
        channel.values(1, 0) += 0.045f;
    }
    const ChannelImage map{{{"threshold.Y", Image<float>(3, 1, 1.0f)}}, {}};
    const CompareResult result = compare_images(a, b, {}, &map);
    EXPECT_EQ(result.threshold->beyond, 2u);
    ASSERT_TRUE(result.threshold->noise.has_value());
    EXPECT_EQ(result.threshold->noise->certain, 1u);
    EXPECT_NEAR(result.threshold->noise->median, 1.0, 0.0051);
    EXPECT_NEAR(result.threshold->noise->expected, 3.0 * 0.3173105, 1e-5);
    // (a - b)/b: .04, .09, 0. Standard error of the bias: sqrt(3) .01 / 1.5. e = .005.
    EXPECT_NEAR(result.luminance->bias, 0.13 / 3.0, 1e-6);
    EXPECT_NEAR(result.luminance->bias_error, 0.01 * std::sqrt(3.0) / 1.5, 1e-7);
    EXPECT_NEAR(result.luminance->relative_mse, (4e-4 + 0.045 * 0.045) / 0.250025 / 3.0, 1e-7);
    EXPECT_NEAR(result.luminance->noise_mse, 1e-4 / 0.250025, 1e-7);
    EXPECT_NEAR(result.luminance->without_noise(), (4e-4 + 0.045 * 0.045 - 3e-4) / 0.250025 / 3.0, 1e-7);
    EXPECT_EQ(result.luminance->far, 1u);  // only .045 is beyond 3 * .01
}

/// By hand, white of 100 cd/m2: nothing is seen of what a display shows as its white.
TEST(CompareThreshold, ErrorsAreOfWhatADisplayShows) {
    const std::vector<std::pair<Rgb, Rgb>> shown{{Rgb(1.5f), Rgb(3.0f)},                            // white
                                                 {Rgb(3.0f, 0.5f, 0.25f), Rgb(2.0f, 0.5f, 0.25f)},  // the same orange
                                                 {Rgb(-0.5f), Rgb(0.0f)},  // light below 0 is an error
                                                 {Rgb(0.9f), Rgb(3.0f)},   // 10 cd/m2
                                                 {Rgb(3.0f, 0.5f, 0.25f), Rgb(2.0f, 0.4f, 0.25f)},  // 7.152
                                                 {Rgb(float_infinity), Rgb(2.0f)},
                                                 {Rgb(float_nan), Rgb(2.0f)}};
    ChannelImage a = grey_image(static_cast<int>(shown.size()), 1, 0.0f), b = a;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            a.channels[c].values.pixels[i] = shown[i].first[c];
            b.channels[c].values.pixels[i] = shown[i].second[c];
        }
    }
    add_channel(b, "variance.Y", 1e-4f);
    const LuminanceError error = compute_luminance_error(a, b);
    const std::vector<double> expected{0.0, 0.0, -50.0, -10.0, 7.152};
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(error.error.pixels[i], expected[i], 1e-5) << i;
    EXPECT_EQ(measure_error(error, Image<float>(a.channels[0].values.width, 1, 1.0f)).beyond, 5u);
    EXPECT_EQ(error.variance.pixels[0], 0.0) << "noise of white";
    EXPECT_DOUBLE_EQ(error.variance.pixels[2], 1e4 * 1e-4f) << "all of it";
}

TEST(CompareThreshold, NoiseAroundWhiteIsShownInPart) {
    for (const auto& [y, deviation] :
         {std::pair(0.98f, 1.0), {0.99f, 1.0}, {1.0f, 0.5}, {1.005f, 0.25}, {1.02f, 0.0}}) {
        ChannelImage grey = grey_image(1, 1, y);
        add_channel(grey, "variance.Y", 1e-4f);  // .01, 1 cd/m2
        EXPECT_NEAR(std::sqrt(compute_luminance_error(grey, grey).variance.pixels[0]), deviation, 1e-4) << y;
    }
}

TEST(CompareNoise, PictureOfNoiseAloneIsBeyondAsOftenAsTheNormalDistributionSays) {
    constexpr int width = 200, height = 150;
    const double n = width * height;
    for (const double sigma : {0.3, 0.7, 1.5}) {  // in thresholds
        EXPECT_TRUE(holds([&](Trial& trial) {
            const ChannelImage truth = grey_image(width, height, 0.5f);
            const ChannelImage reference =
                noisy(width, height, 0.5f, static_cast<float>(0.01 * sigma), 11 + trial.seed);
            const ChannelImage map{{{"threshold.Y", Image<float>(width, height, 1.0f)}}, {}};
            const CompareResult result = compare_images(truth, reference, {}, &map);
            const double p = two_sided(1.0 / sigma);
            EXPECT_NEAR(result.threshold->noise->expected / n, p, 1e-5);
            trial.counts(static_cast<double>(result.threshold->beyond), n, p);
            trial.counts(static_cast<double>(result.threshold->noise->certain), n, two_sided(3.0 + 1.0 / sigma), 1.0);
            EXPECT_NEAR(result.threshold->noise->percentile_99, sigma, 0.0051 * sigma);
            trial.counts(static_cast<double>(result.luminance->far), n, two_sided(3.0));
            trial.near(result.luminance->bias, result.luminance->bias_error, 0.0, 0.0);
            // Each squared normal number has variance 2.
            trial.near(result.luminance->relative_mse / result.luminance->noise_mse, std::sqrt(2.0 / n), 1.0, 0.01);
        })) << sigma;
    }
}

TEST(CompareNoise, TwoNoisyPicturesShareTheirStandardErrors) {
    constexpr int width = 200, height = 150;
    const double n = width * height;
    CompareSettings settings;
    settings.standard_errors = 2.0;
    settings.share = 100.0;
    EXPECT_TRUE(holds([&](Trial& trial) {
        const ChannelImage a = noisy(width, height, 0.5f, 0.01f, 3 + trial.seed),
                           b = noisy(width, height, 0.5f, 0.02f, 4 + trial.seed);
        trial.counts(static_cast<double>(compare_images(a, b, settings).luminance->far), n, two_sided(2.0));
    }));
}

TEST(CompareNoise, StandardErrorsReplaceTheChannels) {
    const ChannelImage b = noisy(40, 30, 0.5f, 0.01f, 8), a = noisy(40, 30, 0.5f, 0.01f, 9);
    EXPECT_FALSE(compare_images(a, b).same());
    CompareSettings settings;
    settings.standard_errors = 6.0;
    EXPECT_TRUE(compare_images(a, b, settings).same());
    ChannelImage shifted = a;
    for (Channel& channel : shifted.channels) {
        if (channel.name != "variance.Y") channel.values(7, 5) += 0.2f;
    }
    EXPECT_FALSE(compare_images(shifted, b, settings).same());
    settings.tolerance = 0.2;
    EXPECT_TRUE(compare_images(shifted, b, settings).same());
    EXPECT_THROW(compare_images(grey_image(4, 4, 0.5f), grey_image(4, 4, 0.5f), settings), InputError);
}

/// Only noise that is known is subtracted of the relative MSE.
TEST(CompareNoise, ABrokenVarianceLiftsNoLimit) {
    ChannelImage b = noisy(8, 8, 0.5f, 0.01f, 8);
    ChannelImage a = grey_image(8, 8, 1.0f);
    CompareSettings settings{.tolerance = 9.0};
    settings.max_relative_mse = 0.01;
    for (const float broken : {float_infinity, float_nan}) {
        for (Channel& channel : b.channels)
            if (channel.name == "variance.Y") channel.values(3, 3) = broken;
        EXPECT_FALSE(compare_images(a, b, settings).same()) << broken;
    }
    ChannelImage black = grey_image(8, 8, 0.0f), dark = grey_image(8, 8, 0.001f);
    add_channel(black, "variance.Y", 1e-6f);
    EXPECT_TRUE(compare_images(dark, black, {.tolerance = 0.01}).same()) << "no limit is asked for";
}

TEST(CompareNoise, PixelsBeyondStandardErrorsAreThoseThatCount) {
    const ChannelImage b = noisy(40, 30, 0.5f, 0.01f, 8), a = noisy(40, 30, 0.5f, 0.01f, 9);
    CompareSettings settings;
    settings.standard_errors = 2.0;
    const CompareResult result = compare_images(a, b, settings);
    EXPECT_EQ(result.counted, result.luminance->far);
    EXPECT_LT(result.counted, result.beyond);
    EXPECT_EQ(compare_images(a, b).counted, compare_images(a, b).beyond);
}

TEST(CompareNoise, NothingIsCertainOfABrokenVariance) {
    const ChannelImage a = grey_image(4, 1, 0.9f);
    ChannelImage b = grey_image(4, 1, 0.5f);
    add_channel(b, "variance.Y", 0.0f);
    b.channels[3].values(1, 0) = float_nan;
    b.channels[3].values(2, 0) = -1.0f;
    b.channels[3].values(3, 0) = float_infinity;
    const ChannelImage map{{{"threshold.Y", Image<float>(4, 1, 1.0f)}}, {}};
    const CompareResult result = compare_images(a, b, {}, &map);
    EXPECT_EQ(result.threshold->beyond, 4u);
    EXPECT_EQ(result.threshold->noise->certain, 1u);
    EXPECT_EQ(result.threshold->noise->beyond, 3u);
    EXPECT_EQ(result.luminance->far, 1u);
}

}  // namespace
}  // namespace aleph
