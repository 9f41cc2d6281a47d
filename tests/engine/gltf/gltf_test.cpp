// glTF reader: scene graph, cameras, lights, files. Every expected value is worked out by hand.
#include "engine/pose/pose.h"
#include "tests/engine/gltf/fixture.h"

namespace aleph {
namespace {

using Gltf = GltfFixture;

void expect_near(const glm::dmat4& a, const glm::dmat4& b, double tolerance) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            EXPECT_NEAR(a[column][row], b[column][row], tolerance) << "row " << row << " column " << column;
        }
    }
}

TEST_F(Gltf, Triangle) {
    const Scene scene = load(triangle_draft());
    ASSERT_EQ(scene.nodes.size(), 1u);
    EXPECT_EQ(scene.nodes[0].name, "node0");
    EXPECT_EQ(scene.nodes[0].parent, no_index);
    EXPECT_EQ(scene.nodes[0].meshes, std::vector<int>{0});
    EXPECT_EQ(scene.nodes[0].include, 0);
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(scene.meshes[0].triangles, (std::vector<glm::uvec3>{{0, 1, 2}}));
    EXPECT_TRUE(scene.meshes[0].normals.empty());
    ASSERT_EQ(scene.materials.size(), 1u);  // the format's default
    EXPECT_EQ(scene.materials[0], (Material{.name = "default", .gloss = {.metallic = 1.0}, .include = 0}));
    EXPECT_EQ(scene.meshes[0].material, 0);
    EXPECT_TRUE(scene.source.warnings.empty());
}

TEST_F(Gltf, S12_11_EmptyBinaryChunk) {
    GltfDraft draft = triangle_draft();
    for (const char* key : {"meshes", "accessors", "bufferViews"}) draft.json.erase(key);
    draft.json["nodes"] = {Json::object()};
    draft.json["buffers"] = Json::array();
    draft.buffer.clear();
    write_bytes(folder_ / "empty.glb", draft.to_glb());
    EXPECT_EQ(load_file("empty.glb").nodes.size(), 1u);
}

TEST_F(Gltf, S12_12_NothingOfOneFileStaysInTheNext) {
    GltfDraft full = triangle_draft();
    full.json["materials"] = {{{"name", "m"}}};
    full.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    full.animate(0, "translation", {0.0f, 1.0f}, {0, 0, 0, 1, 0, 0});
    const Scene alone = load(triangle_draft());
    load(full);
    EXPECT_EQ(load(triangle_draft()), alone);
}

TEST_F(Gltf, S12_11_AllThreeContainersGiveTheSameScene) {
    GltfDraft draft = triangle_draft();
    const Scene from_text = load(draft);
    write_bytes(folder_ / "scene.glb", draft.to_glb());
    EXPECT_EQ(load_file("scene.glb"), from_text);

    std::filesystem::create_directory(folder_ / "sub folder");
    Bytes longer = draft.buffer;
    longer.resize(longer.size() + 100);  // a file may be longer than the buffer in it
    write_bytes(folder_ / "sub folder/data.bin", longer);
    draft.json["buffers"] = {{{"byteLength", draft.buffer.size()}, {"uri", "sub%20folder/data.bin"}}};
    EXPECT_EQ(load(draft), from_text);
}

TEST_F(Gltf, TranslationRotationScaleApplyInThatOrder) {
    GltfDraft draft = triangle_draft();
    const double h = std::sqrt(0.5);  // 90 degrees about z
    draft.json["nodes"][0].update({{"translation", {1, 2, 3}}, {"rotation", {0, 0, h, h}}, {"scale", {2, 3, 4}}});
    const ScenePose frame = pose(load(draft), 0.0);
    // x: (2,0,0) turns to (0,2,0); y: (0,3,0) turns to (-3,0,0).
    expect_near(frame.world[0], glm::dmat4(0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 1, 2, 3, 1), 1e-15);
}

