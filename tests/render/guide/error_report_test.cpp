// Errors that pixels are estimated to have, by cause, and the share of the pixels where they are beyond what was asked.

#include "render/guide/error_report.h"

#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr double exposure = 2.0, display_white = 50.0;  // 100 cd/m2 for a luminance of 1

struct Deviations {
    float surface = 0.0f, direct = 0.0f, gloss = 0.0f;
};

/// Adds samples whose halves differ by twice the deviations: these are the standard errors of the parts.
void add_halves(PixelSamples& pixel, int count, float mean, const Deviations& deviations, int instances = 1) {
    for (int i = 0; i < count; ++i) {
        const float sign = 2 * i < count ? 1.0f : -1.0f;
        SampleLight light;
        light[LightPart::surface] = Rgb(mean + sign * deviations.surface);
        light[LightPart::direct] = Rgb(sign * deviations.direct);
        light[LightPart::gloss] = Rgb(sign * deviations.gloss);
        light.indirect = Rgb(0.6f);
        light.place.instance = i % instances;
        light.place.geometric = light.place.normal = {0.0f, 1.0f, 0.0f};
        pixel.add(light);
    }
}

struct Limits {
    Image<float> threshold, noise, aleph, accuracy, swing;
    Image<Outline> outlines;

    Limits(int width, int height)
        : threshold(width, height, 5.0f), noise(width, height, 4.0f), accuracy(width, height, 0.5f) {}

    ErrorMaps estimate(const Image<PixelSamples>& pixels, bool blurred = false) const {
        ViewingConditions viewing;
        viewing.display_white = display_white;
        return estimate_errors(pixels, {threshold, noise, aleph, accuracy, outlines, swing, viewing}, exposure,
                               blurred);
    }
};

double of(const ErrorMaps& maps, ErrorCause cause, int x, int y = 0) {
    return maps.by_cause[static_cast<std::size_t>(cause)](x, y);
}

TEST(ErrorReport, EachCauseInItsOwnUnits) {
    Image<PixelSamples> pixels(4, 3);
    for (PixelSamples& pixel : pixels.pixels) add_halves(pixel, 4, 0.1f, {0.02f, 0.04f, 0.06f});
    pixels(0, 0) = PixelSamples();
    add_halves(pixels(0, 0), 4, 0.9f, {0.02f, 0.04f, 0.06f});
    Limits limits(4, 3);
    limits.noise(3, 2) = 0.0f;
    const ErrorMaps maps = limits.estimate(pixels);
    EXPECT_NEAR(of(maps, ErrorCause::edges, 1, 1), 0.02 * 100.0 / 4.0, 1e-5);
    EXPECT_EQ(of(maps, ErrorCause::blur, 1, 1), 0.0);
    EXPECT_NEAR(of(maps, ErrorCause::direct, 1, 1), 0.04 * 100.0 / 4.0, 1e-5);
    EXPECT_NEAR(of(maps, ErrorCause::gloss, 1, 1), 0.06 * 100.0 / 4.0, 1e-5);
    EXPECT_NEAR(of(maps, ErrorCause::indirect, 1, 1), 0.1 * 0.5 * 0.6 * 100.0 / 5.0, 1e-5);
    EXPECT_NEAR(maps.total(1, 1), std::sqrt(0.5 * 0.5 + 1.0 + 1.5 * 1.5 + 0.6 * 0.6), 1e-5);
    EXPECT_EQ(maps.total(0, 0), 0.0f) << "it is shown white";
    EXPECT_NEAR(maps.total(3, 2), 0.6, 1e-5) << "no noise is seen of it, whatever its size";
    const ErrorMaps blurred = limits.estimate(pixels, true);
    EXPECT_EQ(of(blurred, ErrorCause::edges, 1, 1), 0.0);
    EXPECT_NEAR(of(blurred, ErrorCause::blur, 1, 1), 0.5, 1e-5);
}

TEST(ErrorReport, PixelsThatAreAlikeTellTheErrorOfOneSample) {
    Image<PixelSamples> pixels(5, 1);  // none of the first
    add_halves(pixels(1, 0), 2, 0.1f, {0.02f});
    add_halves(pixels(2, 0), 4, 0.1f, {0.02f});
    add_halves(pixels(3, 0), 4, 0.1f, {0.04f, 0.06f}, 2);  // several objects
    add_halves(pixels(4, 0), 4, 0.1f, {0.0f});
    pixels(4, 0).set_seen_variance(1e-4f);
    Limits limits(5, 1);
    limits.outlines = Image<Outline>(5, 1, Outline::none);
    limits.outlines(3, 0) = Outline::still;
    const ErrorMaps maps = limits.estimate(pixels);
    EXPECT_NEAR(of(maps, ErrorCause::edges, 1), 0.02 * std::sqrt((2.0 + 4.0) / 2.0 / 2.0) * 25.0, 1e-5);
    EXPECT_NEAR(of(maps, ErrorCause::edges, 2), 0.02 * std::sqrt((2.0 + 4.0) / 2.0 / 4.0) * 25.0, 1e-5);
    EXPECT_NEAR(of(maps, ErrorCause::edges, 3), (0.04 + 0.06) * 25.0, 1e-5) << "all of its light counts as edges";
    EXPECT_EQ(of(maps, ErrorCause::direct, 3), 0.0);
    EXPECT_NEAR(of(maps, ErrorCause::edges, 4), 0.01 * 25.0, 1e-5) << "rays that all of its samples have";
    EXPECT_NEAR(of(maps, ErrorCause::edges, 0), 0.02 * std::sqrt(2.0) * 25.0, 1e-5);
}

TEST(ErrorReport, SharesAreThoseOfEightSquaresOfNormalNumbers) {
    // Quantiles of chi-square with 8 degrees of freedom.
    for (const auto& [quantile, beyond] : {std::pair{7.34412, 0.5}, {15.50731, 0.05}, {20.09024, 0.01}}) {
        ErrorMaps maps;
        maps.by_cause.fill(Image<float>(12, 1));
        const double asked = 3.0, energy = asked * asked * 8.0 / quantile;
        maps.total = Image<float>(12, 1, static_cast<float>(std::sqrt(energy)));
        EXPECT_NEAR(count_errors(maps, asked).beyond, beyond, 1e-5);
        maps.by_cause[1](5, 0) = static_cast<float>(std::sqrt(3.0 * energy));  // seen at three pixels
        const ErrorShares shares = count_errors(maps, asked);
        EXPECT_NEAR(shares.by_cause[1], beyond * 3.0 / 12.0, 1e-5);
        EXPECT_EQ(shares.by_cause[0], 0.0);
    }
    EXPECT_EQ(count_errors(ErrorMaps{}, 1.0).beyond, 0.0);
}

}  // namespace
}  // namespace aleph
