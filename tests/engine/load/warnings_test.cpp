// The light that load_scene adds to scenes without one; warnings, also about values that are allowed and probably meant
// otherwise.

#include "engine/load/warnings.h"
#include "engine/pose/pose.h"
#include "tests/engine/load/fixture.h"

namespace aleph {
namespace {

using LoadWarnings = LoadScene;

TEST_F(LoadWarnings, SceneWithoutLightGetsAWhiteEnvironment) {
    const Scene dark = load_scene(
        write_scene(R"("materials": {"unused": {"emission": [1, 1, 1]}}, "lights": {"unused": {"type": "point"}},
        "nodes": [{"shape": {"type": "box"}, "material": {"emission": [1, 0, 0], "emission_strength": 0}}])"));
    EXPECT_EQ(dark.environment.radiance, Track<glm::dvec3>(glm::dvec3(1.0)));
    EXPECT_TRUE(has_warning(dark, "no light"));
    for (
        const char* light :
        {R"("environment": [0, 0, 0.1])", R"("environment": [0, 0, 0])",
         R"("nodes": [{"light": {"type": "directional"}}])",
         R"("nodes": [{"shape": {"type": "quad"}, "material": {"emission": {"keys": [[0, [0, 0, 0]], [9, [0, 1, 0]]]}}}])"}) {
        const Scene lit = load_scene(write_scene(light));
        EXPECT_FALSE(has_warning(lit, "no light")) << light;
        EXPECT_NE(lit.environment.radiance, Track<glm::dvec3>(glm::dvec3(1.0))) << light;
    }
}

TEST_F(LoadWarnings, TransmissionAndBlendingGiveNone) {
    const Scene scene = load_lit(R"("nodes": [
        {"shape": {"type": "quad"}, "material": {"alpha_mode": "blend", "alpha": 0.5}},
        {"shape": {"type": "box"}, "material": {"transmission": 1, "thickness": 1}}])");
    EXPECT_TRUE(scene.source.warnings.empty()) << scene.source.warnings[0];
}

TEST_F(LoadWarnings, RP08_RotationKeysMoreThan170DegreesApartAreSaid) {
    const auto load = [&](const std::string& rotation) {
        return load_lit("\"nodes\": [{\"name\": \"arm\", \"rotation\": " + rotation + "}]");
    };
    const auto keys = [](double degrees, const std::string& more) {
        const double half = 0.5 * degrees * std::acos(-1.0) / 180.0;
        return "{\"keys\": [[0, [0, 0, 0, 1]], [5, [0, 0, 0, 1]], [9, [0, " + std::to_string(std::sin(half)) + ", 0, " +
               std::to_string(std::cos(half)) + "]]]" + more + "}";
    };
    const Scene scene = load(keys(171.0, ""));
    ASSERT_EQ(scene.source.warnings.size(), 1u);
    EXPECT_NE(scene.source.warnings[0].find("\"arm\": neighbouring rotation keys are 171"), std::string::npos)
        << scene.source.warnings[0];
    EXPECT_TRUE(has_warning(load(keys(180.0, "")), "180 degrees"));
    EXPECT_TRUE(has_warning(load(keys(185.0, "")), "185 degrees"));
    EXPECT_TRUE(has_warning(load(keys(270.0, "")), "270 degrees")) << "although the rotation takes the 90 back";
    EXPECT_TRUE(load(keys(169.0, "")).source.warnings.empty());
    EXPECT_TRUE(load(keys(180.0, ", \"interpolation\": \"step\"")).source.warnings.empty());
    EXPECT_TRUE(load(R"({"axis": [0, 1, 0], "degrees": {"keys": [[0, 0], [5, 720]]}})").source.warnings.empty());
}

TEST_F(LoadWarnings, KF04_RotationsThatAreNotUnitAreSaid) {
    const auto load = [&](const std::string& rotation) {
        return load_lit("\"nodes\": [{\"name\": \"arm\", \"rotation\": " + rotation + "}]");
    };
    EXPECT_TRUE(has_warning(load("[0, 0, 0, 2]"), "\"arm\": rotation key 0 has length 2"));
    EXPECT_TRUE(has_warning(load("[0, 1.002, 0, 0]"), "length 1.002"));
    EXPECT_TRUE(load("[0, 0.70711, 0, 0.70711]").source.warnings.empty());
    const Scene tiny = load("[0, 1e-20, 0, 1e-20]");
    EXPECT_NEAR(pose(tiny, 0.0).world[0][0].z, -1.0, 1e-12);  // a quarter turn about y takes x to -z
}

using UnlikelyValues = LoadScene;

TEST_F(UnlikelyValues, FieldsOfViewInRadians) {
    const auto load = [&](const std::string& fov) {
        return load_lit(R"("nodes": [{"name": "eye", "camera": {"fov": )" + fov + "}}]");
    };
    EXPECT_TRUE(has_warning(load("0.7"), "0.7 degrees looks like radians; 0.7 radians are 40.11 degrees"));
    EXPECT_TRUE(has_warning(load(R"({"keys": [[0, 0.7], [9, 1.2]]})"), "radians"));
    EXPECT_TRUE(load("2").source.warnings.empty()) << "a long focal length";
    EXPECT_TRUE(load(R"({"keys": [[0, 1], [9, 40]]})").source.warnings.empty()) << "a zoom";
}

TEST_F(UnlikelyValues, RotationsInRadians) {
    const auto load = [&](const std::string& degrees) {
        return load_lit(R"("nodes": [{"name": "door", "rotation": {"axis": [0, 1, 0], "degrees": )" + degrees + "}}]");
    };
    for (const char* radians : {"-1.5708", "0.7854", "3.14159", R"({"keys": [[0, 0], [9, 6.2832]]})"}) {
        EXPECT_TRUE(has_warning(load(radians), "node \"door\": the degrees of its rotation look like radians"))
            << radians;
    }
    for (const char* degrees : {"0", "1.5", "-3", "45", "1.571", R"({"keys": [[0, 0], [9, 1.5708], [12, 2]]})"}) {
        EXPECT_TRUE(load(degrees).source.warnings.empty()) << degrees;
    }
}

TEST_F(UnlikelyValues, OperationsInRadians) {
    const auto load = [&](const std::string& operations) {
        return load_lit(R"("nodes": [{"name": "arm", "operations": [)" + operations + "]}]");
    };
    const char* axis = R"({"scale": 2}, {"rotate": {"axis": [1, 1, 0], "degrees": 0.7854}}, {"translate": [1, 2, 3]})";
    const char* keyed = R"({"rotate_z": {"keys": [[0, 0], [9, -3.1416]]}})";
    for (const char* radians : {R"({"rotate_y": 1.5708})", R"({"rotate_x": 0}, {"rotate_z": 0.5236})", axis, keyed}) {
        EXPECT_TRUE(has_warning(load(radians), "node \"arm\": the degrees of its rotation look like radians"))
            << radians;
    }
    const char* mixed = R"({"rotate_y": 1.5708}, {"rotate_x": {"keys": [[0, 1.5708], [9, 30]]}})";
    for (const char* degrees : {R"({"rotate_y": 90})", R"({"translate": [1.5708, 0, 0]})", mixed, ""}) {
        EXPECT_TRUE(load(degrees).source.warnings.empty()) << degrees;
    }
}

TEST_F(UnlikelyValues, ConesOfSpotsInRadians) {
    const auto load = [&](const std::string& cone) {
        return load_lit(R"("nodes": [{"name": "spot", "light": {"type": "spot", "outer_cone": )" + cone + "}}]");
    };
    EXPECT_TRUE(has_warning(load("0.7854"), "light of node \"spot\": its \"outer_cone\" looks like radians"));
    EXPECT_TRUE(has_warning(load(R"({"keys": [[0, 0.5236], [9, 1.0472]]})"), "radians"));
    for (const char* degrees : {"45", "0.8", R"({"keys": [[0, 0.7854], [9, 30]]})"})
        EXPECT_TRUE(load(degrees).source.warnings.empty()) << degrees;
}

TEST_F(UnlikelyValues, KeysOutsideTheFrames) {
    const auto load = [&](const std::string& node) {
        return load_lit(R"("frames": [10, 20], "nodes": [{"name": "ball", )" + node + "}]");
    };
    const auto keys = [](const std::string& from, const std::string& to) {
        return "{\"keys\": [[" + from + ", [0, 0, 0]], [" + to + ", [1, 1, 1]]]}";
    };
    const std::string said = "node \"ball\": keys lie outside the frames 10 to 20, so they move nothing";
    for (const auto& [from, to] : {std::pair{"21", "40"}, {"0", "9"}}) {
        EXPECT_TRUE(has_warning(load("\"translation\": " + keys(from, to)), said)) << from;
        EXPECT_TRUE(has_warning(load("\"operations\": [{\"scale\": " + keys(from, to) + "}]"), said)) << from;
    }
    EXPECT_TRUE(has_warning(load(R"("visible": {"keys": [[30, true], [40, false]]})"), said));
    for (const auto& [from, to] : {std::pair{"20", "40"}, {"0", "10"}, {"0", "40"}, {"12", "13"}})
        EXPECT_TRUE(load("\"translation\": " + keys(from, to)).source.warnings.empty()) << from;
    EXPECT_TRUE(load(R"("scale": {"values": [1, 2, 1], "start": 0, "period": 2})").source.warnings.empty());
    EXPECT_TRUE(load(R"("scale": {"keys": [[30, 2], [40, 2]]})").source.warnings.empty()) << "nothing to move";
}

TEST_F(UnlikelyValues, CutsOutsideTheFrames) {
    const auto load = [&](const std::string& cuts) { return load_lit(R"("frames": [5, 20], "cuts": )" + cuts); };
    EXPECT_TRUE(has_warning(load("[7, 50]"), "cut at frame 50 lies outside the frames 5 to 20"));
    EXPECT_TRUE(has_warning(load("[4]"), "cut at frame 4"));
    EXPECT_TRUE(load("[6, 20]").source.warnings.empty());
}

TEST_F(UnlikelyValues, CamerasThatJumpWithoutACut) {
    const auto load = [&](const std::string& cuts, const std::string& interpolation, const std::string& holder) {
        const std::string keys = R"("translation": {"interpolation": ")" + interpolation +
                                 R"(", "keys": [[0, [0, 0, 5]], [8, [0, 0, 5]], [10, [3, 0, 5]], [15, [4, 0, 5]]]})";
        return load_lit(R"("frames": [0, 20], "cuts": )" + cuts + R"(, "nodes": [{"name": "dolly", )" + keys + holder);
    };
    const std::string own = R"(, "camera": {}}])", below = R"(, "children": [{"name": "eye", "camera": {}}]}])";
    EXPECT_TRUE(
        has_warning(load("[]", "step", own), "camera of node \"dolly\": step keys move it at frame 10 and at 1 more"));
    EXPECT_TRUE(has_warning(load("[10]", "step", below), "\"eye\": step keys move it at frame 15, which"));
    EXPECT_TRUE(load("[10, 15]", "step", own).source.warnings.empty());
    EXPECT_TRUE(load("[]", "linear", own).source.warnings.empty());
    EXPECT_TRUE(
        load("[]", "step", R"(, "shape": {"type": "box"}}, {"name": "eye", "camera": {}}])").source.warnings.empty());
}

}  // namespace
}  // namespace aleph