TEST_F(Gltf, MatricesAreColumnsAndParentsComeFirst) {
    GltfDraft draft = triangle_draft();
    // Children stand before their parents in the file.
    draft.json["nodes"] = {{{"mesh", 0}, {"translation", {0, 0, 1}}, {"name", "leaf"}},
                           {{"children", {0}}, {"matrix", {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1}}},
                           {{"children", {1}}, {"translation", {10, 0, 0}}, {"name", "top"}}};
    draft.json["scenes"][0]["nodes"] = {2};
    const Scene scene = load(draft);
    ASSERT_EQ(scene.nodes.size(), 3u);
    EXPECT_EQ(scene.nodes[0].name, "top");
    EXPECT_EQ(scene.nodes[1].parent, 0);
    EXPECT_EQ(scene.nodes[2].name, "leaf");
    EXPECT_EQ(scene.nodes[2].parent, 1);
    ASSERT_TRUE(scene.nodes[1].transform.matrix.has_value());
    expect_near(pose(scene, 0.0).world[2], glm::dmat4(0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 15, 6, 9, 1), 0.0);
}

TEST_F(Gltf, OnlyTheDefaultSceneIsRead) {
    GltfDraft draft = triangle_draft();
    draft.json["nodes"] = {{{"name", "a"}}, {{"name", "b"}, {"mesh", 0}}};
    draft.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    draft.json["scene"] = 1;
    const Scene scene = load(draft);
    ASSERT_EQ(scene.nodes.size(), 1u);
    EXPECT_EQ(scene.nodes[0].name, "b");
    EXPECT_TRUE(has_warning(scene, "only the default one is read"));

    draft.json.erase("scene");
    draft.json.erase("scenes");
    EXPECT_EQ(load(draft).nodes.size(), 2u);
}

TEST_F(Gltf, S13_5_KF24_ChainOfHundredThousandNodesLoads) {
    GltfDraft draft = triangle_draft();
    const int depth = 100000;
    Json nodes = Json::array();
    for (int i = 0; i + 1 < depth; ++i) nodes.push_back({{"children", {i + 1}}, {"translation", {0.5, 0, 0}}});
    nodes.push_back({{"mesh", 0}});
    draft.json["nodes"] = nodes;
    const Scene scene = load(draft);
    ASSERT_EQ(scene.nodes.size(), static_cast<std::size_t>(depth));
    EXPECT_EQ(pose(scene, 0.0).world.back()[3].x, 0.5 * (depth - 1));
}

TEST_F(Gltf, OneMeshUnderTwoNodesIsStoredOnce) {
    GltfDraft draft = triangle_draft();
    Json second = draft.primitive();
    draft.json["meshes"][0]["name"] = "pair";
    draft.json["meshes"][0]["primitives"].push_back(second);
    draft.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {1, 0, 0}}}};
    draft.json["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = load(draft);
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.meshes[0].name, "pair.0");
    EXPECT_EQ(scene.nodes[0].meshes, (std::vector<int>{0, 1}));
    EXPECT_EQ(scene.nodes[1].meshes, (std::vector<int>{0, 1}));
}

