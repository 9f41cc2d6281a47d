// glTF reader: keys and rotations.
#include "engine/pose/pose.h"
#include "tests/engine/gltf/fixture.h"

namespace aleph {
namespace {

using GltfAnimation = GltfFixture;

TEST_F(GltfAnimation, KF12_KF13_LinearAndStepAtKeysBetweenAndOutside) {
    GltfDraft draft = triangle_draft();
    draft.animate(0, "translation", {0.5f, 1.0f, 2.0f}, {0, 0, 0, 4, 0, 0, 4, 8, 0});
    draft.animate(0, "scale", {0.0f, 1.0f}, {1, 1, 1, 3, 3, 3}, "STEP");
    const Scene scene = load(draft);
    const auto& move = scene.nodes[0].transform.translation;
    EXPECT_EQ(evaluate(move, 0.0), glm::dvec3(0, 0, 0));
    EXPECT_EQ(evaluate(move, 0.5), glm::dvec3(0, 0, 0));
    EXPECT_EQ(evaluate(move, 0.625), glm::dvec3(1, 0, 0));
    EXPECT_EQ(evaluate(move, 1.0), glm::dvec3(4, 0, 0));
    EXPECT_EQ(evaluate(move, 1.75), glm::dvec3(4, 6, 0));
    EXPECT_EQ(evaluate(move, 9.0), glm::dvec3(4, 8, 0));
    const auto& size = scene.nodes[0].transform.scale;
    EXPECT_EQ(size.interpolation, Interpolation::step);
    EXPECT_EQ(evaluate(size, 0.999), glm::dvec3(1.0));
    EXPECT_EQ(evaluate(size, 1.0), glm::dvec3(3.0));
    EXPECT_TRUE(scene.source.warnings.empty());
}

/// The floats nearest to frames' times lie behind some of them: the new value is meant for the frame all the same.
TEST_F(GltfAnimation, StepsOnAFrameHoldAtTheFrame) {
    std::vector<float> times, places;
    for (int frame = 0; frame < 300; ++frame) {
        times.push_back(static_cast<float>(frame / 30.0));
        places.insert(places.end(), {static_cast<float>(frame), 0.0f, 0.0f});
    }
    GltfDraft draft = triangle_draft();
    draft.animate(0, "translation", times, places, "STEP");
    const Scene scene = load(draft);
    for (int frame = 0; frame < 300; ++frame) {
        EXPECT_EQ(evaluate(scene.nodes[0].transform.translation, frame / 30.0).x, frame);
        if (frame > 0) {
            EXPECT_EQ(evaluate(scene.nodes[0].transform.translation, (frame - 1e-4) / 30.0).x, frame - 1);
        }
    }
}

/// 90 degrees about (1, 2, 2) / 3, rounded to integers: lengths are off by up to 7e-3, which needs no warning.
TEST_F(GltfAnimation, KF06_QuantisedQuaternionsBecomeUnit) {
    const double h = std::sqrt(0.5);
    const double parts[] = {h / 3.0, 2.0 * h / 3.0, 2.0 * h / 3.0, h};
    const auto check = [&]<class C>(C, double tolerance) {
        GltfDraft draft = triangle_draft();
        draft.animate(0, "rotation", {0.0f, 1.0f}, {0, 0, 0, 1, 0, 0, 0, 1});
        std::vector<C> keys(8);
        for (std::size_t k = 0; k < 8; ++k) {
            keys[k] = static_cast<C>(std::lround(parts[k % 4] * std::numeric_limits<C>::max()));
        }
        draft.json["animations"][0]["samplers"][0]["output"] = draft.add_accessor<C>(keys, "VEC4", 4, true);
        const Scene scene = load(draft);
        const glm::dquat q = scene.nodes[0].transform.rotation.values[0];
        EXPECT_NEAR(glm::length(q), 1.0, 1e-15);
        EXPECT_NEAR(q.x, parts[0], tolerance);
        EXPECT_NEAR(q.w, parts[3], tolerance);
        EXPECT_TRUE(scene.source.warnings.empty()) << scene.source.warnings[0];
    };
    check(std::int16_t{}, 3e-5);
    check(std::int8_t{}, 8e-3);
    GltfDraft lowest = triangle_draft();
    lowest.animate(0, "rotation", {0.0f, 1.0f}, {0, 0, 0, 1, 0, 0, 0, 1});
    lowest.json["animations"][0]["samplers"][0]["output"] =
        lowest.add_accessor<std::int16_t>({0, 0, 0, 32767, -32768, 0, 0, 0}, "VEC4", 4, true);
    EXPECT_EQ(load(lowest).nodes[0].transform.rotation.values[1], glm::dquat(0, -1, 0, 0));  // counts as -1
}

TEST_F(GltfAnimation, KF09_CubicWithOneKeyIsItsMiddleValue) {
    GltfDraft draft = triangle_draft();
    draft.animate(0, "scale", {1.0f}, {7, 7, 7, 2, 3, 4, 9, 9, 9}, "CUBICSPLINE");
    const Scene scene = load(draft);
    for (const double t : {0.0, 1.0, 2.0}) EXPECT_EQ(evaluate(scene.nodes[0].transform.scale, t), glm::dvec3(2, 3, 4));
}

/// A key of length 2 becomes unit, and its tangents half as long, so that the curve is the same turned to unit length.
TEST_F(GltfAnimation, CubicRotationTangentsFollowTheirKey) {
    GltfDraft draft = triangle_draft();
    draft.animate(0, "rotation", {0.0f, 1.0f}, {0, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0},
                  "CUBICSPLINE");
    const auto values = load(draft).nodes[0].transform.rotation.values;
    EXPECT_EQ(values[1], glm::dquat(1, 0, 0, 0));
    EXPECT_EQ(values[2], glm::dquat(0, 0, 0.5, 0));
    EXPECT_EQ(values[4], glm::dquat(0, 0, 1, 0));
}

TEST_F(GltfAnimation, FloatsBecomeDoublesExactly) {
    GltfDraft draft = triangle_draft();
    const float time = 0.1f, value = 1e-20f / 3.0f;
    draft.animate(0, "translation", {0.0f, time}, {0, 0, 0, value, -value, 16777217.0f});
    const Scene scene = load(draft);
    EXPECT_EQ(scene.nodes[0].transform.translation.sampling.times.back(), static_cast<double>(time));
    EXPECT_EQ(scene.nodes[0].transform.translation.values[1], glm::dvec3(value, -value, 16777216.0));
}

TEST_F(GltfAnimation, S12_11_ChannelWithoutNodeIsIgnoredWithAWarning) {
    GltfDraft draft = triangle_draft();
    draft.animate(0, "translation", {0.0f, 1.0f}, {0, 0, 0, 1, 0, 0});
    Json channel = {{"sampler", 0}, {"target", {{"path", "translation"}}}};
    draft.json["animations"][0]["channels"].insert(draft.json["animations"][0]["channels"].begin(), channel);
    const Scene scene = load(draft);
    EXPECT_TRUE(has_warning(scene, "1 channels animate no node"));
    EXPECT_EQ(scene.nodes[0].transform.translation.key_count(), 2u);
}

TEST_F(GltfAnimation, KF04_QuaternionsOfAnyLengthBecomeUnitWithAWarning) {
    for (const double length : {0.5, 2.0, 1e-20, 1e17}) {
        GltfDraft draft = triangle_draft();
        draft.json["nodes"][0]["rotation"] = {0.6 * length, 0, 0, 0.8 * length};
        const Scene scene = load(draft);
        const glm::dquat q = scene.nodes[0].transform.rotation.values[0];
        EXPECT_NEAR(q.x, 0.6, 1e-15);
        EXPECT_NEAR(q.w, 0.8, 1e-15);
        const std::string said = fmt::format("the rotation quaternion has length {:.6g} and is normalized", length);
        EXPECT_TRUE(has_warning(scene, said)) << length;
    }
    GltfDraft draft = triangle_draft();
    draft.json["nodes"][0]["rotation"] = {0.6f, 0.0f, 0.0f, 0.8f};  // off by float rounding only
    EXPECT_TRUE(load(draft).source.warnings.empty());
}

TEST_F(GltfAnimation, KF04_KeysOfAnyLengthGiveOneWarningPerChannel) {
    GltfDraft draft = triangle_draft();
    draft.animate(0, "rotation", {0, 1, 2}, {0, 0, 0, 1, 0, 0, 3e-10f, 4e-10f, 6e17f, 0, 0, 8e17f});
    const Scene scene = load(draft);
    EXPECT_NEAR(scene.nodes[0].transform.rotation.values[1].z, 0.6, 1e-7);
    EXPECT_NEAR(scene.nodes[0].transform.rotation.values[2].x, 0.6, 1e-7);
    EXPECT_TRUE(has_warning(scene, "node 0 \"node0\": 2 rotation keys are not of length 1"));
    EXPECT_EQ(scene.source.warnings.size(), 1u);
}

TEST_F(GltfAnimation, RP08_KeysFarApartAreWarnedOf) {
    const auto about_y = [](double degrees) {
        const double half = degrees / 360.0 * std::numbers::pi;
        return std::vector<float>{
            0, 0, 0, 1, 0, static_cast<float>(std::sin(half)), 0, static_cast<float>(std::cos(half))};
    };
    GltfDraft draft = triangle_draft();
    draft.json["nodes"][0]["name"] = "fan";
    GltfDraft far = draft, near = draft, stepped = draft;
    far.animate(0, "rotation", {0.0f, 1.0f}, about_y(175.0));
    near.animate(0, "rotation", {0.0f, 1.0f}, about_y(169.0));
    stepped.animate(0, "rotation", {0.0f, 1.0f}, about_y(175.0), "STEP");
    EXPECT_TRUE(has_warning(load(far), "node 0 \"fan\": rotation keys 0 and 1 are 175.0 degrees apart"));
    EXPECT_TRUE(load(near).source.warnings.empty());
    EXPECT_TRUE(load(stepped).source.warnings.empty());
}

}  // namespace
}  // namespace aleph
