// `aleph explain` on scenes whose description is known.

#include <gmock/gmock.h>

#include "engine/scene_file/scene_text.h"
#include "render/cli/commands.h"
#include "render/cli/explain/explain.h"
#include "tests/render/expect_fields.h"
#include "tests/support/quick_settings.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

using testing::HasSubstr;
using testing::Not;

using nlohmann::ordered_json;

/// A carrier that turns and moves, a box on it, a second box of the same name, a hidden one, a camera, a light that
/// dims.
Scene make_scene() {
    Scene scene = read_scene_text(R"({"aleph": 1, "fps": 24, "exposure": 2, "materials": {"paint": {}, "spare": {}},
        "meshes": {"box": {"shape": {"type": "box", "size": [2, 4, 6]}, "material": "paint"}}, "nodes": [
        {"name": "carrier", "translation": {"keys": [[0, [0, 0, 0]], [12, [10, 0, 0]], [48, [10, 20, 0]]]},
         "rotation": {"axis": [0, 0, 1], "degrees": {"values": [0, 90], "period": 12}}},
        {"name": "box", "parent": "carrier", "mesh": "box"}, {"name": "twin", "parent": "carrier", "mesh": "box"},
        {"name": "hidden", "parent": "carrier", "mesh": "box", "visible": false},
        {"name": "eye", "translation": [0, 0, 50], "camera": {"fov": 45}},
        {"name": "lamp", "light": {"type": "point", "intensity": {"values": [5, 5], "period": 12}}}]})",
                                  "made.json")
                      .scene;
    scene.nodes[2].name = "box";
    return scene;
}

ordered_json explain(const Scene& scene) {
    RenderSettings settings;
    set_size(settings, 16, 12);
    return explain_scene(scene, settings, "", choose_planned_frames(scene));
}

TEST(Explain, CountsFramesAndExposure) {
    expect_fields(explain(make_scene()), R"({"counts": {"objects": 6, "animated_objects": 1, "hidden_objects": 1,
        "triangles": 12, "instanced_triangles": 36, "deforming_meshes": 0}, "exposure": {"factor": 2}, "camera": "eye",
        "frames": {"first": 0, "last": 48, "from": "keys"}, "unused": ["material \"spare\""]})");
}

TEST(Explain, ALampInABoxGivesNoExposure) {
    const Scene scene = read_scene_text(R"({"aleph": 1, "frames": [0, 20], "nodes": [
        {"shape": {"type": "box"}, "light": {"type": "point", "intensity": 5}},
        {"translation": [0, 0, 5], "camera": {}}]})",
                                        "made.json")
                            .scene;
    const ordered_json explained = explain(scene);
    expect_fields(explained, R"({"exposure": {"factor": 1, "from": "no frame"}})");
    EXPECT_THAT(explain_text(explained, 60), HasSubstr("exposure  1, since its frames show no direct light"));
}

TEST(Explain, BoundsAreThoseOfWhatIsShown) {
    const ordered_json bounds = explain(make_scene())["bounds"];
    EXPECT_EQ(bounds["first_frame"]["max"], ordered_json::array({1.0, 2.0, 3.0}));
    EXPECT_NEAR(bounds["range"]["max"][1].get<double>(), 21.0, 1e-9);  // turned: the longer side lies along x
    EXPECT_NEAR(bounds["range"]["max"][0].get<double>(), 12.0, 1e-9);
}

TEST(Explain, KeyedPropertiesWithTheirSamplings) {
    const ordered_json explained = explain(make_scene());
    const ordered_json& tracks = explained["objects"][0]["animated"];
    ASSERT_EQ(tracks.size(), 2u);
    expect_fields(tracks[0], R"({"property": "translation", "sampling": "acyclic", "keys": 3, "last": 2})");
    expect_fields(tracks[1], R"({"property": "rotation.degrees", "sampling": "uniform"})");
    EXPECT_FALSE(tracks[1].contains("constant"));
    const ordered_json& dimming = explained["objects"][5]["light"]["animated"];
    ASSERT_EQ(dimming.size(), 1u);
    EXPECT_TRUE(dimming[0]["constant"].get<bool>());  // two keys, both alike
    ASSERT_EQ(explained["time_samplings"].size(), 2u);
    EXPECT_EQ(explained["time_samplings"][0]["properties"].get<int>() +
                  explained["time_samplings"][1]["properties"].get<int>(),
              3);
}

