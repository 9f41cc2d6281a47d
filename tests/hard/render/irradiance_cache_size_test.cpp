// The work of a look-up in irradiance caches of very different sizes.

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <random>

#include "tests/support/render_scenes.h"

namespace aleph {
namespace {

const glm::vec3 up(0.0f, 1.0f, 0.0f);

/// Records on a square of 1 m, each reaching a few of its neighbours, and now and then one that reaches far.
IrradianceCache make_square(int side) {
    IrradianceCache cache(glm::vec3(0.0f), glm::vec3(1.0f));
    const float spacing = 1.0f / static_cast<float>(side);
    for (int i = 0; i < side * side; ++i) {
        IrradianceRecord record;
        record.position =
            spacing * glm::vec3(static_cast<float>(i % side) + 0.5f, 0.0f, static_cast<float>(i / side) + 0.5f);
        record.normal = up;
        record.irradiance = Rgb(1.0f);
        record.radius = 2.0f * spacing;
        record.min_radius = record.radius;  // neighbours do not shrink it
        if (i % (side * side / 10) == 0) record.radius = record.min_radius = 0.25f;
        cache.insert(record);
    }
    return cache;
}

/// Seconds of processor time for a look-up at a random place: the least of several runs.
double time_look_up(const IrradianceCache& cache) {
    constexpr int look_ups = 20'000;
    std::mt19937 engine(7);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    double least = 1e30;
    for (int run = 0; run < 5; ++run) {
        const std::clock_t start = std::clock();
        for (int i = 0; i < look_ups; ++i) {
            const glm::vec3 place(unit(engine), 0.0f, unit(engine));
            EXPECT_NEAR(cache.interpolate({place, up, 0.75f}).value_or(Rgb(0.0f)).x, 1.0f, 1e-4f);
        }
        least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / look_ups);
    }
    return least;
}

// A ratio of times in one run, as no count shows what a look-up touches. A walk over all records would give 1000.
TEST(IrradianceCache, IC15_AThousandTimesTheRecordsTakeLessThanTenTimesAsLong) {
    const double thousand = time_look_up(make_square(32)), million = time_look_up(make_square(1000));
    EXPECT_LT(million, 10.0 * thousand) << 1e6 * thousand << " and " << 1e6 * million << " us";
}

}  // namespace
}  // namespace aleph
