// Flicker along a known motion, against what it must be by construction.

#include "render/compare/compare_flicker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "engine/base/errors.h"

namespace aleph {
namespace {

constexpr int width = 24, height = 16;

/// An error in cd/m2 from a function of position in pixels.
LuminanceError error_of(const std::function<double(double, double)>& at) {
    LuminanceError error{Image<double>(width, height), {}, 100.0};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) error.error(x, y) = at(x, y);
    }
    return error;
}

LuminanceError constant_error(double value) {
    return error_of([value](double, double) { return value; });
}

/// One motion everywhere, in pixels; v upwards, as in the files.
FlickerMaps uniform_motion(float u, float v) {
    return {Image<float>(width, height, u),    Image<float>(width, height, v),    Image<float>(width, height, 1.0f),
            Image<float>(width, height, 5.0f), Image<float>(width, height, 2.0f), false};
}

const Image<float> same_objects(width, height, 5.0f);

TEST(Flicker, LastingErrorDoesNotFlicker) {
    const LuminanceError error = error_of([](double x, double y) { return 3.0 * std::sin(x) - 20.0 * y; });
    const FlickerSum sum = measure_flicker(error, error, uniform_motion(0.0f, 0.0f), same_objects);
    EXPECT_EQ(sum.rest.errors.count(), static_cast<std::size_t>(width * height));
    EXPECT_EQ(sum.moving.errors.count(), 0u);
    EXPECT_EQ(sum.left_out, 0u);
    EXPECT_EQ(sum.rest.errors.worst(), 0.0);
}

TEST(Flicker, AlternatingErrorFlickersByTwiceItsSize) {
    for (const double motion : {0.0, 2.0}) {
        const FlickerSum sum = measure_flicker(constant_error(3.0), constant_error(-3.0),
                                               uniform_motion(static_cast<float>(motion), 0.0f), same_objects);
        const ThresholdSum& part = motion == 0.0 ? sum.rest : sum.moving;
        EXPECT_GT(part.errors.count(), 300u);
        EXPECT_EQ(part.errors.beyond(), part.errors.count());
        EXPECT_DOUBLE_EQ(part.errors.worst(), 3.0);  // 6 cd/m2 over a threshold of 2
    }
}

TEST(Flicker, ErrorThatRidesOnItsSurfaceDoesNotFlicker) {
    const auto pattern = [](double x, double y) { return 10.0 * std::sin(1.7 * x) * std::cos(2.3 * y); };
    const auto moved = [&](double x, double y) { return pattern(x - 3.0, y + 2.0); };  // 3 right, 2 up
    const FlickerSum along =
        measure_flicker(error_of(pattern), error_of(moved), uniform_motion(3.0f, 2.0f), same_objects);
    EXPECT_EQ(along.moving.errors.count(), static_cast<std::size_t>((width - 3) * (height - 2)));
    EXPECT_EQ(along.left_out, static_cast<std::size_t>(width * height - (width - 3) * (height - 2)));
    EXPECT_LT(along.moving.errors.worst(), 1e-9);
    // In place, and with v taken downwards, it changes.
    const FlickerSum in_place =
        measure_flicker(error_of(pattern), error_of(moved), uniform_motion(0.0f, 0.0f), same_objects);
    EXPECT_GT(in_place.rest.errors.beyond(), 200u);
    const FlickerSum down =
        measure_flicker(error_of(pattern), error_of(moved), uniform_motion(3.0f, -2.0f), same_objects);
    EXPECT_GT(down.moving.errors.beyond(), 150u);
}

TEST(Flicker, FractionsOfAPixelAreInterpolated) {
    // Bilinear interpolation is exact for a x + b y + c x y + d.
    const auto pattern = [](double x, double y) { return 0.5 * x - 0.25 * y + 0.125 * x * y + 1.0; };
    const auto moved = [&](double x, double y) { return pattern(x - 0.375, y - 0.75); };  // right and down
    const FlickerSum sum =
        measure_flicker(error_of(pattern), error_of(moved), uniform_motion(0.375f, -0.75f), same_objects);
    EXPECT_EQ(sum.moving.errors.count(), static_cast<std::size_t>((width - 1) * (height - 1)));
    EXPECT_LT(sum.moving.errors.worst(), 1e-9);
}

TEST(Flicker, SurfacesWithinTheRestLimitAreComparedInPlace) {
    const LuminanceError error = error_of([](double x, double y) { return std::fmod(7.0 * x + 3.0 * y, 5.0); });
    const FlickerSum slow = measure_flicker(error, error, uniform_motion(0.0099f, 0.0f), same_objects);
    EXPECT_EQ(slow.rest.errors.count(), static_cast<std::size_t>(width * height));
    EXPECT_EQ(slow.rest.errors.worst(), 0.0);
    const FlickerSum faster = measure_flicker(error, error, uniform_motion(0.0f, 0.0101f), same_objects);
    EXPECT_EQ(faster.rest.errors.count(), 0u);
    EXPECT_GT(faster.moving.errors.worst(), 0.0);
}

