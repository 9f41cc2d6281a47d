// Progressive sampling on pixels whose samples are known distributions: stages, decisions, unbiased means.

#include "render/shade/progressive.h"
#include "engine/base/sampling.h"
#include "render/shade/resolve.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr Sampling rules[] = {Sampling::consecutive, Sampling::variance, Sampling::protocol, Sampling::threshold};

/// A sample's luminance, from uniform numbers of its own.
using Distribution = std::function<double(RandomStream&)>;

Image<PixelSamples> sample_picture(const SamplingPlan& plan, std::uint32_t seed, const Distribution& draw) {
    Image<PixelSamples> pixels(plan.aleph.width, plan.aleph.height);
    sample_by_stages(plan, pixels, [&](std::span<const PixelRange> ranges) {
        for (const PixelRange& range : ranges) {
            const auto pixel = static_cast<std::uint32_t>(pixels.index(range.x, range.y));
            for (int i = range.first; i < range.last; ++i) {
                RandomStream random({seed, 0, pixel, static_cast<std::uint32_t>(i)});
                pixels(range.x, range.y).add(grey_sample(static_cast<float>(draw(random))));
            }
        }
    });
    spread_lost_light(pixels, plan.outlines, 2 * plan.reach, plan.white);
    return pixels;
}

SamplingPlan make_plan(Sampling rule, int most, int width, int height, float tolerance, float aleph = 1.0f) {
    SamplingPlan plan;
    plan.rule = rule;
    plan.most = most;
    plan.reach = 4;
    plan.aleph = Image<float>(width, height, aleph);
    if (rule != Sampling::protocol && rule != Sampling::uniform)
        plan.tolerance = Image<float>(width, height, tolerance);
    return plan;
}

Distribution rarely_lit(double p, double light = 1.0) {
    return [=](RandomStream& random) { return random.next() < p ? light : 0.0; };
}

/// Pictures of 10,000 pixels: a mean that is biased towards early calm runs would show beside its error.
/// @param numbers  samples that pixels took; may be null
Mean draw_pictures(const SamplingPlan& plan, const Trial& trial, const Distribution& draw,
                   std::set<int>* numbers = nullptr) {
    Mean pictures;
    for (std::uint32_t run = 0; run < trial.times(12u); ++run) {
        double sum = 0.0;
        for (const PixelSamples& pixel : sample_picture(plan, run + trial.seed, draw).pixels) {
            sum += luminance(pixel.mean()) / 1e4;
            if (numbers != nullptr) numbers->insert(pixel.taken());
        }
        pictures.add(sum);
    }
    return pictures;
}

void expect_unbiased(double p, double light, float tolerance) {
    for (const Sampling rule : rules) {
        SCOPED_TRACE(testing::Message() << "rule " << static_cast<int>(rule) << ", probability " << p);
        const SamplingPlan plan = make_plan(rule, 512, 100, 100, tolerance, 8.0f);
        EXPECT_TRUE(holds([&](Trial& trial) {
            std::set<int> numbers;
            const Mean pictures = draw_pictures(plan, trial, rarely_lit(p, light), &numbers);
            trial.near(pictures, p * light);
            EXPECT_LT(pictures.error(), 0.1 * p * light);
            if (rule == Sampling::threshold) {
                EXPECT_GT(numbers.size(), 1u);
            }
        }));
    }
}

TEST(ProgressiveSampling, MC21_RarelyLitPixelsKeepTheirMean) {
    expect_unbiased(0.02, 1.0, 0.02f);
    expect_unbiased(0.5, 1.0, 0.1f);
}

TEST(ProgressiveSampling, MC21_OwnSamplesMakeRarelyLitPixelsTooDark) {
    // As (6.10) and (6.12) are printed, a pixel stops if its first 16 samples are dark, as .98^16 = 72 % of them are.
    // With (6.12) the others go on to the end: one lit sample of 512 has a deviation of .044.
    constexpr double p = 0.02, tolerance = 0.02, first = 16.0, most = 512.0;
    const double lit = 1.0 - std::pow(1.0 - p, first);
    for (const Sampling rule : {Sampling::consecutive, Sampling::variance}) {
        SCOPED_TRACE(static_cast<int>(rule));
        SamplingPlan plan = make_plan(rule, static_cast<int>(most), 100, 100, static_cast<float>(tolerance));
        plan.stopping = Stopping::pixel;
        EXPECT_TRUE(holds([&](Trial& trial) {
            const Mean pictures = draw_pictures(plan, trial, rarely_lit(p));
            trial.at_most(pictures, 0.9 * p);
            if (rule == Sampling::variance) trial.near(pictures, p * (first + (most - first) * lit) / most);
        }));
        plan.stopping = Stopping::neighbourhood;
        EXPECT_TRUE(holds([&](Trial& trial) { trial.near(draw_pictures(plan, trial, rarely_lit(p)), p); }));
    }
}

