// Tolerances of samples, from thresholds and the error that is asked for.

#include "render/shade/error_budget.h"
#include "render/guide/stopping_rule.h"
#include "tests/support/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(ErrorBudget, MovingOutlinesKeepToTheStrictestThresholdAround) {
    Image<float> threshold(5, 5, 8.0f);
    threshold(2, 2) = 2.0f;
    const Image<float> noise(5, 5, 1.0f), aleph(5, 5, 1.0f), accuracy(5, 5, 0.1f);
    Image<Outline> outlines(5, 5, Outline::none);
    outlines(1, 1) = outlines(3, 2) = Outline::moving;
    outlines(2, 1) = Outline::still;
    const VisibleLimits limits{threshold, noise, aleph, accuracy, outlines, ViewingConditions{}};
    RenderSettings settings;
    settings.sampling.rule = Sampling::variance;
    settings.error = 0.5;
    const double white = limits.viewing.display_white;
    const Image<float> tolerance = compute_sampling_tolerance(limits, settings, 4.0);
    EXPECT_NEAR(tolerance(1, 1), 0.5 * 2.0 / white / 4.0, 1e-8);
    EXPECT_NEAR(tolerance(3, 2), 0.5 * 2.0 / white / 4.0, 1e-8);
    EXPECT_NEAR(tolerance(0, 0), 0.5 * 8.0 / white / 4.0, 1e-8);
    EXPECT_NEAR(tolerance(2, 1), 0.5 * 8.0 / white / 4.0, 1e-8);
    EXPECT_NEAR(tolerance(1, 2), 0.5 * 8.0 / white / 4.0, 1e-8);
    settings.sampling.rule = Sampling::uniform;
    EXPECT_TRUE(compute_sampling_tolerance(limits, settings, 4.0).empty());
}

TEST(ErrorBudget, SamplesKeepToTheNoiseThatGoesUnseen) {
    const Image<float> threshold(3, 3, 2.0f), noise(3, 3, 5.0f), aleph(3, 3, 1.0f), accuracy(3, 3, 0.1f);
    const Image<Outline> outlines(3, 3, Outline::none);
    const VisibleLimits limits{threshold, noise, aleph, accuracy, outlines, ViewingConditions{}};
    RenderSettings settings;
    const double unit = noise_allowance * 5.0 / limits.viewing.display_white / 2.0;
    for (const auto& [error, times] : {std::pair(0.5, 0.5), std::pair(1.0, 1.0), std::pair(2.0, std::pow(2.0, 0.8))}) {
        follow_error(settings, error);
        EXPECT_NEAR(compute_sampling_tolerance(limits, settings, 2.0)(1, 1), times * unit, 1e-7) << error;
    }
    settings.error = 0.5;
    const double least = 0.5 * 2.0 / limits.viewing.display_white / 4.0;
    EXPECT_NEAR(compute_gloss_tolerance(limits, settings, 4.0)(1, 1), gloss_share * least, 1e-8);
    settings.error = 0.0;
    EXPECT_TRUE(compute_gloss_tolerance(limits, settings, 4.0).empty());
}

}  // namespace
}  // namespace aleph
