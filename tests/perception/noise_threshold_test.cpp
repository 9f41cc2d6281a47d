// Noise of single pixels, against sums over its frequencies.

#include "perception/noise_threshold.h"
#include "perception/visible_bands.h"
#include "perception/vision/castle.h"
#include "perception/vision/display_hold.h"
#include "tests/support/test.h"

namespace aleph::noise_threshold_test {
namespace {

constexpr FrameRate thirty{30, 1};

/// D L / sigma by a dense sum over the square of frequencies and over time.
double sensitivity(double luminance, double retinal, double tracked, NoiseOverTime over_time,
                   const ViewingConditions& viewing = {},
                   double (&to_pattern)(double, double, double, double) = castle_sensitivity) {
    constexpr int cells = 150, times = 8;
    double energy = 0.0;
    for (const auto [x, y] : all_pixels(cells, cells)) {
        const double u = 0.5 * (x + 0.5) / cells, v = 0.5 * (y + 0.5) / cells;  // a quarter: the rest is its mirror
        const double rho = std::hypot(u, v) * viewing.pixels_per_degree, radius = 1.5 / rho;
        const double area = std::numbers::pi * radius * radius;
        const double held = hold_transfer(rho, tracked, viewing.persistence, thirty);
        const int count = over_time == NoiseOverTime::fresh ? times : 1;
        for (int t = 0; t < count; ++t) {
            const double omega = count == 1 ? 0.0 : 15.0 * (t + 0.5) / count;
            for (const double sign : {-1.0, 1.0}) {
                const double shifted = std::abs(omega + sign * rho * retinal);
                energy += 0.5 * std::pow(held * to_pattern(rho, shifted, luminance, area), 2.0) / count;
            }
        }
    }
    return std::sqrt(2.0 * energy / (cells * cells));
}

TEST(NoiseThreshold, IsTheSumOverTheFrequenciesOfTheNoise) {
    for (const NoiseOverTime over_time : {NoiseOverTime::fresh, NoiseOverTime::lasts}) {
        const NoiseVisibility noise({}, thirty, over_time);
        for (const double luminance : {0.3, 100.0}) {
            for (const double retinal : {0.15, 9.0}) {
                for (const double tracked : {0.0, 30.0}) {
                    const double exact = luminance / std::max(1.0, sensitivity(luminance, retinal, tracked, over_time));
                    const float found = noise.threshold(static_cast<float>(luminance), static_cast<float>(retinal),
                                                        static_cast<float>(tracked));
                    EXPECT_NEAR(found / exact, 1.0, 0.06) << luminance << " " << retinal << " " << tracked;
                }
            }
        }
    }
}

TEST(NoiseThreshold, NoiseOfRedAndGreenIsWorthItsVisibility) {
    Image<Rgb> primaries(3, 1);
    for (int i = 0; i < 3; ++i) primaries(i, 0)[i] = 1.0f;
    const Image<float> signals = compute_visual_channel(primaries, 1.0, 1);
    const float grey = signals(0, 0) + signals(1, 0) + signals(2, 0);
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(signals(i, 0) - grey * luminance(primaries(i, 0)), red_green_weights[i], 1e-5f);
    EXPECT_NEAR(red_green_weights.x + red_green_weights.y + red_green_weights.z, 0.0f, 1e-8f);

    ViewingConditions viewing;
    for (const double pixels_per_degree : {20.0, 62.0}) {
        viewing.pixels_per_degree = pixels_per_degree;
        for (const NoiseOverTime over_time : {NoiseOverTime::fresh, NoiseOverTime::lasts}) {
            for (const double luminance : {2.0, 20.0, 80.0}) {
                for (const double retinal : {0.15, 9.0}) {
                    const double worth = sensitivity(luminance, retinal, 0.0, over_time, viewing, castle_red_green) /
                                         sensitivity(luminance, retinal, 0.0, over_time, viewing);
                    EXPECT_GT(worth / red_green_worth, luminance < 20.0 ? 0.55 : 0.88) << luminance << " " << retinal;
                    EXPECT_LT(worth / red_green_worth, 1.25) << luminance << " " << retinal;
                }
            }
        }
    }
}

/// With large pixels, noise is seen at the corners of the pixel grid's square of frequencies too.
TEST(NoiseThreshold, LargePixelsShowAllFrequencies) {
    ViewingConditions viewing;
    viewing.pixels_per_degree = 6.0;
    const NoiseVisibility noise(viewing, thirty, NoiseOverTime::lasts);
    const double exact = 100.0 / sensitivity(100.0, 0.15, 0.0, NoiseOverTime::lasts, viewing);
    EXPECT_NEAR(noise.threshold(100.0f, 0.15f, 0.0f) / exact, 1.0, 0.06);
}

/// The energy of one pixel spreads as wide as so many passes of the kernel, whose variance is .9, say.
TEST(VisibleBands, AmplitudesAreBlurredAsOftenAsABandSays) {
    for (const BandShape& band : visible_bands(4, 4)) {
        Image<float> signal(41, 41);
        signal(20, 20) = 3.0f;
        const Image<float> amplitude = local_amplitude(signal, band);
        double energy = 0.0, second = 0.0;
        for (const auto [x, y] : all_pixels(41, 41)) {
            const double part = std::pow(amplitude(x, y) / band.gain, 2.0) / 2.0;
            energy += part;
            second += part * (x - 20) * (x - 20);
        }
        EXPECT_NEAR(energy, 9.0, 1e-4);
        EXPECT_NEAR(second / energy, 0.9 * band.blurs, 1e-4);
    }
}

TEST(NoiseThreshold, EveryInputHasAPositiveResult) {
    const NoiseVisibility noise({}, thirty, NoiseOverTime::fresh);
    for (const float luminance : {float_nan, -1.0f, 0.0f, 1e-6f, 1.0f, 1e6f, float_infinity}) {
        for (const float velocity : {float_nan, -1.0f, 0.0f, 1e-9f, 0.1f, 100.0f, 1e9f, float_infinity}) {
            const float threshold = noise.threshold(luminance, velocity, velocity);
            EXPECT_GT(threshold, 0.0f) << luminance << " " << velocity;
            EXPECT_TRUE(std::isfinite(threshold)) << luminance << " " << velocity;
        }
    }
    const Image<float> a(3, 2, 10.0f), b(2, 3, 1.0f);
    const Image<Rgb> shown(3, 2, Rgb(0.1f));
    EXPECT_THROW(compute_noise_threshold(noise, shown, 100.0, a, b, b), InputError);
    EXPECT_THROW(compute_noise_threshold(noise, shown, 100.0, a, a, b), InputError);
    EXPECT_THROW(compute_noise_threshold(noise, Image<Rgb>(2, 3, Rgb(0.1f)), 100.0, a, a, a), InputError);
    const Image<float> moving = compute_noise_threshold(noise, shown, 100.0, a, Image<float>(3, 2, 0.15f), a);
    const Image<float> still = compute_noise_threshold(noise, shown, 100.0, a, Image<float>(3, 2, 0.15f), {});
    EXPECT_GT(moving(0, 0), still(0, 0)) << "a display that holds frames blurs what is followed";
}

TEST(NoiseThreshold, ContrastOfABandMasksTheNoiseInIt) {
    const NoiseVisibility noise({}, thirty, NoiseOverTime::fresh);
    const float bare = noise.threshold(50.0f, 0.15f, 0.0f);
    BandContrasts all{};
    float last = bare;
    for (std::size_t band = 0; band < noise_bands; ++band) {
        all[band] = 1.0f;
        const float more = noise.threshold(50.0f, 0.15f, 0.0f, all);
        EXPECT_GT(more, 1.01f * last) << band;
        last = more;
    }
    // Contrast of 1 is many thresholds: the constants of contrast_masking bound what it may hide.
    EXPECT_GT(last, 2.0f * bare);
    EXPECT_LT(last, contrast_masking(150.0f, 0) * bare);
    EXPECT_EQ(noise.threshold(50.0f, 0.15f, 0.0f, {0.0f, 0.0f, 0.0f, 0.0f}), bare);
    // k = .160, q = 1.303, w = .877, p = 2.264, by hand at ten thresholds.
    EXPECT_NEAR(contrast_masking(10.0f, 0), std::pow(1.0 + 0.876909 * std::pow(1.60141, 1.302623), 1.0 / 2.264355),
                1e-4);
    EXPECT_EQ(contrast_masking(0.0f, 0), 1.0f);
    EXPECT_EQ(contrast_masking(float_nan, 2), 1.0f);
}

TEST(NoiseThreshold, APictureMasksWhereItHasContrast) {
    constexpr int width = 64, height = 32;
    Image<Rgb> picture(width, height, Rgb(0.5f));
    for (const auto [x, y] : all_pixels(width / 2, height))
        picture(x, y) = Rgb(x / 4 % 2 == 0 ? 0.3f : 0.7f);  // an eighth of a cycle a pixel
    const Image<float> adaptation(width, height, 50.0f), retinal(width, height, 0.15f);
    const NoiseVisibility noise({}, thirty, NoiseOverTime::fresh);
    const Image<float> threshold = compute_noise_threshold(noise, picture, 100.0, adaptation, retinal, {});
    const float bare = noise.threshold(50.0f, 0.15f, 0.0f);
    EXPECT_GT(threshold(12, 16), 1.5f * bare);
    EXPECT_NEAR(threshold(60, 16), bare, 0.02f * bare) << "coarse bands reach far";
    picture(3, 3) = Rgb(float_nan);
    picture(4, 3) = Rgb(float_infinity);
    for (const float value : compute_noise_threshold(noise, picture, 100.0, adaptation, retinal, {}).pixels) {
        EXPECT_TRUE(std::isfinite(value));
        EXPECT_GE(value, 0.999f * bare);
    }
}

}  // namespace
}  // namespace aleph::noise_threshold_test
