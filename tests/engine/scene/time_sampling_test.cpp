// Known answers of engine/scene/time_sampling.h.

#include "engine/scene/time_sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/base/errors.h"
#include "tests/support/refusal.h"

namespace aleph {
namespace {

using Kind = TimeSampling::Kind;

TimeSampling acyclic(std::vector<double> times) {
    return {Kind::acyclic, 0.0, 1.0, std::move(times)};
}
TimeSampling uniform(double start, double period) {
    return {Kind::uniform, start, period, {}};
}
TimeSampling cyclic(double period, std::vector<double> times) {
    return {Kind::cyclic, 0.0, period, std::move(times)};
}

void expect_span(const SampleSpan& span, std::size_t floor, std::size_t ceil, double fraction) {
    EXPECT_EQ(span.floor, floor);
    EXPECT_EQ(span.ceil, ceil);
    EXPECT_DOUBLE_EQ(span.fraction, fraction);
}

std::string refusal(const TimeSampling& sampling, std::size_t count) {
    const Refusal found = find_refusal([&] { validate(sampling, count, "a.json", "/nodes/3"); });
    if (!found.message.empty()) {
        EXPECT_EQ(found.file + found.place, "a.json/nodes/3");
    }
    return found.reason;
}

TEST(TimeSampling, TimesOfSamples) {
    EXPECT_DOUBLE_EQ(sample_time(uniform(2.0, 0.25), 6), 3.5);
    EXPECT_DOUBLE_EQ(sample_time(acyclic({0.0, 1.0, 5.0}), 2), 5.0);
    const TimeSampling cycle = cyclic(10.0, {1.0, 4.0});
    EXPECT_DOUBLE_EQ(sample_time(cycle, 1), 4.0);
    EXPECT_DOUBLE_EQ(sample_time(cycle, 2), 11.0);
    EXPECT_DOUBLE_EQ(sample_time(cycle, 7), 34.0);
}

TEST(TimeSampling, FindsTheSamplesAround) {
    expect_span(find_samples(uniform(2.0, 0.5), 5, 2.875), 1, 2, 0.75);
    expect_span(find_samples(acyclic({0.0, 1.0, 5.0}), 3, 2.0), 1, 2, 0.25);
    expect_span(find_samples(acyclic({-3.0, -1.0}), 2, -2.5), 0, 1, 0.25);
    expect_span(find_samples(cyclic(10.0, {1.0, 4.0}), 5, 12.5), 2, 3, 0.5);
    expect_span(find_samples(cyclic(10.0, {1.0, 4.0}), 5, 7.5), 1, 2, 0.5);  // between two cycles
}

TEST(TimeSampling, HoldsOutside) {
    const double infinity = std::numeric_limits<double>::infinity();
    const TimeSampling times = acyclic({1.0, 2.0, 4.0});
    for (const double early : {-infinity, -1e300, -0.0, 0.0, 5e-324, 0.999, std::nan("")})
        expect_span(find_samples(times, 3, early), 0, 0, 0.0);
    for (const double late : {4.0, 4.001, 1e300, infinity}) expect_span(find_samples(times, 3, late), 2, 2, 0.0);
    expect_span(find_samples(times, 1, 3.0), 0, 0, 0.0);
    expect_span(find_samples(times, 2, 3.0), 1, 1, 0.0);  // as many samples as the property has, not as the times
}

TEST(TimeSampling, SnapsToASampleWithinRounding) {
    const TimeSampling times = acyclic({0.0, 2.0, 4.0});
    expect_span(find_samples(times, 3, 2.0), 1, 1, 0.0);
    expect_span(find_samples(times, 3, 2.0 + 1e-9), 1, 1, 0.0);
    expect_span(find_samples(times, 3, 2.0 - 1e-9), 1, 1, 0.0);
    EXPECT_EQ(find_samples(times, 3, 2.0 + 1e-8).ceil, 2u);
    EXPECT_EQ(find_samples(times, 3, 2.0 - 1e-8).floor, 0u);
    // Every frame of an hour at 24000/1001 fps finds its uniform sample, although the two times are computed in a
    // different order.
    const TimeSampling film = uniform(0.0, 1001.0 / 24000.0);
    for (std::size_t frame = 0; frame < 86400; ++frame) {
        const SampleSpan span = find_samples(film, 86400, static_cast<double>(frame) * 1001.0 / 24000.0);
        ASSERT_EQ(span.floor, frame);
        ASSERT_EQ(span.ceil, frame);
    }
}

TEST(TimeSampling, NearestPrefersTheEarlierInATie) {
    const TimeSampling times = acyclic({0.0, 1.0, 3.0});
    EXPECT_EQ(nearest_sample(times, 3, 0.5), 0u);
    EXPECT_EQ(nearest_sample(times, 3, 0.500001), 1u);
    EXPECT_EQ(nearest_sample(times, 3, 1.999999), 1u);
    EXPECT_EQ(nearest_sample(times, 3, 2.000001), 2u);
    EXPECT_EQ(nearest_sample(times, 3, 1.0), 1u);
    EXPECT_EQ(nearest_sample(times, 3, -9.0), 0u);
    EXPECT_EQ(nearest_sample(times, 3, 9.0), 2u);
}

TEST(TimeSampling, AcceptsWhatIsSound) {
    EXPECT_EQ(refusal(uniform(-4.0, 1.0 / 30.0), 1000), "");
    EXPECT_EQ(refusal(acyclic({-1.0, 0.0, 2.0}), 3), "");
    EXPECT_EQ(refusal(acyclic({0.0, 1.0, 2.0}), 2), "");
    EXPECT_EQ(refusal(cyclic(2.0, {0.0, 1.9}), 100), "");
}

TEST(TimeSampling, RefusesWhatIsNot) {
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(refusal(uniform(0.0, 1.0), 0), "it has no keys");
    EXPECT_EQ(refusal(uniform(0.0, 0.0), 2), "its period is 0 s; it must be positive");
    EXPECT_EQ(refusal(uniform(0.0, -1.0), 2), "its period is -1 s; it must be positive");
    EXPECT_EQ(refusal(uniform(0.0, nan), 2), "its period is nan s; it must be positive");
    EXPECT_EQ(refusal(uniform(infinity, 1.0), 2), "its start time is inf; it must be finite");
    EXPECT_EQ(refusal(acyclic({0.0, 1.0}), 3), "3 keys but only 2 times");
    EXPECT_EQ(refusal(cyclic(1.0, {}), 3), "its cycle has no times");
    EXPECT_EQ(refusal(cyclic(1.0, {0.0, 1.0}), 3), "its times span more than the cycle's 1 s");
    EXPECT_EQ(refusal(cyclic(0.0, {0.0}), 3), "its period is 0 s; it must be positive");
    EXPECT_EQ(refusal(cyclic(9.0, {0.0, 3.0, 2.0}), 3), "key 2: its time 2 s lies before the key before it, 3 s");
    EXPECT_EQ(refusal(acyclic({-1e308, 1e308}), 2), "key 1: its time is too large");
    EXPECT_EQ(refusal(uniform(1e20, 1.0), 2), "key 1: its time cannot be told from the key before it");
}

}  // namespace
}  // namespace aleph
