// Known answers of engine/scene/track.h and time_sampling.h.

#include "engine/scene/track.h"
#include "engine/scene/time_sampling.h"
#include "tests/engine/scene/matrices.h"

namespace aleph {
namespace {

glm::dquat turn(double degrees, const glm::dvec3& axis) {
    return glm::angleAxis(degrees * pi / 180.0, axis);
}

TEST(Track, AConstantHoldsForEver) {
    const Track<glm::dvec3> track = glm::dvec3(1.0, 2.0, 3.0);
    for (const double t : {-1e9, 0.0, 0.3, 1e9}) EXPECT_EQ(evaluate(track, t), glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_FALSE(is_animated(track));
}

TEST(Track, MatricesTurnAndStretchApart) {
    const glm::dvec3 y(0.0, 1.0, 0.0);
    const auto make = [&](double degrees, double stretch, double x) {
        glm::dmat4 m = glm::mat4_cast(turn(degrees, y)) * glm::scale(glm::dmat4(1.0), glm::dvec3(stretch, 1.0, 1.0));
        m[3].x = x;
        return m;
    };
    const Track<glm::dmat4> track = Track<glm::dmat4>({0.0, 1.0}, {make(-60.0, 1.0, 5.0), make(100.0, 3.0, 9.0)});
    for (const double t : {0.125, 0.5, 0.75})
        EXPECT_LT(distance(evaluate(track, t), make(-60.0 + 160.0 * t, 1.0 + 2.0 * t, 5.0 + 4.0 * t)), 1e-14);
}

TEST(Track, EqualMatricesOnlyMove) {
    glm::dmat4 a(0.1, 0.7, -0.3, 0.0, 1.3, 0.2, 0.9, 0.0, 0.4, 0.4, -2.0, 0.0, 1.0, 2.0, 3.0, 1.0), b = a;
    b[3] = {3.0, 2.0, 1.0, 1.0};
    const glm::dmat4 middle = interpolate_matrix(a, b, 0.5);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(middle[c], a[c]);
    EXPECT_EQ(middle[3], glm::dvec4(2.0, 2.0, 2.0, 1.0));
}

TEST(Track, IsAnimatedOnlyWhereAValueCanDiffer) {
    EXPECT_FALSE(is_animated(Track<double>({0.0, 1.0, 2.0}, {4.0, 4.0, 4.0})));
    EXPECT_TRUE(is_animated(Track<double>({0.0, 1.0, 2.0}, {4.0, 4.0, std::nextafter(4.0, 5.0)})));
    const auto cubic = [](std::vector<double> values) {
        return is_animated(Track({0.0, 1.0}, std::move(values), Interpolation::cubic));
    };
    EXPECT_FALSE(cubic({0.0, 4.0, 0.0, 0.0, 4.0, 0.0}));
    EXPECT_FALSE(cubic({7.0, 4.0, 0.0, 0.0, 4.0, 7.0}));  // these tangents lie outside
    EXPECT_TRUE(cubic({0.0, 4.0, 1.0, 0.0, 4.0, 0.0}));
    EXPECT_TRUE(cubic({0.0, 4.0, 0.0, 1.0, 4.0, 0.0}));
}

TEST(Track, ValidateNamesTheBadKey) {
    const auto refusal = [](const auto& track) -> std::string {
        const Refusal found = find_refusal([&] { validate(track, "a.gltf", "/animations/0/samplers/1"); });
        if (!found.message.empty()) {
            EXPECT_EQ(found.place, "/animations/0/samplers/1");
        }
        return found.reason;
    };
    using Values = std::vector<double>;
    EXPECT_EQ(refusal(Track<double>(1.0)), "");
    EXPECT_EQ(refusal(Track<double>()), "it has no keys");
    EXPECT_EQ(refusal(Track<double>({0.0, 1.0}, Values{0.0, 1.0})), "");
    EXPECT_EQ(refusal(Track({0.0, 1.0}, Values(5, 1.0), Interpolation::cubic)),
              "5 values: a cubic key has three (in-tangent, value, out-tangent)");
    EXPECT_EQ(refusal(Track({0.0, 1.0}, Values{0.0, 1.0, 0.0, 0.0, 1.0, infinity}, Interpolation::cubic)),
              "key 1: it holds inf");
    glm::dmat4 projective(1.0);
    projective[0].w = 0.5;
    EXPECT_EQ(refusal(Track<glm::dmat4>(projective)), "key 0: its matrix is not affine: the last row must be 0 0 0 1");
    EXPECT_EQ(refusal(Track<double>({not_a_number}, Values{0.0})), "key 0: its time is nan; it must be finite");
}

TEST(Track, RP08_TurnsOver170DegreesCanBeFound) {
    const glm::dvec3 z(0.0, 0.0, 1.0);
    const auto largest = [&](std::vector<glm::dquat> keys) {
        std::vector<double> times;
        for (std::size_t i = 0; i < keys.size(); ++i) times.push_back(static_cast<double>(i));
        return largest_turn_degrees(Track(times, std::move(keys)));
    };
    EXPECT_NEAR(largest({turn(0.0, z), turn(90.0, z), turn(265.0, z)}), 175.0, 1e-9);
    EXPECT_NEAR(largest({turn(0.0, z), turn(270.0, z)}), 270.0, 1e-9);  // slerp takes the other 90
    EXPECT_NEAR(largest({turn(0.0, z), -turn(5.0, z)}), 5.0, 1e-9);     // an exporter's sign
    EXPECT_NEAR(largest({turn(0.0, z), turn(180.0, z)}), 180.0, 1e-9);
    EXPECT_EQ(largest({turn(30.0, z), turn(30.0, z)}), 0.0);
    EXPECT_EQ(largest({turn(30.0, z)}), 0.0);
}

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
    const TimeSampling times = acyclic({1.0, 2.0, 4.0});
    expect_span(find_samples(times, 3, 0.999), 0, 0, 0.0);
    expect_span(find_samples(times, 3, 4.001), 2, 2, 0.0);
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
    // A frame in the middle of two keys at frames, whose times are rounded.
    for (const double rate : {24.0, 25.0, 30.0, 60.0}) {
        for (int frame = 1; frame < 500; ++frame) {
            for (const int away : {1, 2, 5}) {
                const TimeSampling keys = acyclic({(frame - away) / rate, (frame + away) / rate});
                ASSERT_EQ(nearest_sample(keys, 2, frame / rate), 0u) << frame << " +- " << away << ", " << rate;
            }
        }
    }
}

TEST(TimeSampling, RefusesWhatIsNot) {
    EXPECT_EQ(refusal(uniform(0.0, 1.0), 0), "it has no keys");
    EXPECT_EQ(refusal(uniform(0.0, 0.0), 2), "its period is 0 s; it must be positive");
    EXPECT_EQ(refusal(uniform(0.0, -1.0), 2), "its period is -1 s; it must be positive");
    EXPECT_EQ(refusal(uniform(0.0, not_a_number), 2), "its period is nan s; it must be positive");
    EXPECT_EQ(refusal(uniform(infinity, 1.0), 2), "its start time is inf; it must be finite");
    EXPECT_EQ(refusal(cyclic(1.0, {}), 3), "its cycle has no times");
    EXPECT_EQ(refusal(cyclic(1.0, {0.0, 1.0}), 3), "its times span more than the cycle's 1 s");
    EXPECT_EQ(refusal(cyclic(0.0, {0.0}), 3), "its period is 0 s; it must be positive");
    EXPECT_EQ(refusal(cyclic(9.0, {0.0, 3.0, 2.0}), 3), "key 2: its time 2 s lies before the key before it, 3 s");
    EXPECT_EQ(refusal(acyclic({-1e308, 1e308}), 2), "key 1: its time is too large");
    EXPECT_EQ(refusal(uniform(1e20, 1.0), 2), "key 1: its time cannot be told from the key before it");
}

}  // namespace
}  // namespace aleph