TEST(Flicker, RoundedMotionBringsInNoNeighbour) {
    // One pixel to the right, off by rounding: the target's neighbours are another object and have no finite error.
    LuminanceError now = constant_error(1.0), next = constant_error(std::numeric_limits<double>::quiet_NaN());
    next.error(5, 4) = 1.5;
    Image<float> objects(width, height, 9.0f);
    objects(5, 4) = 5.0f;
    const FlickerSum sum = measure_flicker(now, next, uniform_motion(1.0000001f, 1e-7f), objects);
    EXPECT_EQ(sum.moving.errors.count(), 1u);
    EXPECT_DOUBLE_EQ(sum.moving.errors.worst(), 0.25);
}

TEST(Flicker, InvalidMotionAndOtherObjectsAreLeftOut) {
    FlickerMaps maps = uniform_motion(0.0f, 0.0f);
    for (int k = 0; k < 5; ++k) maps.valid(k, 0) = -static_cast<float>(k);  // background, behind, leaves, none, hidden
    Image<float> objects = same_objects;
    objects(6, 0) = 8.0f;
    LuminanceError next = constant_error(0.0);
    next.error(7, 0) = std::numeric_limits<double>::infinity();
    maps.v(8, 0) = 3.0f;                                     // leaves upwards
    maps.u(9, 0) = std::numeric_limits<float>::quiet_NaN();  // unknown
    const FlickerSum sum = measure_flicker(constant_error(50.0), next, maps, objects);
    EXPECT_EQ(sum.left_out, 9u);
    EXPECT_EQ(sum.rest.errors.beyond(), static_cast<std::size_t>(width * height) - 9);
    // A target between two objects is left out, too.
    maps = uniform_motion(0.5f, 0.0f);
    const FlickerSum between = measure_flicker(constant_error(0.0), constant_error(0.0), maps, objects);
    EXPECT_EQ(between.moving.errors.count(), static_cast<std::size_t>((width - 1) * height) - 2);
}

TEST(Flicker, NoiseOfBothFramesAdds) {
    LuminanceError now = constant_error(0.0), next = now;
    now.variance = Image<double>(width, height, 0.75);
    next.variance = Image<double>(width, height, 1.0);
    // Half a pixel: the mean of two pixels has half the variance, and the deviation is sqrt(.75 + .5) over 2.
    const FlickerSum sum = measure_flicker(now, next, uniform_motion(0.5f, 0.0f), same_objects);
    EXPECT_NEAR(sum.moving.noise.percentile(0.5), std::sqrt(1.25) / 2.0, 0.003);
}

TEST(Flicker, MapsGiveTheirOwnThresholdOrThatOfLastingErrors) {
    const auto channel = [](const char* name, float value) { return Channel{name, Image<float>(4, 4, value)}; };
    ChannelImage maps{{channel("forward.u", 1.0f), channel("forward.v", 2.0f), channel("motion.valid", 1.0f)}, {}};
    EXPECT_FALSE(make_flicker_maps(maps).has_value());
    maps.channels.push_back(channel("threshold.Y", 7.0f));
    const auto lasting = make_flicker_maps(maps);
    ASSERT_TRUE(lasting.has_value());
    EXPECT_EQ(lasting->threshold(0, 0), 7.0f);
    EXPECT_FALSE(lasting->own_threshold);
    EXPECT_TRUE(lasting->object.empty());
    maps.channels.push_back(channel("threshold.flicker", 3.0f));
    maps.channels.push_back(channel("objectId.X", 6.0f));
    const auto own = make_flicker_maps(maps);
    EXPECT_EQ(own->threshold(0, 0), 3.0f);
    EXPECT_TRUE(own->own_threshold);
    EXPECT_EQ(own->object(0, 0), 6.0f);
    maps.channels.erase(maps.channels.begin());
    EXPECT_FALSE(make_flicker_maps(maps).has_value());
}

TEST(Flicker, OtherSizesAreErrors) {
    const LuminanceError error = constant_error(0.0), small{Image<double>(4, 4), {}, 100.0};
    EXPECT_THROW(measure_flicker(error, small, uniform_motion(0.0f, 0.0f), {}), InputError);
    EXPECT_THROW(measure_flicker(small, small, uniform_motion(0.0f, 0.0f), {}), InputError);
    EXPECT_THROW(measure_flicker(error, error, uniform_motion(0.0f, 0.0f), Image<float>(4, 4)), InputError);
}

}  // namespace
}  // namespace aleph
