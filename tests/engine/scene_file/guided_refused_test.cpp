// Scene files whose "look_at" or "follow_path" cannot be: keys that exclude each other, cycles, no direction, and more
// work or memory than the limits.

#include "tests/engine/scene_file/scene_texts.h"

namespace aleph {
namespace {

BadScene path(const std::string& body, const std::string& place, const std::string& word) {
    return node("\"follow_path\": {" + body + "}", "/follow_path" + place, word);
}

TEST(GuidedRefused, LookAt) {
    expect_all_refused({
        scene(R"("nodes": [{"look_at": "bal"}, {"name": "ball"}])", "/nodes/0/look_at",
              "there is no node called \"bal\"; did you mean \"ball\"?"),
        scene(R"("nodes": [{"look_at": "wheel", "include": "car.glb"}])", "/nodes/0/look_at",
              "nodes of an included file cannot be named here"),
        node(R"("look_at": [0, 1])", "/look_at", "3 numbers"),
        node(R"("look_at": [0, 0, 1], "rotation": [0, 0, 0, 1])", "/rotation", "either \"look_at\" or \"rotation\""),
        node(R"("look_at": [0, 0, 1], "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1])", "/look_at",
             "either \"matrix\" or \"look_at\""),
        node(R"("look_at": [0, 0, 1], "operations": [{"scale": 2}])", "/look_at",
             "either \"operations\" or \"look_at\""),
        node(R"("up": [0, 1, 0])", "/up", "\"up\" goes with \"look_at\""),
        node(R"("look_at": [0, 0, 1], "up": [0, 0, 0])", "/up", "\"up\" cannot be zero"),
        node(R"("name": "n", "look_at": "n")", "/look_at", "cannot look at itself"),
        node(R"("look_at": [0, 0, 0])", "/look_at", "always where it looks"),
        node(R"("look_at": "", "translation": [0, 0, 1])", "/look_at", "there is no node called \"\""),
        node(R"("look_at": [0, 0, 1], "camera": {"look_at": "x"})", "/camera/look_at", "\"look_at\" of the node"),
        node(R"("lookat": [0, 0, 1])", "/lookat", "\"look_at\" of the node"),
        scene(R"("nodes": [{"scale": [1, 1, 0], "children": [{"look_at": [0, 0, 1]}]}])", "/nodes/0/children/0/look_at",
              "always where it looks"),
    });
}

TEST(GuidedRefused, Cycles) {
    expect_all_refused({
        scene(R"("nodes": [{"name": "a", "look_at": "b", "children": [{"name": "b", "translation": [0, 0, 1]}]}])",
              "/nodes/0/look_at", "\"b\" moves when this node turns"),
        scene(R"("nodes": [{"name": "a", "look_at": "y", "children": [{"name": "x", "translation": [0, 0, 1]}]},
                           {"name": "b", "look_at": "x", "children": [{"name": "y", "translation": [0, 0, 1]}]}])",
              "/nodes/1/look_at", "a cycle"),
        // A copy turns as its original does.
        scene(
            R"("nodes": [{"name": "group", "children": [{"name": "a", "translation": [0, 0, 5], "look_at": "sight", "shape": {"type": "box"}}]},
                           {"name": "copy", "instance": "group"}, {"name": "sight", "parent": "copy/a", "translation": [0, 1, 0]}])",
            "/nodes/0/children/0/look_at", "moves when this node turns"),
    });
}

TEST(GuidedRefused, FollowPath) {
    const std::string line = R"("points": [[0, 0, 0], [1, 0, 0]])";
    expect_all_refused({
        path(line, "", "\"at\" is missing"),
        path(R"("at": 0)", "", "\"points\" is missing"),
        path(line + R"(, "at": 0, "close": true)", "/close", "did you mean \"closed\"?"),
        path(R"("points": [[0, 0, 0]], "at": 0)", "/points", "a list of 2 points or more, found a list of 1"),
        path(R"("points": [[0, 0, 0], [0, 0]], "at": 0)", "/points/1", "3 numbers"),
        path(R"("points": [[1, 2, 3], [1, 2, 3], [1, 2, 3]], "at": 0)", "/points", "no length"),
        path(R"("points": [[1, 2, 3], [2, 2, 3], [1, 2, 3]], "at": 0, "closed": true)", "/points", "three different"),
        path(R"("points": [[1e19, 2, 3], [2, 2, 3]], "at": 0)", "/points/0/0", "finite"),
        path(line + R"(, "at": 1.5)", "/at", "between 0 and 1"),
        path(line + R"(, "at": {"keys": [[0, 0], [9, -0.1]]})", "/at/keys/1/1", "between 0 and 1"),
        path(line + R"(, "at": 0, "up": [0, 1, 0])", "/up", "\"up\" goes with \"align\""),
        path(line + R"(, "at": 0, "align": true, "up": [0, 0, 0])", "/up", "cannot be zero"),
        node("\"translation\": [0, 0, 0], \"follow_path\": {" + line + ", \"at\": 0}", "/translation",
             "either \"follow_path\" or \"translation\""),
        node("\"rotation\": [0, 0, 0, 1], \"follow_path\": {" + line + ", \"at\": 0, \"align\": true}", "/rotation",
             "either \"align\" or \"rotation\""),
        node("\"look_at\": [0, 0, 9], \"follow_path\": {" + line + ", \"at\": 0, \"align\": true}", "/look_at",
             "either \"align\" or \"look_at\""),
        node("\"operations\": [], \"follow_path\": {" + line + ", \"at\": 0}", "/follow_path",
             "either \"operations\" or \"follow_path\""),
        node(R"("path": [])", "/path", "\"follow_path\""),
    });
}

