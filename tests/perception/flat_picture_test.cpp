// Flat pictures: every pixel ties with its neighbours. The search for local maxima must not store all of them.

#include <gtest/gtest.h>

#include <functional>

#include "engine/base/parallel.h"
#include "perception/normalize.h"
#include "perception/perception.h"
#include "tests/support/allocations.h"

namespace aleph {
namespace {

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
