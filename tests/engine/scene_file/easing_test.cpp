// Easing words of "interpolation": their values, and that no component leaves the interval between two keys.

#include "engine/scene/transforms.h"
#include "tests/engine/scene_file/scene_texts.h"

namespace aleph {
namespace {

/// A track of numbers in seconds.
Track<double> eased(const std::string& word, const std::string& keys) {
    const Scene scene = read(R"(, "cameras": {"c": {"focus": {"unit": "seconds", "interpolation": ")" + word +
                             R"(", "keys": )" + keys + "}}}");
    return scene.cameras.at(0).focus_distance;
}

TEST(Easing, WordsHaveTheirCurves) {
    const std::map<std::string, std::function<double(double)>> curves{
        {"ease", [](double u) { return u * u * (3.0 - 2.0 * u); }},
        {"smooth", [](double u) { return u * u * (3.0 - 2.0 * u); }},
        {"ease_in", [](double u) { return u * u; }},
        {"ease_out", [](double u) { return u * (2.0 - u); }},
    };
    for (const auto& [word, curve] : curves) {
        const Track<double> track = eased(word, "[[1, 2], [3, 10]]");
        EXPECT_EQ(track.interpolation, Interpolation::cubic);
        for (const double u : {0.0, 0.125, 0.25, 0.5, 0.8, 1.0})
            EXPECT_NEAR(evaluate(track, 1.0 + 2.0 * u), 2.0 + 8.0 * curve(u), 1e-14) << word << " at " << u;
    }
}

TEST(Easing, EaseRestsAtEveryKey) {
    const Track<double> track = eased("ease", "[[0, 1], [1, 5], [4, 6]]");
    EXPECT_EQ(track.values, (std::vector<double>{0, 1, 0, 0, 5, 0, 0, 6, 0}));
    const Track<double> in = eased("ease_in", "[[0, 1], [2, 5], [4, 6]]");
    EXPECT_EQ(in.values, (std::vector<double>{0, 1, 0, 4, 5, 0, 1, 6, 0}));
    const Track<double> out = eased("ease_out", "[[0, 1], [2, 5], [4, 6]]");
    EXPECT_EQ(out.values, (std::vector<double>{0, 1, 4, 0, 5, 1, 0, 6, 0}));
}

TEST(Easing, SmoothPassesInnerKeysAtTheSlopeOfAParabola) {
    // t^2 + t at times that are not regular; its slope at 2 is 5.
    const Track<double> track = eased("smooth", "[[0, 1], [1.5, 3.75], [2, 6], [3, 12], [4, 20]]");
    EXPECT_NEAR(track.values[3 * 2], 5.0, 1e-14);
    EXPECT_NEAR(track.values[3 * 3], 7.0, 1e-14);
    EXPECT_EQ(track.values[3 * 2], track.values[3 * 2 + 2]);
    EXPECT_EQ(track.values.front(), 0.0);
    EXPECT_EQ(track.values.back(), 0.0);
}

TEST(Easing, SmoothNeverOvershoots) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> value(-1.0, 1.0), gap(0.01, 3.0);
    for (int round = 0; round < 50; ++round) {
        std::string keys = "[";
        double time = 0.0;
        for (int key = 0; key < 12; ++key) {
            const double raised = 2.0 + value(random) * (key % 3 == 0 ? 0.01 : 1.0);
            keys += fmt::format("{}[{}, {}]", key == 0 ? "" : ", ", time += gap(random), key == 5 ? 2.0 : raised);
        }
        const Track<double> track = eased("smooth", keys + "]");
        for (std::size_t key = 0; key + 1 < track.key_count(); ++key) {
            const double from = track.sampling.times[key], to = track.sampling.times[key + 1];
            const auto [low, high] = std::minmax(key_value(track, key), key_value(track, key + 1));
            double before = key_value(track, key);
            const double way = key_value(track, key + 1) - before;
            for (int part = 1; part < 64; ++part) {
                const double now = evaluate(track, from + (to - from) * part / 64.0);
                ASSERT_GE(now, low - 1e-15);
                ASSERT_LE(now, high + 1e-15);
                ASSERT_GE((now - before) * (way < 0.0 ? -1.0 : 1.0), -1e-15);  // monotone
                before = now;
            }
        }
    }
}

TEST(Easing, HeldValuesStayExactlyTheSame) {
    const Track<double> track = eased("smooth", "[[0, 1], [1, 0.3], [2, 0.3], [3, 1]]");
    for (const double t : {1.0, 1.1, 1.5, 1.9, 2.0}) EXPECT_EQ(evaluate(track, t), 0.3);
}

