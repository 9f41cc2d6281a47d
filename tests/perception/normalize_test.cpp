// N(.) where "the average of all other local maxima" is 0/0, or depends on what counts as a local maximum.
// Flat pictures: every pixel ties with its neighbours. The search for local maxima must not store all of them.

#include "perception/saliency/normalize.h"
#include "engine/base/parallel.h"
#include "engine/base/pyramid.h"
#include "engine/base/sampling.h"
#include "perception/perception.h"
#include "tests/support/allocations.h"
#include "tests/support/perception_reference.h"
#include "tests/support/scenes/perception_scene.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(NormalizeHard, PY08_NoOtherLocalMaximum) {
    Image<float> spike(21, 15);
    spike(7, 5) = 3.0f;
    EXPECT_EQ(compute_normalization(spike, 0).weight, 1.0);
    EXPECT_EQ(compute_normalization(spike, 0).scale(), 1.0 / 3.0);

    EXPECT_TRUE(compute_normalization(Image<float>(1, 1, 2.0f), 0).empty);
    EXPECT_EQ(compute_normalization(Image<float>(1, 1, 2.0f), 0).scale(), 0.0);
    Image<float> ramp(1, 40);
    for (int y = 0; y < 40; ++y) ramp(0, y) = static_cast<float>(y);
    EXPECT_EQ(compute_normalization(ramp, 0).weight, 1.0);
}

TEST(NormalizeHard, PY09_PlateausCountOnce) {
    Image<float> spikes(60, 40), plateaus(60, 40);
    const int at[][2] = {{10, 10}, {30, 20}, {50, 30}};
    const float heights[] = {1.0f, 0.5f, 0.25f};
    for (int i = 0; i < 3; ++i) {
        spikes(at[i][0], at[i][1]) = heights[i];
        for (int d = 0; d < 2; ++d) plateaus(at[i][0] + d, at[i][1]) = heights[i];
    }
    const double expected = std::pow(1 - (0.5 + 0.25) / 2, 2);
    EXPECT_NEAR(compute_normalization(spikes, 0).weight, expected, 1e-4);
    EXPECT_EQ(compute_normalization(plateaus, 0).weight, compute_normalization(spikes, 0).weight);

    // A large plateau that touches the border.
    for (int y = 12; y < 40; ++y) std::fill_n(plateaus.row(y) + 40, 20, 0.25f);
    EXPECT_EQ(compute_normalization(plateaus, 0).weight, compute_normalization(spikes, 0).weight);
    // A plateau with a higher pixel at its rim is no maximum.
    plateaus(45, 11) = 0.5f;
    EXPECT_NEAR(compute_normalization(plateaus, 0).weight, std::pow(1 - 0.5, 2), 1e-4);

    // The bright pixels of a one-pixel checkerboard touch at their corners: 8-connected, they are one plateau.
    EXPECT_EQ(compute_normalization(checker(20, 20), 0).weight, 1.0);
}

TEST(NormalizeHard, PY09_RandomPlateausAgreeWithTheFullFloodFill) {
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        RandomStream random({seed, 0, 0, 0});
        const int width = 1 + static_cast<int>(90 * random.next()), height = 1 + static_cast<int>(70 * random.next());
        const float steps = 2 + 12 * random.next();
        Image<float> map(width, height);
        for (float& v : map.pixels) v = std::floor(random.next() * steps) / steps;
        if (seed % 2 == 0) map = low_pass(map);
        DoubleImage exact(width, height);
        std::copy(map.pixels.begin(), map.pixels.end(), exact.pixels.begin());
        EXPECT_NEAR(compute_normalization(map, 1e-9).weight, reference_weight(exact, 1e-9), 1e-9) << seed;
    }
}

TEST(NormalizeHard, PY09_PlateausAreThoseOfTheQuantizedMap) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        RandomStream random({seed, 1, 0, 0});
        Image<float> map(50, 40);
        const float step = seed % 2 == 0 ? 1e-6f : 2e-5f;  // below and above one step of 16 bits
        for (float& v : map.pixels) v = std::floor(4 * random.next()) / 4 + step * random.next();
        DoubleImage exact(map.width, map.height);
        std::copy(map.pixels.begin(), map.pixels.end(), exact.pixels.begin());
        EXPECT_NEAR(compute_normalization(map, 1e-9).weight, reference_weight(exact, 1e-9), 1e-9) << seed;
    }
}

TEST(NormalizeHard, PY10_AllMaximaEqual) {
    Image<float> lattice(64, 64);
    for (int y = 4; y < 64; y += 8) {
        for (int x = 4; x < 64; x += 8) lattice(x, y) = 1.0f;
    }
    EXPECT_NEAR(compute_normalization(lattice, 0).weight, 0.0, 1e-12);
    EXPECT_FALSE(compute_normalization(lattice, 0).empty);
}

TEST(NormalizeHard, PY10_MaximaUnderATenthAreDropped) {
    Image<float> map(64, 16);
    map(5, 5) = 1.0f;
    for (int x = 12; x < 60; x += 4) map(x, 8) = 0.099f;
    EXPECT_EQ(compute_normalization(map, 0).weight, 1.0);
    for (int x = 12; x < 60; x += 4) map(x, 8) = 0.101f;
    EXPECT_NEAR(compute_normalization(map, 0).weight, std::pow(1 - 0.101, 2), 1e-4);
}

constexpr int width = 3840, height = 2160;
constexpr double mebibytes_per_float = 4.0 * width * height / (1 << 20);  // of a map at full size

/// Peak memory of `work` on one thread, MiB.
double peak_memory(const std::function<void()>& work) {
    const ThreadLimit one(1);
    return count_allocations(work).peak_mebibytes();
}

TEST(FlatPicture, PY09_SaliencyOf4KStaysWithin16FloatsPerPixel) {
    const double mebibytes = peak_memory([] {
        const Image<Rgb> estimate(width, height, Rgb(0.4f, 0.5f, 0.3f));
        const Image<float> velocity(width, height, 8.0f);
        const PerceptionMaps maps = compute_perception(estimate, velocity, {}, {}, {});
        EXPECT_TRUE(maps.fallback) << "something stands out of a flat picture";
    });
    EXPECT_LT(mebibytes, 16 * mebibytes_per_float);
}

TEST(FlatPicture, PY09_NormalizationOf4KStaysWithin6FloatsPerPixel) {
    // One dark pixel, so that the range is above the floor and the rest is one plateau.
    const double mebibytes = peak_memory([&] {
        Image<float> map(width, height, 1.0f);
        map(width / 2, height / 2) = 0.0f;
        EXPECT_EQ(compute_normalization(map, 1e-6).weight, 1.0) << "a plateau counts once";
    });
    EXPECT_LT(mebibytes, 6 * mebibytes_per_float);
    const double below_floor = peak_memory([&] {
        const Image<float> map(width, height, 1.0f);
        EXPECT_TRUE(compute_normalization(map, 1e-6).empty) << "a flat map has no range";
    });
    EXPECT_LT(below_floor, 6 * mebibytes_per_float);
}

}  // namespace
}  // namespace aleph
