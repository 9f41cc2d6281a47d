// glTF reader: morph targets, skins, and meshes that are copied for each node.
#include "engine/load/warnings.h"
#include "engine/pose/pose.h"
#include "tests/engine/gltf/fixture.h"
#include "tests/support/files/gltf_deform_draft.h"

namespace aleph {
namespace {

using GltfDeform = GltfFixture;

TEST_F(GltfDeform, WeightsOfMorphTargets) {
    GltfDraft draft = morph_draft();
    const Mesh plain = load(draft).meshes[0];
    EXPECT_TRUE(plain.deformation.targets.at(1).normals.empty());
    EXPECT_EQ(plain.deformation.target_weights, (std::vector<Track<double>>{0.0, 0.0}));
    draft.json["meshes"][0]["weights"] = {0.25, -0.5};
    EXPECT_EQ(load(draft).meshes[0].deformation.target_weights, (std::vector<Track<double>>{0.25, -0.5}));
    draft.json["nodes"][0]["weights"] = {1, 2};  // the node's own come first
    EXPECT_EQ(load(draft).meshes[0].deformation.target_weights, (std::vector<Track<double>>{1.0, 2.0}));
}

/// A camera that is added comes before all other nodes.
TEST_F(GltfDeform, SkinsFollowTheSameJointsWithAnAddedCamera) {
    Scene scene = load(skin_draft());
    const ScenePose before = pose(scene, 0.0);
    add_framing_camera(scene);
    const ScenePose after = pose(scene, 0.0);
    EXPECT_EQ(after.meshes[0].positions, before.meshes[0].positions);
    EXPECT_EQ(scene.nodes[scene.skins[0].joints[1]].transform.translation,
              Track<glm::dvec3>(glm::dvec3(0.0, 1.0, 0.0)));
}

/// glTF 2.0, 3.7.3.3: only the joints place a skinned mesh, but its node still hides it.
TEST_F(GltfDeform, SkinsIgnoreAFlatNode) {
    const auto placed = [](const Scene& scene, double seconds) {
        const ScenePose posed = pose(scene, seconds);
        std::vector<glm::dvec3> points;
        for (const glm::dvec3& p : posed.meshes[0].positions)
            points.emplace_back(posed.world[posed.instances[0].node] * glm::dvec4(p, 1.0));
        return points;
    };
    const std::vector<glm::dvec3> expected = placed(load(skin_draft()), 0.0);
    GltfDraft flat = skin_draft();
    flat.json["nodes"][0]["scale"] = {0, 0, 0};
    EXPECT_EQ(placed(load(flat), 0.0), expected);
    GltfDraft matrix = skin_draft();
    matrix.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 4, 5, 6, 1};
    EXPECT_EQ(placed(load(matrix), 0.0), expected);
    GltfDraft above = skin_draft();  // a node above, which mirrors at 1 s
    above.json["nodes"].push_back({{"children", {0}}});
    above.json["scenes"][0]["nodes"] = {3, 1};
    above.animate(3, "scale", {0, 2}, {1, 1, 1, -1, 1, 1});
    for (const double seconds : {0.0, 1.0, 2.0}) EXPECT_EQ(placed(load(above), seconds), expected) << seconds;
    above.json["nodes"][3]["extensions"]["KHR_node_visibility"]["visible"] = false;
    above.json["extensionsUsed"] = {"KHR_node_visibility"};
    EXPECT_EQ(pose(load(above), 0.0).shown[0], 0);
}

TEST_F(GltfDeform, CubicWeightsKeepTheirTangents) {
    GltfDraft draft = morph_draft();
    // Per key: in-tangents of both targets, values of both, out-tangents of both.
    draft.animate(0, "weights", {0, 2}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, "CUBICSPLINE");
    const auto weights = load(draft).meshes[0].deformation.target_weights;
    EXPECT_EQ(weights[0].interpolation, Interpolation::cubic);
    EXPECT_EQ(weights[0].values, (std::vector<double>{1, 3, 5, 7, 9, 11}));
    EXPECT_EQ(weights[1].values, (std::vector<double>{2, 4, 6, 8, 10, 12}));
}

TEST_F(GltfDeform, NormalizedIntegerWeights) {
    GltfDraft draft = morph_draft();
    draft.animate(0, "weights", {0, 1}, {0, 0, 0, 0});
    draft.json["animations"][0]["samplers"][0]["output"] =
        draft.add_accessor<std::uint8_t>({0, 51, 255, 102}, "SCALAR", 1, true);
    const auto weights = load(draft).meshes[0].deformation.target_weights;
    EXPECT_EQ(weights[0].values, (std::vector<double>{0, 1}));
    EXPECT_EQ(weights[1].values, (std::vector<double>{0.2, 0.4}));
}

TEST_F(GltfDeform, MorphedMeshOfTwoNodesIsStoredForEach) {
    GltfDraft draft = morph_draft();
    draft.json["nodes"] = {{{"mesh", 0}, {"weights", {1, 0}}}, {{"mesh", 0}}};
    draft.json["scenes"][0]["nodes"] = {0, 1};
    draft.animate(1, "weights", {0, 1}, {0, 0, 1, 1});
    const Scene scene = load(draft);
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.nodes[0].meshes, std::vector<int>{0});
    EXPECT_EQ(scene.nodes[1].meshes, std::vector<int>{1});
    EXPECT_EQ(scene.meshes[0].deformation.target_weights, (std::vector<Track<double>>{1.0, 0.0}));
    EXPECT_EQ(scene.meshes[1].deformation.target_weights[0].key_count(), 2u);
    EXPECT_EQ(scene.meshes[0].deformation.targets, scene.meshes[1].deformation.targets);
    EXPECT_EQ(scene.meshes[0].positions, scene.meshes[1].positions);
}

