// Saliency and Aleph maps against a slow, direct implementation of the equations (perception_reference.h).

#include "perception/saliency/saliency.h"
#include "perception/perception.h"
#include "tests/support/perception_reference.h"
#include "tests/support/scenes/perception_scene.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

double percentile(std::vector<double> values, double q) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

class AgainstReference : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(AgainstReference, FullGridAgrees) {
    const auto [width, height] = GetParam();
    const SyntheticFrame frame = make_synthetic_frame(width, height);
    const ReferenceMaps reference = reference_perception(frame.estimate, frame.velocity);
    const PerceptionMaps maps = compute_perception(frame.estimate, frame.velocity, {}, {}, {});
    ASSERT_FALSE(reference.fallback);
    ASSERT_FALSE(maps.fallback);
    std::vector<double> saliency_errors;
    double aleph_error = 0.0;
    for (std::size_t i = 0; i < maps.aleph.size(); ++i) {
        saliency_errors.push_back(std::abs(maps.saliency.pixels[i] - reference.saliency.pixels[i]));
        // Near the noise threshold of the bands the result depends on rounding.
        if (std::abs(reference.band_sum.pixels[i] / 1e-5 - 1.0) < 0.1) continue;
        aleph_error = std::max(aleph_error, std::abs(maps.aleph.pixels[i] / reference.aleph.pixels[i] - 1.0));
    }
    EXPECT_LT(percentile(saliency_errors, 0.99), 1e-3);
    EXPECT_LT(aleph_error, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Sizes, AgainstReference,
                         testing::Values(std::pair{640, 480}, std::pair{333, 211}, std::pair{96, 64},
                                         std::pair{61, 17}));

TEST(Saliency, CenterGridIsCloseToFull) {
    const SyntheticFrame frame = make_synthetic_frame(640, 480);
    const auto saliency_on = [&](SaliencyGrid grid) {
        return compute_perception(frame.estimate, frame.velocity, {}, {}, {.grid = grid}).saliency;
    };
    EXPECT_GT(correlation(saliency_on(SaliencyGrid::center), saliency_on(SaliencyGrid::full)), 0.95);
}

TEST(Saliency, ALoneMovingThingOnAFlatFrameIsWhatStandsOut) {
    const Image<Rgb> estimate(320, 240, Rgb(0.4f));
    Image<float> velocity(320, 240);
    for (int y = 100; y < 130; ++y) std::fill_n(velocity.row(y) + 200, 30, 8.0f);
    for (const SaliencyGrid grid : {SaliencyGrid::full, SaliencyGrid::center}) {
        const Image<float> s = compute_perception(estimate, velocity, {}, {}, {.grid = grid}).saliency;
        EXPECT_GT(s(215, 115), 0.8f);
        EXPECT_LT(s(40, 200), 0.1f);
    }
}

TEST(Saliency, NeutralOpponentColoursChangeOnlyTheColourChannel) {
    const SyntheticFrame frame = make_synthetic_frame(160, 120);
    const auto maps_with = [&](bool neutral) {
        return compute_perception(frame.estimate, frame.velocity, {}, {}, {.neutral_opponent = neutral}, {true, true});
    };
    const PerceptionMaps plain = maps_with(false), neutral = maps_with(true);
    EXPECT_EQ(neutral.conspicuity_intensity, plain.conspicuity_intensity);
    EXPECT_EQ(neutral.conspicuity_orientation, plain.conspicuity_orientation);
    EXPECT_EQ(neutral.conspicuity_motion, plain.conspicuity_motion);
    EXPECT_NE(neutral.conspicuity_color, plain.conspicuity_color);
}

}  // namespace
}  // namespace aleph
