// The fast saliency and Aleph maps against the slow and obvious definition (perception_reference.h).

#include "perception/saliency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "perception/perception.h"
#include "tests/unit/perception_reference.h"
#include "tests/unit/perception_scene.h"

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
    const PerceptionMaps maps = compute_perception(frame.estimate, frame.velocity, {}, {});
    ASSERT_FALSE(reference.fallback);
    ASSERT_FALSE(maps.fallback);
    std::vector<double> saliency_errors;
    double aleph_error = 0.0;
    for (std::size_t i = 0; i < maps.aleph.size(); ++i) {
        saliency_errors.push_back(std::abs(maps.saliency.pixels[i] - reference.saliency.pixels[i]));
        // Near the noise threshold of the bands rounding decides.
        if (std::abs(reference.band_sum.pixels[i] / 1e-5 - 1.0) < 0.1) continue;
        aleph_error = std::max(aleph_error, std::abs(maps.aleph.pixels[i] / reference.aleph.pixels[i] - 1.0));
    }
    EXPECT_LT(percentile(saliency_errors, 0.99), 1e-3);
    EXPECT_LT(aleph_error, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Sizes, AgainstReference,
                         testing::Values(std::pair{640, 480}, std::pair{333, 211}, std::pair{96, 64},
                                         std::pair{61, 17}));

}  // namespace
}  // namespace aleph
