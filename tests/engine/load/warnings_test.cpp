// The light that load_scene adds to scenes without one, and its warnings.

#include "engine/load/warnings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/pose/pose.h"
#include "tests/engine/load/fixture.h"

namespace aleph {
namespace {

using LoadWarnings = LoadScene;

TEST_F(LoadWarnings, SceneWithoutLightGetsAWhiteEnvironment) {
    const Scene dark = load_scene(
        write_scene(R"("materials": {"unused": {"emission": [1, 1, 1]}}, "lights": {"unused": {"type": "point"}},
        "nodes": [{"shape": {"type": "box"}, "material": {"emission": [1, 0, 0], "emission_strength": 0}}])"));
    EXPECT_EQ(dark.environment, Track<glm::dvec3>(glm::dvec3(1.0)));
    EXPECT_TRUE(has_warning(dark, "no light"));
    for (
        const char* light :
        {R"("environment": [0, 0, 0.1])", R"("environment": [0, 0, 0])",
         R"("nodes": [{"light": {"type": "directional"}}])",
         R"("nodes": [{"shape": {"type": "quad"}, "material": {"emission": {"keys": [[0, [0, 0, 0]], [9, [0, 1, 0]]]}}}])"}) {
        const Scene lit = load_scene(write_scene(light));
        EXPECT_FALSE(has_warning(lit, "no light")) << light;
        EXPECT_NE(lit.environment, Track<glm::dvec3>(glm::dvec3(1.0))) << light;
    }
}

TEST_F(LoadWarnings, TransmissionAndBlendingGiveNone) {
    const Scene scene = load_scene(write_scene(R"("environment": [1, 1, 1], "nodes": [
        {"shape": {"type": "quad"}, "material": {"alpha_mode": "blend", "alpha": 0.5}},
        {"shape": {"type": "box"}, "material": {"transmission": 1, "thickness": 1}}])"));
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
}

TEST_F(LoadWarnings, RP08_RotationKeysMoreThan170DegreesApartAreSaid) {
    const auto load = [&](const std::string& rotation) {
        return load_scene(write_scene(
            "\"environment\": [1, 1, 1], \"nodes\": [{\"name\": \"arm\", \"rotation\": " + rotation + "}]"));
    };
    const auto keys = [](double degrees, const std::string& more) {
        const double half = 0.5 * degrees * std::acos(-1.0) / 180.0;
        return "{\"keys\": [[0, [0, 0, 0, 1]], [5, [0, 0, 0, 1]], [9, [0, " + std::to_string(std::sin(half)) + ", 0, " +
               std::to_string(std::cos(half)) + "]]]" + more + "}";
    };
    const Scene scene = load(keys(171.0, ""));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("\"arm\": neighbouring rotation keys are 171"), std::string::npos)
        << scene.warnings[0];
    EXPECT_TRUE(has_warning(load(keys(180.0, "")), "180 degrees"));
    EXPECT_TRUE(has_warning(load(keys(185.0, "")), "185 degrees"));
    EXPECT_TRUE(has_warning(load(keys(270.0, "")), "270 degrees")) << "although the rotation takes the 90 back";
    EXPECT_TRUE(load(keys(169.0, "")).warnings.empty());
    EXPECT_TRUE(load(keys(180.0, ", \"interpolation\": \"step\"")).warnings.empty());
    EXPECT_TRUE(load(R"({"axis": [0, 1, 0], "degrees": {"keys": [[0, 0], [5, 720]]}})").warnings.empty());
}

TEST_F(LoadWarnings, KF04_RotationsThatAreNotUnitAreSaid) {
    const auto load = [&](const std::string& rotation) {
        return load_scene(write_scene(
            "\"environment\": [1, 1, 1], \"nodes\": [{\"name\": \"arm\", \"rotation\": " + rotation + "}]"));
    };
    EXPECT_TRUE(has_warning(load("[0, 0, 0, 2]"), "\"arm\": rotation key 0 has length 2"));
    EXPECT_TRUE(has_warning(load("[0, 1.002, 0, 0]"), "length 1.002"));
    EXPECT_TRUE(load("[0, 0.70711, 0, 0.70711]").warnings.empty());
    const Scene tiny = load("[0, 1e-20, 0, 1e-20]");
    EXPECT_NEAR(pose(tiny, 0.0).world[0][0].z, -1.0, 1e-12);  // a quarter turn about y takes x to -z
}
}  // namespace
}  // namespace aleph
