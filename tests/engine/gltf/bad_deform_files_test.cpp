// glTF files whose instances or morphed meshes multiply, and deformations whose numbers lie.

#include <gtest/gtest.h>

#include <vector>

#include "tests/engine/gltf/bad_deform_draft.h"
#include "tests/support/files/gltf_bad_input.h"
#include "tests/support/refusal.h"

namespace aleph {
namespace {

TEST(GltfBadDeformFiles, TheDraftItselfLoads) {
    const ScratchFolder folder;
    write_text(folder / "draft.gltf", deform_draft().to_text());
    Scene scene;
    append_gltf(folder / "draft.gltf", scene, no_index, 0);
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    EXPECT_EQ(scene.nodes.size(), 7u);
    EXPECT_EQ(scene.meshes.size(), 4u);  // the skinned one, and the morphed one for each of three nodes
}

TEST(GltfBadDeformFiles, S13_4_InstancesThatMultiplyAreLimited) {
    const ScratchFolder folder;
    GltfDraft draft = triangle_draft();
    const int places = draft.add_accessor(std::vector<float>(300000, 0.0f), "VEC3", 3);
    Json nodes = Json::array(), roots = Json::array();
    for (int i = 0; i < 1000; ++i) {
        nodes.push_back(
            {{"mesh", 0}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}});
        roots.push_back(i);
    }
    draft.json["nodes"] = nodes;
    draft.json["scenes"][0]["nodes"] = roots;
    write_text(folder / "many.gltf", draft.to_text());
    Scene scene;
    const Refusal found = find_refusal([&] { append_gltf(folder / "many.gltf", scene, no_index, 0); });
    EXPECT_NE(found.reason.find("too many bytes for its size"), std::string::npos) << found.message;
}

TEST(GltfBadDeformFiles, S13_4_MorphedMeshUnderManyNodesIsLimited) {
    const ScratchFolder folder;
    GltfDraft draft = triangle_draft();
    const int points = draft.add_accessor(std::vector<float>(30000, 1.0f), "VEC3", 3);
    draft.primitive() = {{"attributes", {{"POSITION", points}}}, {"mode", 5}, {"targets", {{{"POSITION", points}}}}};
    Json nodes = Json::array(), roots = Json::array();
    for (int i = 0; i < 5000; ++i) {
        nodes.push_back({{"mesh", 0}});
        roots.push_back(i);
    }
    draft.json["nodes"] = nodes;
    draft.json["scenes"][0]["nodes"] = roots;
    write_text(folder / "many.gltf", draft.to_text());
    expect_refused(folder / "many.gltf", "mesh \"mesh0\"", "too many bytes for its size");
}

/// Numbers of the JSON replaced by others, as in GltfBadFile: an answer each time, never a crash.
TEST(GltfBadDeformFiles, LyingNumbersLoadOrAreRefused) {
    const ScratchFolder folder;
    GltfDraft base = deform_draft();
    base.set_length();
    const std::vector<Json> lies = {-1, 0, 1, 2, 3, 255, 2147483647, 4294967296ll, 0.5, "1", nullptr, Json::array()};
    const Json flat = base.json.flatten();
    int tried = 0, refused = 0;
    for (const auto& [place, value] : flat.items()) {
        for (const Json& lie : lies) {
            GltfDraft draft = base;
            draft.json[Json::json_pointer(place)] = lie;
            write_text(folder / "lie.gltf", draft.to_text());
            Scene scene;
            ++tried;
            const Refusal found = find_refusal([&] { append_gltf(folder / "lie.gltf", scene, no_index, 0); });
            if (found.message.empty()) continue;
            EXPECT_EQ(found.file, (folder / "lie.gltf").string());
            ++refused;
        }
    }
    EXPECT_GT(tried, 2000);
    EXPECT_GT(refused, tried / 2);
}

}  // namespace
}  // namespace aleph
