// TVI, adaptation luminance and luminance thresholds (Yee 2000, section 6.2).

#include "perception/threshold.h"
#include "engine/base/sampling.h"
#include "tests/support/scenes/perception_scene.h"
#include "tests/support/test.h"
#include "tests/support/vision_formulas.h"

namespace aleph {
namespace {

Image<Rgb> random_colors(int width, int height) {
    Image<Rgb> image(width, height);
    RandomStream random({7, 0, 0, 0});
    for (Rgb& c : image.pixels) c = {random.next(), random.next(), random.next()};
    return image;
}

TEST(Tvi, KnownValues) {
    EXPECT_NEAR(std::log10(tvi(1e-5)), -2.86, 4e-6);
    EXPECT_NEAR(std::log10(tvi(1e-2)), std::pow(0.79, 2.18) - 2.86, 4e-6);  // l = -2
    EXPECT_NEAR(std::log10(tvi(0.1)), -1.395, 4e-6);                        // l = -1
    EXPECT_NEAR(std::log10(tvi(10.0)), std::pow(0.899, 2.7) - 0.72, 4e-6);  // l = 1
    EXPECT_NEAR(std::log10(tvi(1000.0)), 1.745, 4e-6);                      // Weber: 5.6 % of the luminance
}

TEST(Tvi, CS10_AtZeroLuminance) {
    for (const double l : {0.0, -0.0, denormal, double{std::numeric_limits<float>::min()}}) {
        EXPECT_EQ(tvi(l), tvi(1e-6)) << l;
    }
}

TEST(Tvi, CS11_NegativeNanAndInfiniteLuminance) {
    EXPECT_EQ(tvi(-5.0), tvi(1e-6));
    EXPECT_EQ(tvi(-float_infinity), tvi(1e-6));
    EXPECT_EQ(tvi(float_nan), tvi(1e-6));
    EXPECT_EQ(tvi(float_infinity), tvi(1e12));
    EXPECT_EQ(tvi(std::numeric_limits<float>::max()), tvi(1e12));
    EXPECT_NEAR(tvi(1e12) / std::pow(10.0, 12 - 1.255), 1.0, 1e-5);
}

TEST(Tvi, CS12_ContinuousToThreePercentAndRisingApartFromThePublishedSteps) {
    const double breakpoints[] = {-3.94, -1.44, -0.0184, 1.9};
    const double published_steps[] = {0.0, -0.027, 1e-4, -0.007};  // relative
    for (int i = 0; i < 4; ++i) {
        const double below = tvi(std::pow(10.0, breakpoints[i] - 1e-5));
        const double above = tvi(std::pow(10.0, breakpoints[i] + 1e-5));
        EXPECT_NEAR(above / below - 1.0, published_steps[i], 2e-3) << breakpoints[i];
    }
    double previous = 0.0;
    for (double l = -6.0; l < 8.0; l += 1e-3) {
        const double t = tvi(std::pow(10.0, l));
        const bool at_step = std::abs(l + 1.44) < 1.1e-3 || std::abs(l - 1.9) < 1.1e-3;
        if (!at_step) {
            EXPECT_GE(t, previous * (1 - 1e-5)) << l;
        }
        previous = t;
    }
}

TEST(Tvi, CS12_BelowTheRodsTheFormulaHasNoRealPower) {
    // (.405 l + 1.6) is negative below -3.9506: the branch comes before the power.
    for (double l = -6.0; l < -3.94; l += 0.01) EXPECT_NEAR(tvi(std::pow(10.0, l)), std::pow(10.0, -2.86), 1e-8) << l;
}

TEST(Threshold, IsAlephTimesTviOverTheWholeRange) {
    const int count = 4000;
    Image<float> luminance(count, 1), aleph(count, 1);
    for (int i = 0; i < count; ++i) {
        luminance(i, 0) = static_cast<float>(std::pow(10.0, -7.0 + 20.0 * i / count));
        aleph(i, 0) = 1.0f + static_cast<float>(i % 250);
    }
    const Image<float> threshold = compute_threshold(aleph, luminance);
    for (int i = 0; i < count; ++i) {
        const double l = std::log10(static_cast<double>(luminance(i, 0)));
        if (std::abs(l + 1.44) < 1e-5 || std::abs(l - 1.9) < 1e-5) continue;  // either side of a published step
        EXPECT_NEAR(threshold(i, 0) / (aleph(i, 0) * written_tvi(luminance(i, 0))), 1.0, 1e-5) << luminance(i, 0);
    }
}

TEST(Threshold, OddLuminancesGiveFiniteThresholds) {
    Image<float> luminance(6, 1), aleph(6, 1, 2.0f);
    luminance.pixels = {0.0f,           -1.0f,           float_nan,
                        float_infinity, -float_infinity, std::numeric_limits<float>::denorm_min()};
    const Image<float> threshold = compute_threshold(aleph, luminance);
    for (const int i : {0, 1, 2, 4, 5}) EXPECT_NEAR(threshold(i, 0) / (2 * tvi(1e-6)), 1.0, 1e-5) << i;
    EXPECT_NEAR(threshold(3, 0) / (2 * tvi(1e12)), 1.0, 1e-5);
}

TEST(Threshold, SizesMustAgree) {
    EXPECT_THROW(compute_threshold(Image<float>(4, 4), Image<float>(4, 3)), InputError);
}

TEST(Adaptation, IsTheMeanOverTheDisc) {
    const Image<Rgb> image = random_colors(53, 41);
    for (const double ppd : {1.0, 5.0, 31.0, 60.0}) {
        const Image<float> adapted =
            compute_adaptation_luminance(image, {.pixels_per_degree = ppd, .display_white = 80.0});
        for (const auto [x, y] : all_pixels(image)) {
            double sum = 0.0;
            int count = 0;
            for (int py = 0; py < image.height; ++py) {
                for (int px = 0; px < image.width; ++px) {
                    if ((px - x) * (px - x) + (py - y) * (py - y) > ppd * ppd / 4) continue;
                    sum += luminance(image(px, py));
                    ++count;
                }
            }
            ASSERT_NEAR(adapted(x, y) / (80.0 * sum / count), 1.0, 1e-6) << ppd << " " << x << " " << y;
        }
    }
}

TEST(Adaptation, CS13_ConstantImageAtCornersAndWhenSmallerThanTheDisc) {
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {1, 40}, {64, 48}}) {
        const Image<Rgb> image(width, height, Rgb(0.37f));
        const float expected = 100.0f * luminance(Rgb(0.37f));
        const Image<float> adapted = compute_adaptation_luminance(image, {});
        for (const float l : adapted.pixels) EXPECT_NEAR(l / expected, 1.0, 1e-6);
    }
}

