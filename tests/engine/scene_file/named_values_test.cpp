// Named values: where they may stand, and files that misuse them.

#include "tests/engine/scene_file/scene_texts.h"

namespace aleph {
namespace {

TEST(NamedValues, StandForNumbersVectorsAndTracks) {
    const Scene scene = read(R"(, "fps": {"named": "rate"}, "frames": [0, {"named": "end"}],
        "named": {"height": 2.5, "wood": [0.4, 0.2, {"named": "blue"}], "blue": 0.1, "end": 48, "rate": 24, "alias": {"named": "wood"},
          "swing": {"interpolation": "ease", "keys": [[0, 0], [{"named": "end"}, 90]]}, "points": [[0, 0, 0], [1, 0, {"named": "height"}]],
          "still": [0, 0, 0, 1], "view": [-0.25, 0.25], "turn": {"axis": [1, 0, 0], "degrees": 30}},
        "materials": {"oak": {"base_color": {"named": "alias"}, "roughness": {"named": "blue"}, "alpha_cutoff": {"named": "blue"}, "alpha_mode": "mask"}},
        "nodes": [{"translation": [0, {"named": "height"}, 0], "scale": {"named": "height"}, "camera": {"shutter": {"named": "view"}},
            "rotation": {"axis": [0, 1, 0], "degrees": {"named": "swing"}}, "shape": {"type": "box", "size": [1, {"named": "height"}, 1]}},
          {"translation": {"keys": [[0, [0, 0, 0]], [{"named": "end"}, {"named": "wood"}]]}, "rotation": {"named": "still"}},
          {"follow_path": {"points": {"named": "points"}, "at": {"named": "blue"}}, "rotation": {"named": "turn"}}])");
    EXPECT_EQ(scene.film.frame_rate, (FrameRate{24, 1}));
    EXPECT_EQ(scene.film.range, (FrameRange{0, 48}));
    EXPECT_EQ(scene.materials[0].base_color.values, std::vector<glm::dvec3>{glm::dvec3(0.4, 0.2, 0.1)});
    EXPECT_EQ(scene.materials[0].gloss.roughness.values, std::vector<double>{0.1});
    const LocalTransform& local = scene.nodes[0].transform;
    EXPECT_EQ(local.translation.values, std::vector<glm::dvec3>{glm::dvec3(0.0, 2.5, 0.0)});
    EXPECT_EQ(local.scale.values, std::vector<glm::dvec3>{glm::dvec3(2.5)});
    EXPECT_EQ(local.axis_rotation->angle.sampling.times, (std::vector<double>{0.0, 2.0}));
    EXPECT_EQ(scene.meshes[0].shape->size, glm::dvec3(1.0, 2.5, 1.0));
    EXPECT_EQ(scene.cameras[0].shutter, glm::dvec2(-0.25, 0.25));
    EXPECT_EQ(scene.nodes[1].transform.translation.values[1], glm::dvec3(0.4, 0.2, 0.1));
    EXPECT_EQ(scene.nodes[1].transform.translation.sampling.times[1], 2.0);
    expect_near(evaluate(scene.nodes[2].transform.translation, 0.0), glm::dvec3(0.1, 0.0, 0.25), 1e-14);
    EXPECT_NEAR(scene.nodes[2].transform.axis_rotation->angle.values[0], std::numbers::pi / 6.0, 1e-15);
    EXPECT_TRUE(again(scene) == scene);
    EXPECT_EQ(write_scene_text(scene, "x.json").find("named"), std::string::npos);
}

TEST(NamedValues, ElementsMayBeCalledNamed) {
    const Scene scene = read(R"(, "images": {"named": "a.png"}, "materials": {"named": {"base_color_texture": "named"}},
        "nodes": [{"name": "named", "include": {"file": "a.glb", "materials": {"named": "named"}}}])");
    EXPECT_EQ(scene.images[0].name, "named");
    EXPECT_EQ(scene.source.includes[0].materials.at("named"), "named");
}

TEST(NamedValues, Refused) {
    expect_all_refused({
        scene(R"("named": {"door height": 2}, "nodes": [{"translation": [0, {"named": "dor height"}, 0]}])",
              "/nodes/0/translation/1", "there is no named value \"dor height\"; did you mean \"door height\"?"),
        scene(R"("nodes": [{"scale": {"named": "x"}}])", "/nodes/0/scale", "there is no named value \"x\""),
        scene(R"("named": {"a": {"named": "a"}})", "/named/a", "\"a\" holds itself"),
        scene(R"("named": {"a": [{"named": "b"}], "b": [{"named": "c"}], "c": [{"named": "a"}]})", "/named/c/0",
              "\"a\" holds itself, through \"c\", \"b\""),
        scene(R"("settings": {"spp": {"named": "n"}}, "named": {"n": 4})", "/settings/spp", "a whole number"),
        scene(R"("named": {"n": "text"})", "/named/n", "a number, a list of numbers or a track"),
        scene(R"("named": 3)", "/named", "an object of values by name"),
        scene(R"("named": {"n": 4}, "nodes": [{"scale": {"named": "n", "other": 1}}])", "/nodes/0/scale/named",
              "unknown key \"named\""),
        scene(R"("named": {"n": 4}, "nodes": [{"scale": {"named": 1}}])", "/nodes/0/scale/named", "unknown key"),
    });
}

TEST(NamedValues, FaultsNameTheUseAndTheDefinition) {
    expect_all_refused({
        scene(R"("named": {"a/b": [1, 2]}, "nodes": [{"translation": {"named": "a/b"}}])", "/nodes/0/translation",
              "expected a list of 3 numbers, found a list of 2; this value is defined at /named/a~1b"),
        scene(R"("named": {"swing": {"keys": [[0, 1], [5, 2], [4, 3]]}}, "nodes": [{"scale": {"named": "swing"}}])",
              "/nodes/0/scale/keys/2/0",
              "is not above the time before; this value is defined at /named/swing/keys/2/0"),
        scene(
            R"("named": {"x": -1, "grey": [0.5, {"named": "x"}, 0]}, "materials": {"m": {"base_color": {"named": "grey"}}})",
            "/materials/m/base_color/1", "found -1; this value is defined at /named/x"),
        scene(R"("named": {"x": 1}, "nodes": [{"scale": 1, "shape": {"type": "box", "size": {"named": "x"}}}])",
              "/nodes/0/shape/size", "; this value is defined at /named/x"),
    });
    // A place that no named value is at has no definition.
    const Refusal found = find_refusal(
        [] { read_scene_text(R"({"aleph": 1, "named": {"x": 1}, "nodes": [{"scale": "y"}]})", "broken.json"); });
    EXPECT_EQ(found.message.find("defined"), std::string::npos) << found.message;
}

TEST(NamedValues, CopiesAreLimited) {
    // Each holds the one before ten times: 10^30 numbers.
    std::string bomb = R"("named": {"n00": [0])";
    for (int i = 1; i <= 30; ++i) {
        bomb += fmt::format(", \"n{:02}\": [", i);
        for (int k = 0; k < 10; ++k) bomb += fmt::format("{}{{\"named\": \"n{:02}\"}}", k == 0 ? "" : ", ", i - 1);
        bomb += "]";
    }
    const Refusal found = find_refusal([&] { read_scene_text("{\"aleph\": 1, " + bomb + "}}", "broken.json"); });
    EXPECT_NE(found.reason.find("the named values and their copies take more than 160 MiB"), std::string::npos)
        << found.message;
    // A long chain of names, and a deep value that is used deep inside others.
    std::string chain = R"("named": {"n0": 1)";
    for (int i = 1; i <= 5000; ++i) chain += fmt::format(", \"n{}\": {{\"named\": \"n{}\"}}", i, i - 1);
    const Refusal deep = find_refusal([&] { read_scene_text("{\"aleph\": 1, " + chain + "}}", "broken.json"); });
    EXPECT_NE(deep.reason.find("128 deep"), std::string::npos) << deep.message;
    const std::string open(70, '['), close(70, ']');
    expect_refused(
        {"{\"aleph\": 1, \"named\": {\"a\": " + open + close + ", \"b\": " + open + "{\"named\": \"a\"}" + close + "}}",
         "/named/b" +
             [] {
                 std::string zeros;
                 for (int i = 0; i < 70; ++i) zeros += "/0";
                 return zeros;
             }(),
         "128 deep"});
}

}  // namespace
}  // namespace aleph