TEST(Explain, AMomentRowByRow) {
    // At .25 s the carrier stands at x = 5, turned by 45 degrees about z.
    const ordered_json moment = explain_moment(make_scene(), 0.25);
    const ordered_json& box = moment["objects"][1];
    EXPECT_EQ(box["path"], "/carrier/box");
    const double h = std::sqrt(0.5);
    const double expected[16] = {h, -h, 0, 5, h, h, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(box["world"][i].get<double>(), expected[i], 1e-15) << i;
    EXPECT_TRUE(box["visible"].get<bool>());
    EXPECT_NEAR(box["bounds"]["max"][1].get<double>(), 3.0 * h, 1e-12);
    EXPECT_EQ(box["points"]["count"], 24);
    EXPECT_EQ(box["points"]["first"].size(), 6u);
    EXPECT_FALSE(moment["objects"][3]["visible"].get<bool>());
    EXPECT_TRUE(moment["objects"][4]["bounds"].is_null());
    EXPECT_FALSE(moment["objects"][4].contains("points"));
}

TEST(Explain, PointsOfACacheAsTheFileHasThem) {
    Scene scene = make_scene();
    scene.point_caches.push_back(
        {.name = "points",
         .sampling = {.kind = TimeSampling::Kind::uniform, .start = 0.0, .period = 1.0, .times = {}},
         .positions = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 2}, {1, 0, 2}, {0, 1, 2}}}});
    Mesh mesh;
    mesh.deformation.points = 0;
    mesh.deformation.vertex_points = {2, 1, 0};
    mesh.positions = {{0, 1, 0}, {1, 0, 0}, {0, 0, 0}};
    mesh.triangles = {{2, 1, 0}};
    scene.meshes.push_back(mesh);
    scene.nodes[5].meshes = {1};
    const ordered_json lamp = explain_moment(scene, 0.5)["objects"][5];
    EXPECT_EQ(lamp["points"]["count"], 3);
    EXPECT_EQ(lamp["points"]["first"][1], ordered_json::array({1.0, 0.0, 1.0}));
    EXPECT_EQ(lamp["bounds"]["min"][2], 1.0);
    const ordered_json explained = explain(scene);
    EXPECT_EQ(explained["counts"]["deforming_meshes"], 1);
    EXPECT_EQ(explained["objects"][5]["deforms"], "points");
    EXPECT_EQ(explained["objects"][5]["animated"][0]["property"], "points");
}

TEST(Explain, TextNamesWhatMovesEvenWhereTheTreeIsCut) {
    Scene scene = make_scene();
    const std::string whole = explain_text(explain(scene), 0);
    for (const char* expected :
         {"frames    0 to 48 at 24 a second", "exposure  2, as the scene says",
          "carrier: animated translation (3 acyclic", "12 triangles of paint", "point light", "material \"spare\"",
          "camera, 45 degrees high", "12 triangles in 1 mesh; 36 triangles in 3 instances", "1 light, 1 camera\n"}) {
        EXPECT_THAT(whole, HasSubstr(expected));
    }
    std::rotate(scene.nodes.begin(), scene.nodes.begin() + 5, scene.nodes.end());  // the lamp first
    for (Node& node : scene.nodes)
        if (node.parent != no_index) ++node.parent;
    const std::string cut = explain_text(explain(scene), 1);
    EXPECT_THAT(cut, HasSubstr("... and 5 more"));
    EXPECT_THAT(cut, HasSubstr("/carrier: translation (3 acyclic"));
}

TEST(Explain, TheEnvironmentAndItsPicture) {
    Scene scene = make_scene();
    EXPECT_TRUE(explain(scene)["environment"].is_null());
    EXPECT_THAT(explain_text(explain(scene), 0), Not(HasSubstr("light     environment")));

    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(0.5, 1.0, 2.0));
    ordered_json explained = explain(scene);
    EXPECT_EQ(explained["environment"]["radiance"], ordered_json::array({0.5, 1.0, 2.0}));
    EXPECT_FALSE(explained["environment"].contains("image"));
    EXPECT_THAT(explain_text(explained, 0), HasSubstr("light     environment of radiance (0.5, 1, 2)\n"));

    scene.images.push_back({.name = "sky", .path = "lib/sky.exr", .bytes = {}, .floats = Image<glm::vec4>(4, 2)});
    scene.environment.image = 0;
    explained = explain(scene);
    expect_fields(explained["environment"],
                  R"({"factor": [0.5, 1, 2], "image": "lib/sky.exr", "size": [4, 2], "rotates": false})");
    EXPECT_EQ(explained["images"][0]["channel"], "float");
    EXPECT_EQ(explained["unused"], ordered_json::array({"material \"spare\""})) << "the picture is used";
    EXPECT_THAT(explain_text(explained, 0),
                HasSubstr("light     environment picture lib/sky.exr, 4 x 2, not rotating, times (0.5, 1, 2)\n"));

    const std::size_t samplings = explained["time_samplings"].size();
    scene.environment.axis_rotation = AxisRotation{{0, 1, 0}, Track<double>({0.0, 1.5}, {0.0, 7.0})};
    explained = explain(scene);
    EXPECT_EQ(explained["environment"]["rotates"], true);
    EXPECT_EQ(explained["environment"]["animated"][0]["property"], "environment_rotation.degrees");
    EXPECT_EQ(explained["time_samplings"].size(), samplings + 1);
    EXPECT_THAT(explain_text(explained, 0),
                HasSubstr("4 x 2, rotating, times (0.5, 1, 2); animated environment_rotation.degrees "
                          "(2 acyclic keys, 0 to 1.5 s, linear)\n"));
}