TEST(Easing, VectorsScalesAnglesAndRegularValues) {
    const Scene scene =
        read_node(R"("translation": {"interpolation": "ease", "keys": [[0, [0, 0, 0]], [30, [2, 4, -6]]]},
        "scale": {"interpolation": "ease_in", "values": [1, [2, 3, 1]], "period": 30},
        "rotation": {"axis": [0, 1, 0], "degrees": {"interpolation": "ease", "keys": [[0, 0], [60, 720]]}})");
    const LocalTransform& local = scene.nodes[0].transform;
    expect_near(evaluate(local.translation, 0.25), glm::dvec3(2.0, 4.0, -6.0) * 0.15625, 1e-14);
    expect_near(evaluate(local.scale, 0.5), glm::dvec3(1.25, 1.5, 1.0), 1e-14);
    EXPECT_NEAR(evaluate(local.axis_rotation->angle, 1.0), 2.0 * std::numbers::pi, 1e-14);
    EXPECT_TRUE(again(scene) == scene);
}

TEST(Easing, QuaternionsTakeTheShortWayAndReachTheirKeys) {
    for (const char* word : {"smooth", "ease", "ease_in", "ease_out"}) {
        const Scene scene = read_node(std::string(R"("rotation": {"interpolation": ")") + word + R"(", "keys": [
            [0, [0, 0, 0, 2]], [10, [0, -0.6, 0, -0.8]], [20, [0, 0.8, 0, 0.6]], [30, [0, -1, 0, 0]]]})");
        const Track<glm::dquat>& track = scene.nodes[0].transform.rotation;
        const std::array keys{0.0, 2.0 * std::asin(0.6), 2.0 * std::asin(0.8), std::numbers::pi};
        double before = 0.0;
        for (int i = 0; i <= 120; ++i) {
            const glm::dquat q = evaluate(track, i / 120.0);
            EXPECT_NEAR(glm::length(q), 1.0, 1e-15);
            EXPECT_EQ(q.x, 0.0);
            EXPECT_EQ(q.z, 0.0);
            const double angle = 2.0 * std::atan2(q.y, q.w);
            EXPECT_GE(angle, before - 1e-14) << word << " at " << i;  // turns one way
            if (i % 40 == 0) {
                EXPECT_NEAR(angle, keys[i / 40], 1e-14) << word;
            }
            before = angle;
        }
    }
}

TEST(Easing, SingleKeysStayConstants) {
    const Track<double> track = eased("smooth", "[[3, 7]]");
    EXPECT_EQ(track.values, std::vector<double>{7.0});
    EXPECT_EQ(track.interpolation, Interpolation::linear);
    const Scene scene = read_node(R"("translation": {"interpolation": "ease", "keys": [[0, [1, 2, 3]]]})");
    EXPECT_TRUE(again(scene) == scene);
}

TEST(Easing, Refused) {
    expect_all_refused({
        node(R"("translation": {"interpolation": "eas", "keys": [[0, [0, 0, 0]]]})", "/translation/interpolation",
             "\"smooth\", \"ease\""),
        node(R"("scale": {"interpolation": "smooth", "keys": [[0, 0, 1, 0], [1, 0, 2, 0]]})", "/scale/keys/0",
             "a key is [time, value]"),
        node(R"("scale": {"interpolation": "ease", "unit": "seconds", "keys": [[0, 1], [0, 2]]})", "/scale/keys/1/0",
             "ascend"),
        node(R"("rotation": {"interpolation": "smooth", "keys": [[0, [0, 0, 0, 0]], [1, [0, 0, 0, 1]]]})", "/rotation",
             "key 0: its rotation is zero"),
        node(R"("translation": {"interpolation": "ease_in", "unit": "seconds",
             "keys": [[0, [0, 0, 0]], [1e-310, [1, 0, 0]]]})",
             "/translation", "key 1: its tangent inf"),
        node(R"("matrix": {"interpolation": "smooth", "keys": [[0, [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]]]})",
             "/matrix/interpolation", "\"step\", \"linear\" or \"nearest\""),
        node(R"("visible": {"interpolation": "ease", "keys": [[0, true]]})", "/visible/interpolation", "\"nearest\""),
        node(R"("operations": [{"rotate_y": {"interpolation": "ease", "keys": [[0, 0], [9, 90]]}}])",
             "/operations/0/rotate_y", "linear between their keys"),
        node(R"("easing": "smooth")", "/easing", "\"interpolation\": \"ease\""),
    });
}

}  // namespace
}  // namespace aleph
