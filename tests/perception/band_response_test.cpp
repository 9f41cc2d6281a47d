#include "perception/band_response.h"
#include "engine/base/opponent_color.h"
#include "engine/base/parallel.h"
#include "tests/support/perception_reference.h"
#include "tests/support/perception_scene.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(BandResponse, SumsToOneEverywhereAndAgreesWithTheDefinition) {
    const SyntheticFrame frame = make_synthetic_frame(211, 150);
    const ReferenceMaps reference = reference_perception(frame.estimate, frame.velocity);
    const auto response = compute_band_response(frame.estimate);
    for (std::size_t p = 0; p < reference.aleph.size(); ++p) {
        double sum = 0.0;
        for (const Image<float>& r : response) {
            ASSERT_GE(r.pixels[p], 0.0f);
            sum += r.pixels[p];
        }
        ASSERT_NEAR(sum, 1.0, 1e-6);
        if (reference.band_sum.pixels[p] < 1e-4) continue;  // near the noise threshold the result depends on rounding
        for (std::size_t i = 0; i < response.size(); ++i) {
            ASSERT_NEAR(response[i].pixels[p], reference.bands[i].pixels[p], 2e-3) << "band " << i;
        }
    }
}

TEST(BandResponse, UniformImageIsAllCoarsestBand) {
    for (const float grey : {0.0f, 0.3f, 1e6f}) {
        const auto response = compute_band_response(Image<float>(40, 30, grey));
        for (int i = 0; i < band_count; ++i) {
            for (const float r : response[i].pixels) ASSERT_EQ(r, i == 6 ? 1.0f : 0.0f);
        }
    }
}

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

TEST(BandResponse, OnePixelCheckerIsAllFinestBand) {
    Image<float> image = checker(64, 48);
    for (float& v : image.pixels) v = 0.2f + 0.6f * v;
    const auto response = compute_band_response(image);
    for (const float r : response[0].pixels) ASSERT_NEAR(r, 1.0, 1e-4);
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
