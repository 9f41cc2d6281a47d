#include "perception/band_response.h"
#include "engine/base/opponent_color.h"
#include "engine/base/parallel.h"
#include "tests/support/scenes/perception_scene.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(BandResponse, ContrastUnderTheNoiseThresholdIsNone) {
    Image<float> image(64, 64, 1.0f);
    RandomStream random({1, 0, 0, 0});
    for (float& v : image.pixels) v += 1e-6f * random.next();
    const auto flat = compute_band_response(image);
    for (const float r : flat[6].pixels) ASSERT_EQ(r, 1.0f);
    for (float& v : image.pixels) v += 1e-2f * random.next();
    const auto textured = compute_band_response(image);
    double finest = 0.0;
    for (const float r : textured[0].pixels) finest += r / static_cast<double>(image.size());
    EXPECT_GT(finest, 0.5);
}

TEST(BandResponse, SummaryIsTheSameForAnyNumberOfThreads) {
    const Image<float> image = compute_opponent(make_synthetic_frame(301, 77).estimate, OpponentChannel::a, false);
    const auto summarize_with = [&](int threads) {
        const ThreadLimit limit(threads);
        return summarize(image);
    };
    EXPECT_FLOAT_EQ(summarize_with(1).mean, static_cast<float>(mean_of(image)));
    EXPECT_EQ(summarize_with(1).maximum, *std::max_element(image.pixels.begin(), image.pixels.end()));
    EXPECT_EQ(summarize_with(3).mean, summarize_with(1).mean);
}

}  // namespace
}  // namespace aleph