TEST_F(Gltf, Cameras) {
    GltfDraft draft = triangle_draft();
    draft.json["cameras"] = {
        {{"type", "perspective"},
         {"name", "lens"},
         {"perspective", {{"yfov", 0.75}, {"znear", 0.5}, {"aspectRatio", 2}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", -3}, {"ymag", -2.5}, {"znear", 0}, {"zfar", 100}}}}};
    draft.json["nodes"].push_back({{"camera", 1}});
    draft.json["nodes"][0]["camera"] = 0;
    draft.json["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = load(draft);
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].name, "lens");
    EXPECT_FALSE(scene.cameras[0].orthographic);
    EXPECT_EQ(scene.cameras[0].fov, Track<double>(0.75));  // vertical, radians, whatever the aspect
    EXPECT_TRUE(scene.cameras[1].orthographic);
    EXPECT_EQ(scene.cameras[1].half_height, Track<double>(2.5));
    EXPECT_EQ(scene.nodes[0].camera, 0);
    EXPECT_EQ(scene.nodes[1].camera, 1);
}

TEST_F(Gltf, PunctualLightsKeepTheirUnits) {
    GltfDraft draft = triangle_draft();
    draft.json["extensionsUsed"] = {"KHR_lights_punctual"};
    draft.json["extensionsRequired"] = {"KHR_lights_punctual"};
    draft.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"name", "bulb"}, {"color", {1, 0.5, 0.25}}, {"intensity", 683}, {"range", 7}},
        {{"type", "directional"}}};
    const auto holds = [](int light) { return Json{{"KHR_lights_punctual", {{"light", light}}}}; };
    draft.json["nodes"] = {{{"extensions", holds(1)}, {"rotation", {0, 1, 0, 0}}},
                           {{"extensions", holds(0)}, {"translation", {1, 2, 3}}},
                           {{"extensions", holds(0)}}};
    draft.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = load(draft);
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(scene.lights[0].name, "bulb");
    EXPECT_EQ(scene.lights[0].kind, Light::Kind::point);
    EXPECT_EQ(scene.lights[0].intensity, Track<double>(683.0));  // candela, unscaled
    EXPECT_EQ(scene.lights[0].color, Track<glm::dvec3>(glm::dvec3(1, 0.5, 0.25)));
    EXPECT_EQ(scene.lights[0].range, 7.0);
    EXPECT_EQ(scene.lights[1].kind, Light::Kind::directional);
    EXPECT_EQ(scene.lights[1].intensity, Track<double>(1.0));
    EXPECT_EQ(scene.lights[1].color, Track<glm::dvec3>(glm::dvec3(1.0)));
    const ScenePose frame = pose(scene, 0.0);
    ASSERT_EQ(frame.lights.size(), 3u);
    EXPECT_NEAR(frame.lights[0].direction.z, 1.0, 1e-15);  // -z turned half round y
    EXPECT_EQ(frame.lights[1].position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(frame.lights[2].position, glm::dvec3(0, 0, 0));
}

TEST_F(Gltf, SpotLightsHaveTheirCones) {
    GltfDraft draft = triangle_draft();
    draft.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"range", 3}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}},
        {{"type", "spot"}, {"spot", Json::object()}},
        // Between a quarter turn and the float next above it.
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 1.57079633}, {"outerConeAngle", 1.57079637}}}}};
    draft.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    const Scene scene = load(draft);
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].kind, Light::Kind::spot);
    EXPECT_EQ(scene.lights[0].inner_cone, Track<double>(0.25));
    EXPECT_EQ(scene.lights[0].outer_cone, Track<double>(0.5));
    EXPECT_EQ(scene.lights[0].range, Track<double>(3.0));
    EXPECT_EQ(scene.lights[1].inner_cone, Track<double>(0.0));
    EXPECT_EQ(scene.lights[1].outer_cone, Track<double>(std::acos(-1.0) / 4.0));
    EXPECT_EQ(scene.lights[1].range, Track<double>(0.0));
    EXPECT_EQ(scene.lights[2].outer_cone, Track<double>(std::acos(0.0)));
    EXPECT_EQ(scene.lights[2].inner_cone, Track<double>(std::acos(0.0)));
    EXPECT_EQ(pose(scene, 0.0).lights[0].outer_cone, 0.5);
}