TEST(GuidedRefused, MoreKeysThanTheMemoryHolds) {
    const std::string ball =
        R"({"name": "ball", "translation": {"keys": [[-1000000000, [0, 0, 1]], [1000000000, [1, 0, 1]]]}})";
    const std::string frames = R"("frames": [-1000000000, 1000000000], )";
    expect_all_refused({
        scene(frames + R"("nodes": [{"look_at": "ball"}, )" + ball + "]", "/nodes/0/look_at", "MiB"),
        scene(R"("nodes": [{"look_at": "ball"}, )" + ball + "]", "/nodes/0/look_at", "MiB"),
        scene(R"("nodes": [{"look_at": {"unit": "seconds", "keys": [[-1e18, [0, 0, 1]], [1e18, [0, 1, 1]]]}}])",
              "/nodes/0/look_at", "MiB"),
        scene(frames + R"("nodes": [{"follow_path": {"points": [[0, 0, 0], [1, 0, 0]],
              "at": {"keys": [[-1000000000, 0], [1000000000, 1]]}}}])",
              "/nodes/0/follow_path", "MiB"),
    });
}

TEST(GuidedRefused, MoreWorkThanSeconds) {
    // A deep chain of parents for many keys, and many nodes that look along it.
    std::string deep =
        R"("frames": [0, 5000], "nodes": [{"name": "n0", "translation": {"keys": [[0, [0, 0, 0]], [5000, [1, 0, 0]]]}})";
    for (int i = 1; i < 5000; ++i) deep += fmt::format(R"(, {{"name": "n{}", "parent": "n{}"}})", i, i - 1);
    expect_refused(scene(deep + R"(, {"name": "eye", "translation": [0, 0, 1], "look_at": "n4999"}])",
                         "/nodes/5000/look_at", "take too long"));
    std::string many = R"("nodes": [{"name": "n0", "translation": [0, 0, 1]})";
    for (int i = 1; i < 8000; ++i)
        many += fmt::format(R"(, {{"name": "n{}", "parent": "n{}", "look_at": [0, 0, 9]}})", i, i - 1);
    const BadScene deep_looks = scene(many + "]", "", "take too long");
    const Refusal found = find_refusal([&] { read_scene_text(deep_looks.text, "broken.json"); });
    EXPECT_NE(found.reason.find("take too long"), std::string::npos) << found.message;
}

TEST(GuidedRefused, HugeNumbersAreRefusedOrRead) {
    for (const char* number : {"1e18", "-1e18", "1e-300", "0"}) {
        const std::string n = number;
        const std::string text =
            R"({"aleph": 1, "nodes": [{"scale": )" + n + R"(, "children": [{"scale": [1e18, )" + n +
            R"(, 1], "translation": [)" + n + ", " + n +
            R"(, 1], "look_at": "b"}]}, {"name": "b", "follow_path": {"points": [[)" + n +
            R"(, 0, 0], [1e18, 1, 1], [0, 1e-300, 0]], "at": {"keys": [[0, 0], [5, 1]]}, "align": true}}]})";
        Scene scene;
        const Refusal found = find_refusal([&] { scene = read_scene_text(text, "broken.json").scene; });
        if (!found.message.empty()) continue;
        for (const Node& node : scene.nodes) {
            for (const glm::dquat& q : node.transform.rotation.values) EXPECT_TRUE(std::isfinite(glm::length(q))) << n;
        }
    }
}

}  // namespace
}  // namespace aleph
