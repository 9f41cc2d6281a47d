// Warnings about values that are allowed and probably meant otherwise.

#include <gtest/gtest.h>

#include "tests/engine/load/fixture.h"

namespace aleph {
namespace {

using UnlikelyValues = LoadScene;

TEST_F(UnlikelyValues, FieldsOfViewInRadians) {
    const auto load = [&](const std::string& fov) {
        return load_scene(
            write_scene(R"("environment": [1, 1, 1], "nodes": [{"name": "eye", "camera": {"fov": )" + fov + "}}]"));
    };
    EXPECT_TRUE(has_warning(load("0.7"), "0.7 degrees looks like radians; 0.7 radians are 40.11 degrees"));
    EXPECT_TRUE(has_warning(load(R"({"keys": [[0, 0.7], [9, 1.2]]})"), "radians"));
    EXPECT_TRUE(load("2").warnings.empty()) << "a long focal length";
    EXPECT_TRUE(load(R"({"keys": [[0, 1], [9, 40]]})").warnings.empty()) << "a zoom";
}

TEST_F(UnlikelyValues, RotationsInRadians) {
    const auto load = [&](const std::string& degrees) {
        return load_scene(
            write_scene(R"("environment": [1, 1, 1], "nodes": [{"name": "door", "rotation": {"axis": [0, 1, 0],
            "degrees": )" +
                        degrees + "}}]"));
    };
    for (const char* radians : {"-1.5708", "0.7854", "3.14159", R"({"keys": [[0, 0], [9, 6.2832]]})"}) {
        EXPECT_TRUE(has_warning(load(radians), "node \"door\": the degrees of its rotation look like radians"))
            << radians;
    }
    for (const char* degrees : {"0", "1.5", "-3", "45", "1.571", R"({"keys": [[0, 0], [9, 1.5708], [12, 2]]})"}) {
        EXPECT_TRUE(load(degrees).warnings.empty()) << degrees;
    }
}

TEST_F(UnlikelyValues, OperationsInRadians) {
    const auto load = [&](const std::string& operations) {
        return load_scene(
            write_scene(R"("environment": [1, 1, 1], "nodes": [{"name": "arm", "operations": [)" + operations + "]}]"));
    };
    const char* axis = R"({"scale": 2}, {"rotate": {"axis": [1, 1, 0], "degrees": 0.7854}}, {"translate": [1, 2, 3]})";
    const char* keyed = R"({"rotate_z": {"keys": [[0, 0], [9, -3.1416]]}})";
    for (const char* radians : {R"({"rotate_y": 1.5708})", R"({"rotate_x": 0}, {"rotate_z": 0.5236})", axis, keyed}) {
        EXPECT_TRUE(has_warning(load(radians), "node \"arm\": the degrees of its rotation look like radians"))
            << radians;
    }
    const char* mixed = R"({"rotate_y": 1.5708}, {"rotate_x": {"keys": [[0, 1.5708], [9, 30]]}})";
    for (const char* degrees : {R"({"rotate_y": 90})", R"({"translate": [1.5708, 0, 0]})", mixed, ""}) {
        EXPECT_TRUE(load(degrees).warnings.empty()) << degrees;
    }
}

TEST_F(UnlikelyValues, CutsOutsideTheFrames) {
    const auto load = [&](const std::string& cuts) {
        return load_scene(write_scene(R"("environment": [1, 1, 1], "frames": [5, 20], "cuts": )" + cuts));
    };
    EXPECT_TRUE(has_warning(load("[7, 50]"), "cut at frame 50 lies outside the frames 5 to 20"));
    EXPECT_TRUE(has_warning(load("[4]"), "cut at frame 4"));
    EXPECT_TRUE(load("[6, 20]").warnings.empty());
}

TEST_F(UnlikelyValues, CamerasThatJumpWithoutACut) {
    const auto load = [&](const std::string& cuts, const std::string& interpolation, const std::string& holder) {
        const std::string keys = R"("translation": {"interpolation": ")" + interpolation +
                                 R"(", "keys": [[0, [0, 0, 5]], [8, [0, 0, 5]], [10, [3, 0, 5]], [15, [4, 0, 5]]]})";
        return load_scene(write_scene(R"("environment": [1, 1, 1], "frames": [0, 20], "cuts": )" + cuts +
                                      R"(, "nodes": [{"name": "dolly", )" + keys + holder));
    };
    const std::string own = R"(, "camera": {}}])", below = R"(, "children": [{"name": "eye", "camera": {}}]}])";
    EXPECT_TRUE(
        has_warning(load("[]", "step", own), "camera of node \"dolly\": step keys move it at frame 10 and at 1 more"));
    EXPECT_TRUE(has_warning(load("[10]", "step", below), "\"eye\": step keys move it at frame 15, which"));
    EXPECT_TRUE(load("[10, 15]", "step", own).warnings.empty());
    EXPECT_TRUE(load("[]", "linear", own).warnings.empty());
    EXPECT_TRUE(load("[]", "step", R"(, "shape": {"type": "box"}}, {"name": "eye", "camera": {}}])").warnings.empty());
}

}  // namespace
}  // namespace aleph