TEST_F(Gltf, InstancesBecomeChildNodes) {
    GltfDraft draft = triangle_draft();
    const int moves = draft.add_accessor<float>({0, 0, 0, 5, 0, 0}, "VEC3", 3);
    const int turns = draft.add_accessor<std::int16_t>({0, 0, 0, 32767, 0, 0, 32767, 0}, "VEC4", 4, true);
    const int sizes = draft.add_accessor<float>({1, 1, 1, 2, 3, 4}, "VEC3", 3);
    draft.json["nodes"] = {
        {{"mesh", 0},
         {"name", "tree"},
         {"children", {1}},
         {"translation", {0, 0, 10}},
         {"extensions",
          {{"EXT_mesh_gpu_instancing",
            {{"attributes", {{"TRANSLATION", moves}, {"ROTATION", turns}, {"SCALE", sizes}, {"_ID", sizes}}}}}}}},
        {{"name", "child"}}};
    const Scene scene = load(draft);
    ASSERT_EQ(scene.nodes.size(), 4u);
    EXPECT_TRUE(scene.nodes[0].meshes.empty());
    EXPECT_EQ(scene.nodes[1].name, "tree.0");
    EXPECT_EQ(scene.nodes[2].name, "tree.1");
    EXPECT_EQ(scene.nodes[2].parent, 0);
    EXPECT_EQ(scene.nodes[2].meshes, std::vector<int>{0});
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.nodes[3].name, "child");
    EXPECT_EQ(scene.nodes[3].parent, 0);
    EXPECT_TRUE(scene.source.warnings.empty());
    // Half a turn about z, then the instance's place, then the node's.
    expect_near(pose(scene, 0.0).world[2], glm::dmat4(-2, 0, 0, 0, 0, -3, 0, 0, 0, 0, 4, 0, 5, 0, 10, 1), 1e-15);
}

TEST_F(Gltf, NodeVisibilityHidesWhatIsBelow) {
    GltfDraft draft = triangle_draft();
    draft.json["nodes"] = {{{"children", {1}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}},
                           {{"mesh", 0}, {"extensions", {{"KHR_node_visibility", Json::object()}}}}};
    const Scene scene = load(draft);
    EXPECT_EQ(scene.nodes[1].visible, Track<double>(1.0));
    EXPECT_EQ(pose(scene, 0.0).visible, (std::vector<std::uint8_t>{0, 0}));
}

TEST_F(Gltf, IncludeHangsBelowItsNodeBehindTheScenesOwn) {
    GltfDraft draft = triangle_draft();
    draft.json["materials"] = {{{"name", "m"}}};
    draft.primitive()["material"] = 0;
    draft.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    draft.json["nodes"] = {{{"mesh", 0}, {"camera", 0}, {"children", {1}}}, {{"mesh", 0}}};
    write_text(folder_ / "scene.gltf", draft.to_text());
    Scene scene;
    scene.nodes.resize(2);
    scene.meshes.resize(3);
    scene.materials.resize(4);
    scene.cameras.resize(5);
    append_gltf(folder_ / "scene.gltf", scene, 1, 6);
    append_gltf(folder_ / "scene.gltf", scene, no_index, 7);
    ASSERT_EQ(scene.nodes.size(), 6u);
    EXPECT_EQ(scene.nodes[2].parent, 1);
    EXPECT_EQ(scene.nodes[2].meshes, std::vector<int>{3});
    EXPECT_EQ(scene.nodes[2].camera, 5);
    EXPECT_EQ(scene.nodes[2].light, no_index);
    EXPECT_EQ(scene.nodes[3].parent, 2);
    EXPECT_EQ(scene.nodes[3].include, 6);
    EXPECT_EQ(scene.meshes[3].material, 4);
    EXPECT_EQ(scene.meshes[3].include, 6);
    EXPECT_EQ(scene.materials[4].include, 6);
    EXPECT_EQ(scene.cameras[5].include, 6);
    EXPECT_EQ(scene.nodes[4].parent, no_index);
    EXPECT_EQ(scene.nodes[4].include, 7);
    EXPECT_EQ(scene.nodes[5].parent, 4);
    EXPECT_EQ(scene.meshes[4].material, 5);
}

TEST_F(Gltf, UnknownOptionalExtensionIsAWarning) {
    GltfDraft draft = triangle_draft();
    draft.json["extensionsUsed"] = {"VENDOR_thing"};
    draft.json["nodes"][0]["extensions"] = {{"VENDOR_thing", {{"deep", {1, 2, 3}}}}};
    draft.json["nodes"][0]["extras"] = {{"extensions", {{"KHR_texture_transform", 1}}}};  // not glTF's business
    EXPECT_TRUE(has_warning(load(draft), "VENDOR_thing is ignored"));
}

}  // namespace
}  // namespace aleph
