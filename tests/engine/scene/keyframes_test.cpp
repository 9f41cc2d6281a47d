// Hard keys: almost equal, opposite, zero, misordered, far away in time (KF-01 to KF-16).

#include "engine/pose/pose.h"
#include "engine/scene/track.h"
#include "engine/scene/transforms.h"
#include "tests/engine/scene/matrices.h"

namespace aleph {
namespace {

/// The turn about (.48, -.6, .64) in long double, rounded once.
glm::dquat exact_turn(long double angle) {
    const long double s = std::sin(angle / 2), c = std::cos(angle / 2);
    return {static_cast<double>(c), static_cast<double>(.48L * s), static_cast<double>(-.6L * s),
            static_cast<double>(.64L * s)};
}

template <class T>
std::string refusal(const Track<T>& track) {
    return find_refusal([&] { validate(track, "ship.glb", "/animations/2/samplers/5"); }).message;
}

TEST(Keyframes, KF01_SlerpOfAlmostEqualKeys) {
    for (long double angle = 1e-8L; angle < 3.14L; angle *= 1.7L)
        for (const double t : {0.001, 0.25, 0.5, 0.9, 0.999}) {
            const glm::dquat q = slerp_short(exact_turn(0.3L), exact_turn(0.3L + angle), t);
            // Half the angle lies between the quaternions; the keys themselves are rounded.
            EXPECT_LT(2.0 * glm::length(q - exact_turn(0.3L + t * angle)), 1e-15) << static_cast<double>(angle);
        }
    const glm::dquat a = exact_turn(1.0L);
    glm::dquat next = a;
    next.x = std::nextafter(a.x, 1.0);
    for (const double t : {0.0, 0.5, 1.0}) EXPECT_LE(glm::length(slerp_short(a, next, t) - a), 4.0 * double_unit);
}

TEST(Keyframes, KF02_OppositeQuaternionsAreOneRotation) {
    const glm::dquat q = exact_turn(2.0L);
    for (const double t : {0.0, 0.1, 0.5, 0.999, 1.0}) {
        EXPECT_EQ(slerp_short(q, -q, t), q);
        const glm::dquat almost = slerp_short(q, -q * (1.0 + 1e-5), t);
        EXPECT_NEAR(glm::length(almost), 1.0, 4.0 * double_unit);
        EXPECT_LT(glm::length(almost - q), 4.0 * double_unit);
    }
}

TEST(Keyframes, KF03_HalfATurnFollowsItsSign) {
    const glm::dquat identity(1.0, 0.0, 0.0, 0.0);
    const double half = std::sqrt(0.5);
    for (const double w : {-6e-8, 0.0, 6e-8}) {
        const glm::dquat q = slerp_short(identity, {w, 1.0, 0.0, 0.0}, 0.5);
        const double side = w < 0.0 ? -1.0 : 1.0;  // the tie keeps the key's sign
        EXPECT_NEAR(q.w, half, 3e-8);
        EXPECT_NEAR(q.x, side * half, 3e-8);
        EXPECT_EQ(q.y, 0.0);
        EXPECT_EQ(slerp_short(identity, {w, 1.0, 0.0, 0.0}, 0.5), q);
    }
}

TEST(Keyframes, KF04_RotationKeysOfAnyLength) {
    const glm::dquat unit = exact_turn(1.2L), other = exact_turn(-0.4L);
    for (const double length : {0.5, 2.0, 1e-20, 1e20, 1e-300, 1e300}) {
        const auto track = Track<glm::dquat>({0.0, 1.0}, {unit * length, other * length});
        EXPECT_EQ(refusal(track), "");
        for (const double t : {0.0, 0.25, 1.0}) {
            const glm::dquat q = evaluate(track, t);
            EXPECT_LT(glm::length(q - slerp_short(unit, other, t)), 8.0 * double_unit) << length;
            EXPECT_NEAR(glm::determinant(glm::mat3_cast(q)), 1.0, 1e-15);
        }
    }
    EXPECT_EQ(safe_normalize(unit), unit);  // unit within rounding: the same bits
    const double half = std::numbers::sqrt2 / 2.0;
    EXPECT_LT(glm::length(safe_normalize(glm::dquat(0.0, 1.7e308, 1.7e308, 0.0)) - glm::dquat(0.0, half, half, 0.0)),
              1e-15);
}

TEST(Keyframes, KF04_CubicKeysOfAnyLengthKeepTheirShape) {
    const auto curve = [](double length) {
        const glm::dquat a = exact_turn(0.0L), b = exact_turn(1.0L), tangent(0.1, 0.2, -0.3, 0.4);
        std::vector<glm::dquat> values{tangent, a, tangent, tangent, b, tangent};
        for (glm::dquat& value : values) value = value * length;
        return evaluate(Track({0.0, 2.0}, values, Interpolation::cubic), 0.75);
    };
    for (const double length : {0.5, 1e-20, 1e20, 1e-160, 1e160, 1e-300, 1e300})
        EXPECT_LT(glm::length(curve(length) - curve(1.0)), 1e-15);
}

TEST(Keyframes, KF05_ZeroOrNanRotationIsRefusedByIndex) {
    const glm::dquat q(1.0, 0.0, 0.0, 0.0), zero(0.0, 0.0, 0.0, 0.0), nan(not_a_number, 0.0, 0.0, 1.0);
    EXPECT_EQ(refusal(Track<glm::dquat>({0, 1, 2}, {q, q, zero})),
              "ship.glb: /animations/2/samplers/5: key 2: its rotation is zero");
    EXPECT_EQ(refusal(Track<glm::dquat>({0, 1, 2}, {q, nan, q})),
              "ship.glb: /animations/2/samplers/5: key 1: it holds nan");
    EXPECT_EQ(refusal(Track<glm::dquat>({0, 1}, {zero, q, zero, zero, zero, zero}, Interpolation::cubic)),
              "ship.glb: /animations/2/samplers/5: key 1: its rotation is zero");  // tangents may be
}

TEST(Keyframes, KF06_QuantisedRotationsBecomeUnit) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (const double steps : {127.0, 32767.0})
        for (int i = 0; i < 1000; ++i) {
            const glm::dquat q = safe_normalize(glm::dquat(number(random), number(random), number(random), 1.0));
            const auto quantise = [&](double c) { return std::max(std::round(c * steps) / steps, -1.0); };
            const glm::dquat decoded(quantise(q.w), quantise(q.x), quantise(q.y), quantise(q.z));
            const glm::dquat back = evaluate(Track<glm::dquat>(decoded), 0.0);
            ASSERT_NEAR(glm::length(back), 1.0, 4.0 * double_unit);
            ASSERT_LT(glm::length(back - q), 2.0 / steps);
        }
}

TEST(Keyframes, KF07_TangentsCountTimesTheInterval) {
    // The Hermite spline of a cubic polynomial is that polynomial, for any intervals.
    const auto value = [](double t) { return 2.0 - t + 0.5 * t * t - 0.25 * t * t * t; };
    const auto slope = [](double t) { return -1.0 + t - 0.75 * t * t; };
    std::vector<double> times{-1.0, 0.0, 2.5, 3.0}, values;
    for (const double t : times) values.insert(values.end(), {slope(t), value(t), slope(t)});
    const Track<double> track = Track(times, values, Interpolation::cubic);
    EXPECT_EQ(track.key_count(), 4u);
    for (double t = -1.0; t <= 3.0; t += 0.0625) EXPECT_NEAR(evaluate(track, t), value(t), 1e-13) << t;
}

TEST(Keyframes, KF08_CubicRotationThroughZeroHoldsTheNearerKey) {
    const glm::dquat q = exact_turn(1.0L), zero(0.0, 0.0, 0.0, 0.0);
    const auto track = Track<glm::dquat>({0.0, 1.0}, {zero, q, zero, zero, -q, zero}, Interpolation::cubic);
    EXPECT_LT(glm::length(evaluate(track, 0.5 - 1e-8) - q), 4.0 * double_unit);
    EXPECT_LT(glm::length(evaluate(track, 0.5) + q), 4.0 * double_unit);
    // q and -q: it never turns. Beside the middle the curve is as short as 3 / 2400, which magnifies rounding.
    const glm::dmat3 expected = glm::mat3_cast(q);
    const double tolerance = 4.0 * double_unit * 2400.0 / 3.0;
    for (int i = 0; i <= 2400; ++i) {
        const glm::dquat at = evaluate(track, i / 2400.0);
        ASSERT_NEAR(glm::length(at), 1.0, 4.0 * double_unit);
        for (int c = 0; c < 3; ++c) ASSERT_LT(glm::length(glm::mat3_cast(at)[c] - expected[c]), tolerance);
    }
}

TEST(Keyframes, KF09_OneCubicKeyIsItsMiddleValue) {
    const auto track = Track<double>({3.0}, {-7.0, 5.0, 9.0}, Interpolation::cubic);
    for (const double t : {-1.0, 3.0, 1e9}) EXPECT_EQ(evaluate(track, t), 5.0);
    EXPECT_FALSE(is_animated(track));
}

TEST(Keyframes, KF10_DuplicateTimesAreRefused) {
    const auto track = Track<double>({0.0, 1.0, 1.0}, {0.0, 1.0, 2.0});
    EXPECT_EQ(refusal(track),
              "ship.glb: /animations/2/samplers/5: key 2: its time 1 s has the same time as the key before it, 1 s");
    EXPECT_EQ(evaluate(track, 0.5), 0.5);
    EXPECT_EQ(evaluate(track, 1.0), 2.0);  // evaluated all the same: the last one wins
    EXPECT_EQ(evaluate(track, 2.0), 2.0);
}

TEST(Keyframes, KF11_MisorderedAndInfiniteTimesAreRefusedByIndex) {
    const auto reason = [](std::vector<double> times) {
        return refusal(Track<double>(std::move(times), {0.0, 1.0, 2.0}));
    };
    const std::string place = "ship.glb: /animations/2/samplers/5: ";
    EXPECT_EQ(reason({0.0, 2.0, 1.0}), place + "key 2: its time 1 s lies before the key before it, 2 s");
    EXPECT_EQ(reason({0.0, not_a_number, 1.0}), place + "key 1: its time is nan; it must be finite");
    EXPECT_EQ(reason({-infinity, 0.0, 1.0}), place + "key 0: its time is -inf; it must be finite");
    EXPECT_EQ(reason({0.0, 1.0, infinity}), place + "key 2: its time is inf; it must be finite");
    EXPECT_EQ(reason({0.0, 1.0}), place + "3 keys but only 2 times");
    EXPECT_EQ(reason({-2.0, -1.0, 0.0}), "");
}

template <class T>
void expect_bits(const T& a, const T& b) {
    EXPECT_EQ(std::memcmp(&a, &b, sizeof(T)), 0);
}

TEST(Keyframes, KF12_TimesOutsideHoldTheFirstAndLastKey) {
    const glm::dvec3 a(0.1, 0.2, 0.3), b(1.0 / 3.0, -0.7, 1e20);
    const auto linear = Track<glm::dvec3>({0.1, 0.7}, {a, b});
    const auto cubic = Track<glm::dvec3>({0.1, 0.7}, {b, a, b, a, b, a}, Interpolation::cubic);
    for (const auto& track : {linear, cubic}) {
        for (const double t : {-infinity, -1.0, -0.0, 0.0, 5e-324, std::numeric_limits<double>::min()})
            expect_bits(evaluate(track, t), a);
        for (const double t : {1.0, 1e9, std::numeric_limits<double>::max(), infinity})
            expect_bits(evaluate(track, t), b);
        expect_bits(evaluate(track, not_a_number), a);
    }
    const glm::dquat q = exact_turn(1.0L), r = exact_turn(2.0L);
    expect_bits(evaluate(Track<glm::dquat>({0.0, 1.0}, {q, r}), -1.0), q);
    expect_bits(evaluate(Track<glm::dquat>({0.0, 1.0}, {q, r}), 1e9), r);
}

TEST(Keyframes, KF13_OnAKeyTheKeyBitForBit) {
    std::mt19937 random(13);
    std::uniform_real_distribution<double> number(-10.0, 10.0);
    std::vector<double> times;
    std::vector<glm::dvec3> points, cubic_points;
    std::vector<glm::dquat> turns;
    std::vector<glm::dmat4> matrices;
    for (int i = 0; i < 50; ++i) {
        times.push_back(i * 1001.0 / 30000.0);
        points.push_back({number(random), number(random), number(random)});
        for (int k = 0; k < 3; ++k) cubic_points.push_back({number(random), number(random), number(random)});
        turns.push_back(safe_normalize(glm::dquat(number(random), number(random), number(random), number(random))));
        matrices.push_back(glm::mat4_cast(turns.back()) * glm::scale(glm::dmat4(1.0), points.back()));
    }
    for (const Interpolation how : {Interpolation::step, Interpolation::linear})
        for (std::size_t i = 0; i < times.size(); ++i) {
            expect_bits(evaluate(Track(times, points, how), times[i]), points[i]);
            expect_bits(evaluate(Track(times, turns, how), times[i]), turns[i]);
            expect_bits(evaluate(Track(times, matrices, how), times[i]), matrices[i]);
        }
    for (std::size_t i = 0; i < times.size(); ++i)
        expect_bits(evaluate(Track(times, cubic_points, Interpolation::cubic), times[i]), cubic_points[3 * i + 1]);
}

TEST(Keyframes, KF14_LateTimesAreAsExactAsEarlyOnes) {
    for (const double shot : {0.0, 600.0, 3600.0, 36000.0, 1e5}) {
        const auto track = Track<double>({shot, shot + 0.03125}, {0.0, 1.0});
        for (int i = 1; i < 16; ++i) EXPECT_NEAR(evaluate(track, shot + 0.03125 * i / 16.0), i / 16.0, 1e-9) << shot;
    }
}

TEST(Keyframes, KF15_AnHourOfFramesIsAnHour) {
    EXPECT_EQ((FrameRate{30, 1}.seconds_of(108000)), 3600.0);
    EXPECT_EQ((FrameRate{30000, 1001}.seconds_of(108000)), 3603.6);
    EXPECT_EQ((FrameRate{24000, 1001}.seconds_of(24000)), 1001.0);
    EXPECT_EQ((FrameRate{30, 1}.seconds_of(-3)), -0.1);
}

/// For a million frames: the time of a frame is the double nearest to the exact fraction, and keys at frames are met,
/// whether their times are a list or start and period.
TEST(Keyframes, KF16_EveryFrameMeetsItsKey) {
    constexpr std::int64_t frames = 1'000'000;
    for (const FrameRate rate :
         {FrameRate{24000, 1001}, FrameRate{30000, 1001}, FrameRate{60000, 1001}, FrameRate{30, 1}}) {
        TimeSampling uniform, listed;
        uniform.period = rate.seconds_of(1);
        listed.kind = TimeSampling::Kind::acyclic;
        for (std::int64_t frame = 0; frame <= frames; ++frame) {
            // In 64 bits of digits: twice the distance to the exact time is at most the distance to the next double.
            const double seconds = rate.seconds_of(frame);
            const auto exact = static_cast<long double>(frame * rate.denominator) / rate.numerator;
            ASSERT_LE(2.0L * std::abs(seconds - exact), std::nextafter(seconds, infinity) - seconds) << frame;
            listed.times.push_back(seconds);
        }
        for (std::int64_t frame = 0; frame <= frames; ++frame) {
            for (const TimeSampling* sampling : {&uniform, &listed}) {
                const SampleSpan span = find_samples(*sampling, frames + 1, rate.seconds_of(frame));
                ASSERT_EQ(span.floor, static_cast<std::size_t>(frame));
                ASSERT_EQ(span.fraction, 0.0);
            }
        }
    }
}

TEST(Keyframes, EqualKeysPoseToTheSameBitsAtEveryTime) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-3.0, 3.0);
    const std::vector<double> times{-1.0, 0.1, 1.0 / 3.0, 2.7};
    Scene scene;
    for (int i = 0; i < 60; ++i) {
        Node node{.parent = i - 1};
        const glm::dvec3 v(number(random), number(random), number(random)), zero(0.0);
        const glm::dquat q(number(random), number(random), number(random), number(random));
        const glm::dquat none(0.0, 0.0, 0.0, 0.0);
        node.transform.translation = Track(times, std::vector<glm::dvec3>(4, v));
        node.transform.scale = Track<glm::dvec3>(times, {zero, v, zero, zero, v, zero, zero, v, zero, zero, v, zero},
                                                 Interpolation::cubic);
        node.transform.rotation =
            i % 2 ? Track(times, std::vector<glm::dquat>(4, q))
                  : Track<glm::dquat>(times, {none, q, none, none, q, none, none, q, none, none, q, none},
                                      Interpolation::cubic);
        if (i % 5 == 4)
            node.transform.matrix = Track(times, std::vector<glm::dmat4>(4, glm::scale(glm::mat4_cast(q), v)));
        if (i % 5 == 3) node.transform.axis_rotation = AxisRotation{v, Track(times, std::vector<double>(4, v.x))};
        scene.nodes.push_back(node);
    }
    EXPECT_FALSE(is_world_animated(scene));
    const ScenePose first = pose(scene, -1.0);
    for (double t = -1.5; t < 3.0; t += 0.01) {
        const ScenePose frame = pose(scene, t);
        ASSERT_EQ(std::memcmp(frame.world.data(), first.world.data(), first.world.size() * sizeof(glm::dmat4)), 0);
    }
}

TEST(Keyframes, AlmostEqualKeysStayBetweenTheirKeys) {
    const double a = 0.3, b = std::nextafter(std::nextafter(0.3, 1.0), 1.0);
    const auto track = Track<double>({0.0, 1.0}, {a, b});
    double before = a;
    for (int i = 0; i <= 1000; ++i) {
        const double value = evaluate(track, i / 1000.0);
        ASSERT_GE(value, before);
        ASSERT_LE(value, b);
        before = value;
    }
}

}  // namespace
}  // namespace aleph