TEST(Explain, TexturesAndKeysOfEveryPropertyOfAMaterial) {
    Scene scene = make_scene();
    scene.images.push_back({.name = "dot", .path = "dot.png", .bytes = Image<glm::u8vec4>(1, 1), .floats = {}});
    for (const auto& field : material_textures) scene.materials[0].textures[field.slot].image = 0;
    scene.materials[0].layers.anisotropy_rotation.values = {0.0, 1.0};
    scene.materials[0].glass.thickness.values = {0.0, 1.0};
    scene.materials[0].layers.sheen_color.values = {{0, 0, 0}, {1, 1, 1}};
    const ordered_json material = explain(scene)["materials"][0];
    EXPECT_EQ(material["textures"].size(), material_textures.size());
    for (const char* name : {"normal", "clearcoat_normal", "thickness", "sheen_color", "anisotropy"})
        EXPECT_EQ(material["textures"][name], "dot.png") << name;
    std::vector<std::string> keyed;
    for (const ordered_json& track : material["animated"]) keyed.push_back(track["property"]);
    EXPECT_EQ(keyed, (std::vector<std::string>{"sheen_color", "thickness", "anisotropy_rotation"}));
    EXPECT_THAT(explain_text(explain(scene), 0), HasSubstr("  paint: sheen_color (2 uniform keys"));
}

TEST(Explain, AreaLightsAreLights) {
    Scene scene = make_scene();
    EXPECT_EQ(explain(scene)["counts"]["lights"], 1);
    scene.materials[0].glow.color = glm::dvec3(1.0);
    const ordered_json explained = explain(scene);
    expect_fields(explained["counts"], R"({"lights": 4, "area_lights": 3})");  // three nodes show the mesh
    EXPECT_EQ(explained["objects"][1]["area_light"], true);
    const std::string text = explain_text(explained, 0);
    EXPECT_THAT(text, HasSubstr("4 lights (3 of area)"));
    EXPECT_THAT(text, HasSubstr("area light"));
}

TEST(Explain, ObjectsHaveTheirNamesAndNumbersAndStandBelowTheirParents) {
    Scene scene = make_scene();
    Node late;  // as an included file's nodes, which come last
    late.name = "late";
    late.parent = 1;
    late.meshes = {0};
    scene.nodes.push_back(late);
    const ordered_json objects = explain(scene)["objects"];
    expect_fields(objects[1], R"({"name": "box", "object_ids": [0]})");
    expect_fields(objects[2], R"({"path": "/carrier/box/late", "object_ids": [3]})");
    EXPECT_FALSE(objects[0].contains("object_ids"));
}

TEST(Explain, SaysWhatRenderingWouldRefuse) {
    Scene scene = make_scene();
    scene.cameras[0].aperture = 0.1;
    scene.cameras[0].focus_distance = 0.0;
    const ordered_json explained = explain(scene);
    EXPECT_EQ(explained["camera"], "eye");
    ASSERT_EQ(explained["warnings"].size(), 1u);
    const std::string warning = explained["warnings"][0];
    EXPECT_THAT(warning, HasSubstr("rendering is refused: camera of node eye"));
}

/// At few of many frames: no plan is made for them.
TEST(Explain, SaysWhereAFieldOfViewOvershoots) {
    Scene scene = make_scene();
    scene.film.range = {0, 1000};
    scene.cameras[0].fov = Track<double>(
        {0.0, 15.0, 16.0, 33.0}, {0.0, 0.5, 0.0, 0.0, 0.5, 20.0, -20.0, 0.5, 0.0, 0.0, 0.5, 0.0}, Interpolation::cubic);
    const ordered_json explained = explain(scene);
    ASSERT_EQ(explained["warnings"].size(), 1u);
    EXPECT_THAT(std::string(explained["warnings"][0]), HasSubstr("its field of view is"));
}

TEST(Explain, ASceneWithoutACamera) {
    Scene scene = make_scene();
    scene.nodes[4].camera = no_index;
    const ordered_json explained = explain(scene);
    EXPECT_TRUE(explained["camera"].is_null());
    EXPECT_EQ(explained["warnings"].size(), 1u);
    EXPECT_THAT(explain_text(explained, 0), HasSubstr("objects"));
}

}  // namespace
}  // namespace aleph