TEST_F(GltfDeform, FlatMeshTakesNoTargetNormals) {
    GltfDraft draft = morph_draft();
    draft.primitive()["attributes"]["NORMAL"] = draft.add_accessor(std::vector<float>(9, 0.0f), "VEC3", 3);
    const Scene scene = load(draft);
    EXPECT_TRUE(scene.meshes[0].deformation.targets[0].normals.empty());
    EXPECT_TRUE(has_warning(scene, "morph targets' normals are not used"));
}

TEST_F(GltfDeform, TargetsOfColoursAndTextureCoordinatesWarn) {
    const char* const warning = "morph targets of colours and texture coordinates are not used";
    EXPECT_FALSE(has_warning(load(morph_draft()), warning));
    for (const char* const name : {"COLOR_0", "TEXCOORD_0"}) {
        GltfDraft draft = morph_draft();
        draft.primitive()["targets"][1][name] = draft.add_accessor(std::vector<float>(9, 0.0f), "VEC3", 3);
        EXPECT_TRUE(has_warning(load(draft), warning)) << name;
    }
}

TEST_F(GltfDeform, S12_11_BindsAreOptional) {
    GltfDraft draft = skin_draft();
    draft.json["skins"][0].erase("inverseBindMatrices");
    EXPECT_EQ(load(draft).skins[0].inverse_binds, (std::vector<glm::dmat4>(2, glm::dmat4(1.0))));
}

