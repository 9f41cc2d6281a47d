// Known answers of engine/scene/track.h.

#include "engine/scene/track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/base/errors.h"
#include "tests/support/keyed_track.h"
#include "tests/support/numbers.h"
#include "tests/support/refusal.h"

namespace aleph {
namespace {

glm::dquat turn(double degrees, const glm::dvec3& axis) {
    return glm::angleAxis(degrees * pi / 180.0, axis);
}

double largest_difference(const glm::dmat4& a, const glm::dmat4& b) {
    double largest = 0.0;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) largest = std::max(largest, std::abs(a[c][r] - b[c][r]));
    return largest;
}

TEST(Track, AConstantHoldsForEver) {
    const Track<glm::dvec3> track = glm::dvec3(1.0, 2.0, 3.0);
    for (const double t : {-1e9, 0.0, 0.3, 1e9}) EXPECT_EQ(evaluate(track, t), glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_FALSE(is_animated(track));
    EXPECT_EQ(first_time(track), 0.0);
    EXPECT_EQ(last_time(track), 0.0);
}

TEST(Track, Linear) {
    const Track<double> track = keyed<double>({0.0, 2.0, 3.0}, {10.0, 20.0, -20.0});
    EXPECT_DOUBLE_EQ(evaluate(track, 0.5), 12.5);
    EXPECT_DOUBLE_EQ(evaluate(track, 2.5), 0.0);
    EXPECT_EQ(evaluate(track, -1.0), 10.0);
    EXPECT_EQ(evaluate(track, 4.0), -20.0);
    EXPECT_EQ(last_time(track), 3.0);
}

TEST(Track, StepTakesTheKeyAtOrBefore) {
    const Track<double> track = keyed<double>({1.0, 2.0, 3.0}, {5.0, 6.0, 7.0}, Interpolation::step);
    EXPECT_EQ(evaluate(track, 0.0), 5.0);
    EXPECT_EQ(evaluate(track, 1.999), 5.0);
    EXPECT_EQ(evaluate(track, 2.0), 6.0);
    EXPECT_EQ(evaluate(track, 2.999), 6.0);
    EXPECT_EQ(evaluate(track, 9.0), 7.0);
}

TEST(Track, CubicMatchesThePolynomialItsKeysWereTakenFrom) {
    // The Hermite spline of a cubic polynomial is that polynomial, for any intervals.
    const auto value = [](double t) { return 2.0 - t + 0.5 * t * t - 0.25 * t * t * t; };
    const auto slope = [](double t) { return -1.0 + t - 0.75 * t * t; };
    std::vector<double> times{-1.0, 0.0, 2.5, 3.0}, values;
    for (const double t : times) values.insert(values.end(), {slope(t), value(t), slope(t)});
    const Track<double> track = keyed(times, values, Interpolation::cubic);
    EXPECT_EQ(track.key_count(), 4u);
    for (double t = -1.0; t <= 3.0; t += 0.0625) EXPECT_NEAR(evaluate(track, t), value(t), 1e-13) << t;
}

TEST(Track, QuaternionsTurnAtConstantSpeedTheShortWay) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(1.0, -2.0, 0.5));
    const Track<glm::dquat> track = keyed<glm::dquat>({0.0, 4.0}, {turn(10.0, axis), -turn(130.0, axis)});
    for (double t = 0.25; t < 4.0; t += 0.25) {
        const glm::dquat expected = turn(10.0 + 30.0 * t, axis);
        EXPECT_NEAR(std::abs(glm::dot(evaluate(track, t), expected)), 1.0, 1e-15);
        EXPECT_LT(glm::length(evaluate(track, t) - expected), 1e-14);
    }
}