TEST(ProgressiveSampling, MC21_SpikesKeepTheirMean) {
    expect_unbiased(1e-3, 1e4, 1.0f);
}

TEST(ProgressiveSampling, MC02_AnEmitterThatIsSeldomHit) {
    expect_unbiased(1.0 / 64.0, 64.0, 1.0f);
}

TEST(ProgressiveSampling, MC02_RareBrightSamplesLeaveNoBrightPixels) {
    // One sample of 1000 among four would leave 250 in each of some 40 pixels; two of 32, one in each half, tell no
    // error.
    constexpr double p = 1e-3, light = 1e3;
    const SamplingPlan plan = make_plan(Sampling::threshold, 4096, 100, 100, 2.0f);
    int bright = 0, few_samples = 0;
    for (const PixelSamples& pixel : sample_picture(plan, 5, rarely_lit(p, light)).pixels) {
        if (luminance(pixel.mean()) > 12.0f) ++bright;
        if (pixel.taken() == own_samples) ++few_samples;
    }
    EXPECT_GT(few_samples, 2000) << "they stop before they meet one";
    EXPECT_LE(bright, 4);
}

TEST(ProgressiveSampling, MC17_BlackPixelsStopAtTheLeastNumber) {
    for (const Sampling rule : rules) {
        for (const float tolerance : {0.0f, 1e-6f}) {
            const SamplingPlan plan = make_plan(rule, 512, 8, 6, tolerance, 1000.0f);
            for (const PixelSamples& pixel : sample_picture(plan, 0, rarely_lit(0.0)).pixels)
                EXPECT_EQ(pixel.taken(), rule == Sampling::threshold ? own_samples : 16);
        }
    }
}

double next_number(RandomStream& random) {
    return random.next();
}

TEST(ProgressiveSampling, ToleranceThatIsNotANumberSamplesToTheEnd) {
    const SamplingPlan plan = make_plan(Sampling::threshold, 64, 4, 3, float_nan);
    for (const PixelSamples& pixel : sample_picture(plan, 0, next_number).pixels) EXPECT_EQ(pixel.taken(), 64);
}

TEST(ProgressiveSampling, OnePixelDecidesByItself) {
    const SamplingPlan plan = make_plan(Sampling::threshold, 4096, 1, 1, 0.02f);
    const int taken = sample_picture(plan, 1, next_number)(0, 0).taken();
    EXPECT_GT(taken, own_samples);
    EXPECT_LT(taken, 4096);
}

TEST(ProgressiveSampling, SamplesFollowTheTolerance) {
    // Independent samples of deviation s need n = (d s / t)^2 for d standard errors within t, and at most twice that
    // after doubling. The error is told by 24 neighbours, so that some pixels stop too early.
    const double deviation = std::sqrt(1.0 / 12.0);
    for (const float tolerance : {0.2f, 0.1f, 0.05f}) {
        const SamplingPlan plan = make_plan(Sampling::threshold, 4096, 40, 30, tolerance);
        double samples = 0.0;
        int beyond = 0;
        for (const PixelSamples& pixel : sample_picture(plan, 3, next_number).pixels) {
            samples += pixel.taken() / 1200.0;
            if (std::abs(luminance(pixel.mean()) - 0.5) > tolerance) ++beyond;
        }
        const double needed = std::pow(error_deviations * deviation / tolerance, 2.0);
        EXPECT_GT(samples, 0.7 * needed);
        EXPECT_LT(samples, 2.2 * needed);
        EXPECT_LE(beyond, 1200 * 12 / 100);  // 11.3 % of a normal distribution at the limit
    }
}

TEST(ProgressiveSampling, PixelsShownWhiteStop) {
    SamplingPlan plan = make_plan(Sampling::threshold, 4096, 8, 8, 1e-3f);
    const Distribution brighter = [](RandomStream& random) { return 10.0 + random.next(); };
    plan.white = 9.0;
    EXPECT_EQ(sample_picture(plan, 1, brighter)(3, 3).taken(), 16);
    plan.white = 11.0;
    EXPECT_EQ(sample_picture(plan, 1, brighter)(3, 3).taken(), 4096);
}

TEST(ProgressiveSampling, PixelsThatMissedWhatIsDarkDoNotCountAsWhite) {
    // The mean is not white. A fifth of the pixels meet nothing dark in 16 samples, and the others tell them.
    SamplingPlan plan = make_plan(Sampling::threshold, 1024, 20, 20, 1e-3f);
    plan.white = 1.0;
    const Image<PixelSamples> pixels =
        sample_picture(plan, 1, [](RandomStream& random) { return random.next() < 0.1 ? 0.0 : 1.1; });
    for (const PixelSamples& pixel : pixels.pixels) EXPECT_EQ(pixel.taken(), 1024);
}

