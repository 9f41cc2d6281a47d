// Includes: the animation, materials, scale and axis that a scene chooses, and files that are shown more than once.

#include "engine/pose/pose.h"
#include "tests/engine/load/fixture.h"
#include "tests/support/files/alembic_draft.h"

namespace aleph {
namespace {

/// A triangle of two materials under two nodes. "right" moves one of them, an animation without a name the other.
std::string two_animations() {
    GltfDraft draft = moving_triangle();
    draft.json["animations"][0]["name"] = "right";
    draft.animate(1, "translation", {0, 1}, {0, 0, 0, 10, 0, 0});
    draft.json["materials"] = {{{"name", "steel"}}, {{"name", "wood"}}};
    draft.json["nodes"].push_back({{"name", "other"}, {"mesh", 1}});
    draft.json["scenes"][0]["nodes"] = {0, 1};
    draft.primitive()["material"] = 0;
    draft.json["meshes"].push_back(Json(draft.json["meshes"][0]));
    draft.json["meshes"][1]["primitives"][0]["material"] = 1;
    return draft.to_text();
}

class IncludeOptions : public LoadScene {
  protected:
    void SetUp() override {
        LoadScene::SetUp();
        write("two.gltf", two_animations());
    }
    Scene load(const std::string& include) const {
        return load_lit(R"("materials": {"oak": {}}, "include": )" + include);
    }
    /// Which of the two nodes are animated.
    static std::pair<bool, bool> animated(const Scene& scene) {
        return {is_animated(scene.nodes.at(0).transform.translation),
                is_animated(scene.nodes.at(1).transform.translation)};
    }
};

TEST_F(IncludeOptions, AnimationsAreChosenByName) {
    EXPECT_EQ(animated(load(R"("two.gltf")")), std::pair(true, true));
    EXPECT_EQ(animated(load(R"({"file": "two.gltf"})")), std::pair(true, true));
    EXPECT_EQ(animated(load(R"({"file": "two.gltf", "animation": "right"})")), std::pair(true, false));
    EXPECT_EQ(animated(load(R"({"file": "two.gltf", "animation": ["animation 1"]})")), std::pair(false, true));
    const Scene none = load(R"({"file": "two.gltf", "animation": []})");
    EXPECT_EQ(animated(none), std::pair(false, false));
    expect_saved_and_loaded_alike(none);
}

TEST_F(IncludeOptions, MaterialsOfTheSceneTakeThePlaceOfTheFiles) {
    const Scene scene = load(R"({"file": "two.gltf", "materials": {"wood": "oak"}})");
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.materials[scene.meshes[0].material].name, "steel");
    EXPECT_EQ(scene.meshes[1].material, 0);
    EXPECT_EQ(scene.materials[0].name, "oak");
    expect_saved_and_loaded_alike(scene);
}

TEST_F(IncludeOptions, ScaleAndAxisApplyToTheWholeFile) {
    const auto place = [&](const char* up, const glm::dvec3& point) {
        const Scene scene =
            load(std::string(R"({"file": "two.gltf", "animation": "right", "scale": 0.5, "up": ")") + up + "\"}");
        const ScenePose posed = pose(scene, 1.0);
        return glm::dvec3(posed.world[find_named(scene.nodes, "mover")] * glm::dvec4(point, 1.0));
    };
    const auto expect_near = [](const glm::dvec3& a, const glm::dvec3& b) { EXPECT_LT(glm::length(a - b), 1e-12); };
    expect_near(place("y", {0, 1, 0}), {5.0, 0.5, 0.0});
    expect_near(place("z", {0, 0, 1}), {5.0, 0.5, 0.0});  // the file's z points up; the animation moves along its x
    expect_near(place("x", {1, 0, 0}), {0.0, 5.5, 0.0});
    expect_saved_and_loaded_alike(load(R"({"file": "two.gltf", "scale": 0.5, "up": "x"})"));
}

TEST_F(IncludeOptions, AnIncludeIsShownAgainAndIsAParent) {
    const Scene scene = load_lit(R"("nodes": [
        {"name": "first", "translation": [0, 1, 0], "include": {"file": "two.gltf", "scale": 2},
         "children": [{"name": "hat", "translation": [0, 3, 0], "shape": {"type": "box"}}]},
        {"name": "second", "translation": [4, 0, 0], "instance": "first"},
        {"name": "own animation", "include": {"file": "two.gltf", "animation": []}}])");
    ASSERT_EQ(scene.source.includes.size(), 3u);
    EXPECT_EQ(scene.meshes.size(), 1u + 2u + 2u) << "the first two includes share their meshes";
    const ScenePose posed = pose(scene, 1.0);
    std::vector<glm::dvec3> movers, hats;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].name == "mover") movers.emplace_back(posed.world[i][3]);
        if (scene.nodes[i].name.find("hat") != std::string::npos) hats.emplace_back(posed.world[i][3]);
    }
    EXPECT_EQ(movers, (std::vector<glm::dvec3>{{20.0, 1.0, 0.0}, {24.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}));
    EXPECT_EQ(hats, (std::vector<glm::dvec3>{{0.0, 4.0, 0.0}, {4.0, 3.0, 0.0}}));
    expect_saved_and_loaded_alike(scene);
}

