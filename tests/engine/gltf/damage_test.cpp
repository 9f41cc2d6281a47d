// glTF files with random damage, and with instances or morphed meshes that multiply.

#include "tests/support/files/gltf_bad_input.h"
#include "tests/support/files/gltf_deform_draft.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

class GltfDamage : public testing::Test {
  protected:
    ScratchFolder folder_;
};

/// Every way to cut the file, and thousands of random damages: an answer each time, never a crash. The same twice.
TEST_F(GltfDamage, S13_10_DamagedFilesLoadOrAreRefused) {
    const Bytes good = textured_draft(folder_, false).to_glb();
    const fs::path path = folder_ / "damaged.glb";
    const auto verdict = [&](const Bytes& bytes) {
        write_bytes(path, bytes);
        Scene scene;
        const Refusal found = find_refusal([&] { append_gltf(path, scene, no_index, 0); });
        if (!found.message.empty()) {
            EXPECT_EQ(found.file, path.string());
        }
        return found.message;
    };
    ASSERT_EQ(verdict(good), "");
    for (std::size_t length = 0; length < good.size(); length += 7) {
        Bytes cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length));
        EXPECT_NE(verdict(cut), "") << length;
    }
    std::mt19937 random(7);
    int refused = 0;
    for (int i = 0; i < 2000; ++i) {
        Bytes bytes = good;
        const int changes = 1 + static_cast<int>(random() % 4);
        for (int k = 0; k < changes; ++k) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
        const std::string first = verdict(bytes);
        if (!first.empty()) ++refused;
        if (i % 50 == 0) {
            EXPECT_EQ(verdict(bytes), first);
        }
    }
    EXPECT_GT(refused, 500);
}

TEST_F(GltfDamage, TheDraftOfDeformationsItselfLoads) {
    write_text(folder_ / "draft.gltf", deform_draft().to_text());
    Scene scene;
    append_gltf(folder_ / "draft.gltf", scene, no_index, 0);
    EXPECT_TRUE(scene.source.warnings.empty()) << scene.source.warnings[0];
    EXPECT_EQ(scene.nodes.size(), 7u);
    EXPECT_EQ(scene.meshes.size(), 4u);  // the skinned one, and the morphed one for each of three nodes
}

TEST_F(GltfDamage, S13_4_InstancesThatMultiplyAreLimited) {
    GltfDraft draft = triangle_draft();
    const int places = draft.add_accessor(std::vector<float>(300000, 0.0f), "VEC3", 3);
    repeat_node(
        draft, 1000,
        {{"mesh", 0}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}});
    write_text(folder_ / "many.gltf", draft.to_text());
    Scene scene;
    const Refusal found = find_refusal([&] { append_gltf(folder_ / "many.gltf", scene, no_index, 0); });
    EXPECT_NE(found.reason.find("too many bytes for its size"), std::string::npos) << found.message;
}

TEST_F(GltfDamage, S13_4_MorphedMeshUnderManyNodesIsLimited) {
    GltfDraft draft = triangle_draft();
    const int points = draft.add_accessor(std::vector<float>(30000, 1.0f), "VEC3", 3);
    draft.primitive() = {{"attributes", {{"POSITION", points}}}, {"mode", 5}, {"targets", {{{"POSITION", points}}}}};
    repeat_node(draft, 5000, {{"mesh", 0}});
    write_text(folder_ / "many.gltf", draft.to_text());
    expect_refused(folder_ / "many.gltf", "mesh \"mesh0\"", "too many bytes for its size");
}

}  // namespace
}  // namespace aleph
