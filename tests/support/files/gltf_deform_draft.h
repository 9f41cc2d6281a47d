#pragma once
// Drafts of glTF files whose mesh deforms.

#include "tests/support/files/gltf_draft.h"

namespace aleph {

/// triangle_draft with normals and two morph targets, the second sparse without a base. Accessors from 2 on: normals,
/// positions and normals of target 0, positions of target 1.
inline GltfDraft morph_draft() {
    GltfDraft draft = triangle_draft();
    draft.primitive()["attributes"]["NORMAL"] = draft.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
    const int positions = draft.add_accessor<float>({0, 0, 1, 0, 0, 2, 0, 0, 3}, "VEC3", 3);
    const int normals = draft.add_accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 0}, "VEC3", 3);
    const float x = 4.0f;
    Bytes value(12);
    std::memcpy(value.data(), &x, sizeof x);
    const int index_view = draft.add_view({0}), value_view = draft.add_view(value);
    draft.json["accessors"].push_back({{"componentType", 5126},
                                       {"count", 3},
                                       {"type", "VEC3"},
                                       {"sparse",
                                        {{"count", 1},
                                         {"indices", {{"bufferView", index_view}, {"componentType", 5121}}},
                                         {"values", {{"bufferView", value_view}}}}}});
    draft.primitive()["targets"] = {{{"POSITION", positions}, {"NORMAL", normals}}, {{"POSITION", normals + 1}}};
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

}  // namespace aleph