TEST_F(IncludeOptions, NodesOfAFileCannotBeNamed) {
    const auto load = [&](const std::string& include, const std::string& lamp) {
        return write_scene(include + R"("nodes": [{"name": "robot"}, {"name": "lamp", )" + lamp + "}]");
    };
    const std::string top = R"("include": "two.gltf", )", advice = "name the node that has the \"include\"";
    expect_refused(load(top, R"("parent": "mover")"), "/nodes/1/parent", advice);
    expect_refused(load(top, R"("instance": "mover")"), "/nodes/1/instance", advice);
    expect_refused(load("", R"("parent": "mover", "children": [{"include": "two.gltf"}])"), "/nodes/1/parent", advice);
    expect_refused(load("", R"("parent": "mover")"), "/nodes/1/parent", "there is \"robot\"");
    const Refusal found = find_refusal([&] { load_scene(load("", R"("parent": "mover")")); });
    EXPECT_EQ(found.reason.find("include"), std::string::npos) << "no file is included: " << found.message;
}

TEST_F(IncludeOptions, WhatIsNotThereIsRefused) {
    const auto refused = [&](const std::string& include, const std::string& place, const std::string& word) {
        const fs::path path = write_scene(R"("materials": {"oak": {}}, "include": )" + include);
        const Refusal found = find_refusal([&] { load_scene(path); });
        EXPECT_EQ(found.place, place) << found.message;
        EXPECT_NE(found.reason.find(word), std::string::npos) << include << ": " << found.message;
    };
    refused(R"({"file": "two.gltf", "animation": "rigth"})", "",
            "there is no animation \"rigth\"; did you mean \"right\"?");
    refused(R"({"file": "two.gltf", "materials": {"woud": "oak"}})", "/include/materials/woud",
            "did you mean \"wood\"?");
    refused(R"({"file": "two.gltf", "materials": {"wood": "oka"}})", "/include/materials/wood",
            "did you mean \"oak\"?");
    refused(R"({"file": "two.gltf", "scale": 0})", "/include/scale", "a number above 0");
    refused(R"({"file": "two.gltf", "up": "w"})", "/include/up", "x, y or z");
    refused(R"({"animation": "right"})", "/include", "file");
    refused(R"({"file": "lost.gltf"})", "/include", "there is no file");
}

/// "free" does not inherit, and is visible on its own account: up to the archive's root, which the include moves,
/// turns, scales and hides. Two includes, the second one copied from the first.
TEST_F(IncludeOptions, WhatLeavesItsParentInAnArchiveStaysInTheInclude) {
    const auto transform = [](const char* name, std::uint8_t inherits, std::int8_t visible, double x) {
        return DraftObject{
            name,
            "schema=AbcGeom_Xform_v3",
            {draft_compound(".xform", {draft_scalar<std::uint8_t>(".inherits", DraftProperty::boolean, {{inherits}}),
                                       draft_scalar<std::uint8_t>(".ops", DraftProperty::u8, {{0x10}}),
                                       draft_scalar<double>(".vals", DraftProperty::f64, {{x, 0.0, 0.0}})}),
             draft_scalar<std::int8_t>("visible", DraftProperty::i8, {{visible}})},
            {}};
    };
    DraftObject parent = transform("parent", 1, 0, 5.0);
    parent.children = {transform("free", 0, 1, 2.0)};
    OgawaDraft draft;
    write_draft(folder_ / "leave.abc", draft.finish({parent}));
    const Scene scene = load_lit(R"("nodes": [
        {"name": "a", "translation": [100, 0, 0], "include": {"file": "leave.abc", "scale": 0.01, "up": "z"}},
        {"name": "b", "translation": [0, 7, 0], "visible": false,
         "include": {"file": "leave.abc", "scale": 0.01, "up": "z"}}])");
    const ScenePose frame = pose(scene, 0.0);
    std::vector<std::size_t> found;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
        if (scene.nodes[n].name == "free") found.push_back(n);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(frame.world[found[0]][3].x, 100.02, 1e-9);
    EXPECT_NEAR(frame.world[found[0]][2].y, 0.01, 1e-9) << "z is up";
    EXPECT_NEAR(frame.world[found[1]][3].x, 0.02, 1e-9);
    EXPECT_NEAR(frame.world[found[1]][3].y, 7.0, 1e-9);
    EXPECT_NE(frame.visible[found[0]], 0) << "in spite of its parent";
    EXPECT_EQ(frame.visible[found[1]], 0) << "its include is hidden";
}

}  // namespace
}  // namespace aleph
