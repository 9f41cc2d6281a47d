#pragma once
// Drafts of glTF files whose mesh deforms.

#include "tests/support/files/gltf_draft.h"

namespace aleph {

/// Adds an accessor of three vectors that are zero but for these. @param values  at these indices
inline void add_sparse(GltfDraft& draft, const Bytes& indices, const std::vector<float>& values) {
    Bytes bytes(values.size() * sizeof(float));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    const int index_view = draft.add_view(indices), value_view = draft.add_view(bytes);
    draft.json["accessors"].push_back({{"componentType", 5126},
                                       {"count", 3},
                                       {"type", "VEC3"},
                                       {"sparse",
                                        {{"count", indices.size()},
                                         {"indices", {{"bufferView", index_view}, {"componentType", 5121}}},
                                         {"values", {{"bufferView", value_view}}}}}});
}

/// Adds normals and two morph targets, the second sparse without a base, to a primitive. Accessors that follow:
/// normals, positions and normals of target 0, positions of target 1.
inline void add_targets(GltfDraft& draft, Json& primitive, const Bytes& indices, const std::vector<float>& values) {
    const int normals = draft.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
    const int moves = draft.add_accessor<float>({0, 0, 1, 0, 0, 2, 0, 0, 3}, "VEC3", 3);
    const int turns = draft.add_accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 0}, "VEC3", 3);
    add_sparse(draft, indices, values);
    primitive["attributes"]["NORMAL"] = normals;
    primitive["targets"] = {{{"POSITION", moves}, {"NORMAL", turns}}, {{"POSITION", turns + 1}}};
}

/// triangle_draft with the targets; accessors from 2 on.
inline GltfDraft morph_draft() {
    GltfDraft draft = triangle_draft();
    Json primitive = draft.primitive();
    add_targets(draft, primitive, {0}, {4, 0, 0});
    draft.primitive() = primitive;
    return draft;
}

/// triangle_draft under two joints: vertex 0 on joint 0, vertex 1 on both, vertex 2 on joint 1. Accessors from 2 on:
/// joints, weights, inverse binds. Nodes: 0 the mesh, 1 and 2 the joints.
inline GltfDraft skin_draft() {
    GltfDraft draft = triangle_draft();
    Json& attributes = draft.primitive()["attributes"];
    attributes["JOINTS_0"] = draft.add_accessor<std::uint16_t>({0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
    attributes["WEIGHTS_0"] = draft.add_accessor<float>({1, 0, 0, 0, 0.25f, 0.75f, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
    const int binds = draft.add_accessor<float>(
        {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1}, "MAT4", 16);
    draft.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", binds}}};
    draft.json["nodes"] = {
        {{"mesh", 0}, {"skin", 0}}, {{"children", {2}}}, {{"translation", {0, 1, 0}}, {"rotation", {0, 0, 0, 1}}}};
    draft.json["scenes"][0]["nodes"] = {0, 1};
    return draft;
}

/// Both deformations, cubic keys, an instanced node and a pointer. Nodes: 0 skinned, 1 and 2 joints, 3 morphed, 4
/// instanced. Accessors: 2 joints, 3 weights, 4 binds, 5 normals, 6 and 7 target 0, 8 target 1 (sparse, without a
/// view), 9 and 10 weight keys, 11 and 12 rotation keys, 13 and 14 material keys, 15 instances.
inline GltfDraft deform_draft() {
    GltfDraft draft = skin_draft();
    const Json skinned = draft.primitive();
    Json morphed = {{"attributes", {{"POSITION", 1}}}};
    add_targets(draft, morphed, {0, 2}, std::vector<float>(6));
    draft.json["meshes"] = {{{"primitives", {skinned}}}, {{"primitives", {morphed}}, {"weights", {0, 1}}}};
    draft.animate(3, "weights", {0, 1}, {0, 0, 1, 1});
    draft.animate(2, "rotation", {0, 1}, {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0},
                  "CUBICSPLINE");
    draft.json["materials"] = {Json::object()};
    draft.animate_pointer("/materials/0/emissiveFactor", {0, 1}, {0, 0, 0, 1, 1, 1});
    const int places = draft.add_accessor<float>({0, 0, 0, 1, 0, 0}, "VEC3", 3);
    draft.json["nodes"].push_back({{"mesh", 1}, {"weights", {0, 1}}});
    draft.json["nodes"].push_back(
        {{"mesh", 1}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}});
    draft.json["scenes"][0]["nodes"] = {0, 1, 3, 4};
    return draft;
}

}  // namespace aleph