TEST_F(GltfDeform, EightJointsPerVertex) {
    GltfDraft draft = skin_draft();
    Json& attributes = draft.primitive()["attributes"];
    attributes["JOINTS_1"] = draft.add_accessor<std::uint8_t>({1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4", 4);
    attributes["WEIGHTS_1"] =
        draft.add_accessor<std::uint16_t>({65535, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4", 4, true);
    const Scene scene = load(draft);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.deformation.joints_per_vertex, 8);
    ASSERT_EQ(mesh.deformation.joint_weights.size(), 24u);
    EXPECT_EQ(mesh.deformation.joint_weights[0],
              (JointWeight{0, 0.5f}));  // 1 of set 0 and 1 of set 1, brought to a sum of 1
    EXPECT_EQ(mesh.deformation.joint_weights[4], (JointWeight{1, 0.5f}));
    EXPECT_EQ(mesh.deformation.joint_weights[8], (JointWeight{0, 0.25f}));
    EXPECT_TRUE(has_warning(scene, "the joint weights of 1 vertices do not sum to 1"));
}

TEST_F(GltfDeform, WeightsAreNormalizedAndNoneIsCarriedByTheFirstJoint) {
    GltfDraft draft = skin_draft();
    draft.primitive()["attributes"]["WEIGHTS_0"] =
        draft.add_accessor<float>({3, 1, 0, 0, 0, 0, 0, 0, 0.2502f, 0.7502f, 0, 0}, "VEC4", 4);
    const Scene scene = load(draft);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.deformation.joint_weights[0].weight, 0.75f);
    EXPECT_EQ(mesh.deformation.joint_weights[1].weight, 0.25f);
    EXPECT_EQ(mesh.deformation.joint_weights[4].weight, 1.0f);
    for (int v = 0; v < 3; ++v) {
        double sum = 0.0;
        for (int k = 0; k < 4; ++k) sum += mesh.deformation.joint_weights[4 * v + k].weight;
        EXPECT_NEAR(sum, 1.0, 1e-7);
    }
    EXPECT_TRUE(has_warning(scene, "the joint weights of 2 vertices"));  // the third is off by rounding only
}

TEST_F(GltfDeform, SkinnedMeshBelongsToItsNodeAndRigidNodesShareAnother) {
    GltfDraft draft = skin_draft();
    Json& nodes = draft.json["nodes"];
    nodes.push_back({{"mesh", 0}});
    nodes.push_back({{"mesh", 0}});
    nodes.push_back({{"mesh", 0}, {"skin", 0}});
    draft.json["scenes"][0]["nodes"] = {0, 1, 3, 4, 5};
    const Scene scene = load(draft);
    ASSERT_EQ(scene.meshes.size(), 3u);
    EXPECT_EQ(scene.nodes[0].meshes, std::vector<int>{0});
    EXPECT_EQ(scene.nodes[3].meshes, std::vector<int>{1});
    EXPECT_EQ(scene.nodes[4].meshes, std::vector<int>{1});
    EXPECT_EQ(scene.nodes[5].meshes, std::vector<int>{2});
    EXPECT_EQ(scene.meshes[0].deformation.skin, 0);
    EXPECT_EQ(scene.meshes[1].deformation.skin, no_index);
    EXPECT_TRUE(scene.meshes[1].deformation.joint_weights.empty());
    EXPECT_EQ(scene.meshes[2].deformation.skin, 0);
    EXPECT_EQ(scene.meshes[2].deformation.joint_weights, scene.meshes[0].deformation.joint_weights);
    EXPECT_EQ(scene.skins.size(), 1u);
}

TEST_F(GltfDeform, SkinWithoutUseIsNotRead) {
    GltfDraft draft = skin_draft();
    draft.json["nodes"][0].erase("skin");
    const Scene scene = load(draft);
    EXPECT_TRUE(scene.skins.empty());
    EXPECT_TRUE(scene.meshes[0].deformation.joint_weights.empty());
    EXPECT_EQ(scene.meshes[0].deformation.joints_per_vertex, 0);
}

TEST_F(GltfDeform, IncludedSkinsCountFromTheirOwnElements) {
    GltfDraft draft = skin_draft();
    write_text(folder_ / "scene.gltf", draft.to_text());
    Scene scene;
    scene.nodes.resize(2);
    scene.skins.resize(3);
    append_gltf(folder_ / "scene.gltf", scene, 1, 4);
    EXPECT_EQ(scene.meshes[0].deformation.skin, 3);
    EXPECT_EQ(scene.skins[3].joints, (std::vector<int>{3, 4}));
    EXPECT_EQ(scene.skins[3].include, 4);
}

}  // namespace
}  // namespace aleph