TEST(Adaptation, CS14_ScalingTheSceneAndItsUnitTogetherChangesNothing) {
    Image<Rgb> image = random_colors(40, 30);
    const Image<float> aleph(40, 30, 7.0f);
    const Image<float> plain = compute_threshold(aleph, compute_adaptation_luminance(image, {}));
    for (const double scale : {1e-6, 1e6}) {
        Image<Rgb> scaled = image;
        for (Rgb& c : scaled.pixels) c *= static_cast<float>(scale);
        const Image<float> same =
            compute_threshold(aleph, compute_adaptation_luminance(scaled, {.display_white = 100.0 / scale}));
        for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_NEAR(same.pixels[i] / plain.pixels[i], 1.0, 1e-5);
    }
}

TEST(Adaptation, RefusesBrokenViewingConditions) {
    const Image<Rgb> image(4, 4);
    for (const double bad : {0.0, -31.0, static_cast<double>(float_infinity), static_cast<double>(float_nan)}) {
        EXPECT_THROW(compute_adaptation_luminance(image, {.pixels_per_degree = bad}), InputError) << bad;
        EXPECT_THROW(compute_adaptation_luminance(image, {.display_white = bad}), InputError) << bad;
    }
    EXPECT_THROW(compute_adaptation_luminance({}, {}), InputError);
}

}  // namespace
}  // namespace aleph
