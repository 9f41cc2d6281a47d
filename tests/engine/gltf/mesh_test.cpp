// glTF reader: how vertices become triangles, and where their values come from.
#include "tests/engine/gltf/fixture.h"

namespace aleph {
namespace {

using GltfMesh = GltfFixture;
using Triangles = std::vector<glm::uvec3>;

/// Six vertices; only their order is tested.
GltfDraft six_vertices(int mode) {
    GltfDraft draft = triangle_draft();
    std::vector<float> points;
    for (int i = 0; i < 6; ++i) points.insert(points.end(), {float(i), float(i * i), 0.0f});
    draft.primitive() = {{"attributes", {{"POSITION", draft.add_accessor(points, "VEC3", 3)}}}, {"mode", mode}};
    return draft;
}

TEST_F(GltfMesh, TrianglesStripsAndFansWithoutIndices) {
    EXPECT_EQ(load(six_vertices(4)).meshes[0].triangles, (Triangles{{0, 1, 2}, {3, 4, 5}}));
    // glTF 2.0, 3.7.2.1: {v_i, v_i+(1+i%2), v_i+(2-i%2)}, and {v_i+1, v_i+2, v_0}.
    EXPECT_EQ(load(six_vertices(5)).meshes[0].triangles, (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}}));
    EXPECT_EQ(load(six_vertices(6)).meshes[0].triangles, (Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}, {4, 5, 0}}));
}

TEST_F(GltfMesh, StripsAndFansWithIndices) {
    GltfDraft strip = six_vertices(5), fan = six_vertices(6);
    // A repeated index starts anew: triangles that have it twice are left out, and still count for the order.
    strip.primitive()["indices"] = strip.add_accessor<std::uint8_t>({5, 4, 3, 3, 2, 1}, "SCALAR", 1);
    EXPECT_EQ(load(strip).meshes[0].triangles, (Triangles{{5, 4, 3}, {3, 1, 2}}));
    fan.primitive()["indices"] = fan.add_accessor<std::uint16_t>({5, 0, 1, 2}, "SCALAR", 1);
    EXPECT_EQ(load(fan).meshes[0].triangles, (Triangles{{0, 1, 5}, {1, 2, 5}}));
}

TEST_F(GltfMesh, PointsAndLinesAreLeftOutWithOneWarning) {
    for (const int mode : {0, 1, 2, 3}) {
        GltfDraft draft = six_vertices(mode);
        const Json line = draft.primitive();
        draft.json["meshes"][0]["primitives"] = {line, {{"attributes", {{"POSITION", 1}}}, {"indices", 0}}, line};
        const Scene scene = load(draft);
        ASSERT_EQ(scene.meshes.size(), 1u);
        EXPECT_EQ(scene.meshes[0].name, "mesh0.1");
        EXPECT_EQ(scene.nodes[0].meshes, std::vector<int>{0});
        EXPECT_TRUE(
            has_warning(scene, "/meshes/0/primitives/0: points and lines are not drawn (2 primitives left out)"));
        EXPECT_EQ(scene.source.warnings.size(), 1u);
    }
}

/// Accessor `index` gets sparse values. @param has_base  keeps its own view
void make_sparse(GltfDraft& draft, int index, const Bytes& at, const std::vector<float>& values, bool has_base) {
    Bytes bytes(values.size() * sizeof(float));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    Json& accessor = draft.json["accessors"][index];
    const int index_view = draft.add_view(at), value_view = draft.add_view(bytes);
    accessor["sparse"] = {{"count", at.size()},
                          {"indices", {{"bufferView", index_view}, {"componentType", 5121}}},
                          {"values", {{"bufferView", value_view}}}};
    if (!has_base) accessor.erase("bufferView");
}

TEST_F(GltfMesh, S12_10_SparseIsAppliedOnItsBase) {
    GltfDraft draft = triangle_draft();
    make_sparse(draft, 1, {1, 2}, {7, 8, 9, -1, -2, -3}, true);
    EXPECT_EQ(load(draft).meshes[0].positions, (std::vector<glm::vec3>{{0, 0, 0}, {7, 8, 9}, {-1, -2, -3}}));
}

TEST_F(GltfMesh, S12_10_SparseIsAppliedOnZeros) {
    GltfDraft draft = triangle_draft();
    make_sparse(draft, 1, {2}, {7, 8, 9}, false);
    EXPECT_EQ(load(draft).meshes[0].positions, (std::vector<glm::vec3>{{0, 0, 0}, {0, 0, 0}, {7, 8, 9}}));
    EXPECT_TRUE(load(draft).source.warnings.empty());
    draft.json["accessors"][1]["byteOffset"] = 0;  // as in box_sparse.glb
    EXPECT_TRUE(has_warning(load(draft), "/accessors/1: byteOffset means nothing without a bufferView"));
}

TEST_F(GltfMesh, S12_10_SparseIndicesWithoutAView) {
    GltfDraft draft = triangle_draft();
    Json& indices = draft.json["accessors"][0];
    indices.erase("bufferView");
    indices["sparse"] = {{"count", 2},
                         {"indices", {{"bufferView", draft.add_view({1, 2})}, {"componentType", 5121}}},
                         {"values", {{"bufferView", draft.add_view({1, 0, 2, 0})}}}};
    EXPECT_EQ(load(draft).meshes[0].triangles, (Triangles{{0, 1, 2}}));
    // A sparse value replaces an index that is out of range.
    GltfDraft mended = triangle_draft();
    mended.buffer[4] = 200;
    mended.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", mended.add_view({2})}, {"componentType", 5121}}},
        {"values", {{"bufferView", mended.add_view({2, 0})}}}};
    EXPECT_EQ(load(mended).meshes[0].triangles, (Triangles{{0, 1, 2}}));
}

TEST_F(GltfMesh, QuantizedAttributes) {
    GltfDraft draft = triangle_draft();
    draft.json["extensionsUsed"] = draft.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    // Vectors of three bytes or shorts are padded to multiples of 4 bytes.
    const auto add = [&](const Bytes& bytes, int stride, int type, const char* shape, bool normalized) {
        const int view = draft.add_view(bytes, stride);
        draft.json["accessors"].push_back(
            {{"bufferView", view}, {"componentType", type}, {"count", 3}, {"type", shape}, {"normalized", normalized}});
        return static_cast<int>(draft.json["accessors"].size()) - 1;
    };
    draft.primitive()["attributes"] = {
        {"POSITION", add({0, 0, 0, 9, 255, 0, 0, 9, 0, 5, 0, 9}, 4, 5121, "VEC3", false)},
        {"NORMAL", add({0, 0, 127, 0, 0, 0, 129, 0, 128, 0, 0, 0}, 4, 5120, "VEC3", true)},
        {"TEXCOORD_0", add({0, 2, 1, 0, 0xff, 0xff, 0, 0, 0, 0, 0, 0}, 4, 5122, "VEC2", false)}};
    const Mesh mesh = load(draft).meshes[0];
    EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{0, 0, 0}, {255, 0, 0}, {0, 5, 0}}));
    EXPECT_EQ(mesh.normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 0, -1}, {-1, 0, 0}}));  // -128 counts as -127
    EXPECT_EQ(mesh.uv[0], (std::vector<glm::vec2>{{512, 1}, {-1, 0}, {0, 0}}));
    draft.json.erase("extensionsUsed");
    draft.json.erase("extensionsRequired");
    EXPECT_THROW(load(draft), InputError);
}

}  // namespace
}  // namespace aleph
