// Advice of messages about keys and values that other programs have.

#include <gtest/gtest.h>

#include "engine/base/errors.h"
#include "tests/engine/scene_file/short_text.h"
#include "tests/support/refusal.h"

namespace aleph {
namespace {

std::string refusal(const std::string& body) {
    const Refusal found = find_refusal([&] { read(", " + body); });
    EXPECT_NE(found.message, "") << body << " was read";
    return found.reason;
}

std::string node_refusal(const std::string& node) {
    return refusal("\"nodes\": [{" + node + "}]");
}

void expect_advice(const std::string& reason, const std::string& advice) {
    EXPECT_TRUE(reason.ends_with("; " + advice)) << reason;
}

TEST(Advice, KeysOfOtherPrograms) {
    expect_advice(node_refusal(R"("rotation": {"axis": [0, 1, 0], "angle": 90})"),
                  R"(the angle of a rotation is "degrees", that of a camera "fov", that of a spot "outer_cone")");
    expect_advice(node_refusal(R"("light": {"type": "point", "power": 60})"),
                  R"(the strength of a light is "intensity")");
    expect_advice(node_refusal(R"("shape": {"type": "mesh", "file": "x.obj"})"),
                  R"(meshes of other files are shown by "include": "FILE.glb")");
    const std::string samples = refusal(R"("settings": {"samples": 64})");
    expect_advice(samples, R"(the samples of a pixel are "spp")");
    EXPECT_EQ(samples.find("light_samples"), std::string::npos) << "one advice is enough: " << samples;
}

TEST(Advice, ValuesOfAnotherKind) {
    expect_advice(node_refusal(R"("shape": "sphere")"), R"(write {"type": "sphere"})");
    expect_advice(node_refusal(R"("shape": {"type": "sphere", "size": 1})"),
                  R"(a sphere, cylinder or torus has a "radius", a quad [x, y], a box [x, y, z])");
    expect_advice(node_refusal(R"("translation": [[0, [0, 0, 0]], [10, [1, 0, 0]]])"),
                  R"(keys are written as {"keys": [[0, ...], [10, ...]]})");
    expect_advice(refusal(R"("environment": "sky.exr")"), R"(a picture is "environment_image")");
    EXPECT_EQ(node_refusal(R"("translation": [0, 1])").find(';'), std::string::npos) << "a number is missing";
}

}  // namespace
}  // namespace aleph