TEST(Track, MatricesTurnAndStretchApart) {
    const glm::dvec3 y(0.0, 1.0, 0.0);
    const auto make = [&](double degrees, double stretch, double x) {
        glm::dmat4 m = glm::mat4_cast(turn(degrees, y)) * glm::scale(glm::dmat4(1.0), glm::dvec3(stretch, 1.0, 1.0));
        m[3].x = x;
        return m;
    };
    const Track<glm::dmat4> track = keyed<glm::dmat4>({0.0, 1.0}, {make(-60.0, 1.0, 5.0), make(100.0, 3.0, 9.0)});
    for (const double t : {0.125, 0.5, 0.75})
        EXPECT_LT(largest_difference(evaluate(track, t), make(-60.0 + 160.0 * t, 1.0 + 2.0 * t, 5.0 + 4.0 * t)), 1e-14);
}

TEST(Track, EqualMatricesOnlyMove) {
    glm::dmat4 a(0.1, 0.7, -0.3, 0.0, 1.3, 0.2, 0.9, 0.0, 0.4, 0.4, -2.0, 0.0, 1.0, 2.0, 3.0, 1.0), b = a;
    b[3] = {3.0, 2.0, 1.0, 1.0};
    const glm::dmat4 middle = interpolate_matrix(a, b, 0.5);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(middle[c], a[c]);
    EXPECT_EQ(middle[3], glm::dvec4(2.0, 2.0, 2.0, 1.0));
}

TEST(Track, IsAnimatedOnlyWhereAValueCanDiffer) {
    EXPECT_FALSE(is_animated(keyed<double>({0.0, 1.0, 2.0}, {4.0, 4.0, 4.0})));
    EXPECT_TRUE(is_animated(keyed<double>({0.0, 1.0, 2.0}, {4.0, 4.0, std::nextafter(4.0, 5.0)})));
    const auto cubic = [](std::vector<double> values) {
        return is_animated(keyed({0.0, 1.0}, std::move(values), Interpolation::cubic));
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
    EXPECT_EQ(refusal(keyed<double>({0.0, 1.0}, Values{0.0, 1.0})), "");
    EXPECT_EQ(refusal(keyed<double>({0.0, 1.0}, Values{0.0, std::nan("")})), "key 1: it holds nan");
    EXPECT_EQ(refusal(keyed({0.0, 1.0}, Values(5, 1.0), Interpolation::cubic)),
              "5 values: a cubic key has three (in-tangent, value, out-tangent)");
    EXPECT_EQ(refusal(keyed({0.0, 1.0}, Values{0.0, 1.0, 0.0, 0.0, 1.0, INFINITY}, Interpolation::cubic)),
              "key 1: it holds inf");
    EXPECT_EQ(refusal(keyed({0.0, 1.0}, std::vector<glm::dquat>{{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}})),
              "key 1: its rotation is zero");
    glm::dmat4 projective(1.0);
    projective[0].w = 0.5;
    EXPECT_EQ(refusal(Track<glm::dmat4>(projective)), "key 0: its matrix is not affine: the last row must be 0 0 0 1");
    EXPECT_EQ(refusal(keyed<double>({std::nan("")}, Values{0.0})), "key 0: its time is nan; it must be finite");
}

TEST(Track, RP08_TurnsOver170DegreesCanBeFound) {
    const glm::dvec3 z(0.0, 0.0, 1.0);
    const auto largest = [&](std::vector<glm::dquat> keys) {
        std::vector<double> times;
        for (std::size_t i = 0; i < keys.size(); ++i) times.push_back(static_cast<double>(i));
        return largest_turn_degrees(keyed(times, std::move(keys)));
    };
    EXPECT_NEAR(largest({turn(0.0, z), turn(90.0, z), turn(265.0, z)}), 175.0, 1e-9);
    EXPECT_NEAR(largest({turn(0.0, z), turn(270.0, z)}), 270.0, 1e-9);  // slerp takes the other 90
    EXPECT_NEAR(largest({turn(0.0, z), -turn(5.0, z)}), 5.0, 1e-9);     // an exporter's sign
    EXPECT_NEAR(largest({turn(0.0, z), turn(180.0, z)}), 180.0, 1e-9);
    EXPECT_EQ(largest({turn(30.0, z), turn(30.0, z)}), 0.0);
    EXPECT_EQ(largest({turn(30.0, z)}), 0.0);
}

}  // namespace
}  // namespace aleph