TEST(ProgressiveSampling, SmallObjectsAndStrongContrastsBeginWithMoreSamples) {
    SamplingPlan plan = make_plan(Sampling::threshold, 64, 6, 1, 1.0f);
    plan.outlines = Image<Outline>(6, 1, Outline::none);
    plan.outlines(3, 0) = Outline::strong;
    plan.outlines(4, 0) = Outline::small;
    const Image<PixelSamples> pixels = sample_picture(plan, 1, rarely_lit(0.0));
    EXPECT_EQ(pixels(1, 0).taken(), own_samples);
    EXPECT_EQ(pixels(3, 0).taken(), 32);
    EXPECT_EQ(pixels(4, 0).taken(), 32);
    plan.most = 8;
    EXPECT_EQ(sample_picture(plan, 1, rarely_lit(0.0))(4, 0).taken(), 8);
}

TEST(ProgressiveSampling, AnOutlineNeedsFewerSamplesThanItsOwnErrorSays) {
    // Columns of deviation 8 in a picture of deviation 1: the energy within reach is within the tolerance with
    // fewer samples than each pixel's own error asks for, fewer still where no pixel goes on by itself.
    constexpr int width = 45, height = 45, period = 9;
    constexpr float tolerance = 0.5f;
    SamplingPlan plan = make_plan(Sampling::threshold, 1 << 14, width, height, tolerance);
    plan.outlines = Image<Outline>(width, height, Outline::none);
    for (int y = 0; y < height; ++y) {
        for (int x = 4; x < width; x += period) plan.outlines(x, y) = Outline::still;
    }
    Image<PixelSamples> pixels(width, height);
    sample_by_stages(plan, pixels, [&](std::span<const PixelRange> ranges) {
        for (const auto& [x, y, first, last] : ranges) {
            for (int i = first; i < last; ++i) {
                RandomStream random(
                    {1, 0, static_cast<std::uint32_t>(pixels.index(x, y)), static_cast<std::uint32_t>(i)});
                const double deviation = plan.outlines(x, y) == Outline::none ? 1.0 : 8.0;
                pixels(x, y).add(
                    grey_sample(static_cast<float>(10.0 + deviation * std::sqrt(12.0) * (random.next() - 0.5))));
            }
        }
    });
    const Image<float> around = deviations_around(pixels, plan.reach);
    double taken = 0.0, energy = 0.0, alone = 0.0, by_neighbours = 0.0;
    for (const auto [x, y] : all_pixels(width, height)) {
        const double deviation = plan.outlines(x, y) == Outline::none ? 1.0 : 8.0;
        taken += pixels(x, y).taken();
        energy += std::pow(luminance(pixels(x, y).mean()) - 10.0, 2.0) / (width * height);
        alone += std::pow(error_deviations * deviation / tolerance, 2.0);
        MeanEstimate mean = estimate_mean(pixels, plan.outlines, x, y);
        const double error2_of_one = mean.error2 * mean.samples;
        mean.around = static_cast<double>(around(x, y));
        for (mean.samples = own_samples; mean.samples < plan.most; mean.samples *= 2) {
            mean.error2 = error2_of_one / mean.samples;
            if (is_enough(plan.rule, plan.stopping, mean, tolerance)) break;
        }
        by_neighbours += mean.samples;
    }
    EXPECT_LT(std::sqrt(energy) * error_deviations, 1.1 * tolerance);
    EXPECT_LT(by_neighbours, 0.7 * alone);
    EXPECT_LT(taken, 0.8 * alone);
    EXPECT_GT(pixels(22, 4).taken(), pixels(20, 4).taken());
}

TEST(ProgressiveSampling, LaterSamplesArePredictedFromThoseThatGoOn) {
    const std::vector<PixelRange> stage(100, PixelRange{0, 0, 4, 8});
    EXPECT_EQ(sum_samples(stage), 400.0);
    EXPECT_EQ(predict_samples(stage, 100, 32), 100.0 * (8 + 16));  // all go on
    EXPECT_NEAR(predict_samples(stage, 125, 40), 80.0 * 8 + 64.0 * 16 + 51.2 * 8, 1e-9);
    EXPECT_NEAR(predict_samples(stage, 0, 16), 40.0 * 8, 1e-9);  // none went before
    EXPECT_NEAR(predict_samples(stage, 1000, 16), 40.0 * 8, 1e-9);
    EXPECT_EQ(predict_samples(stage, 100, 8), 0.0);
}

}  // namespace
}  // namespace aleph
