#pragma once
// The glTF file that the tests of broken deformations change.

#include "tests/support/files/gltf_deform_draft.h"

namespace aleph {

/// Both deformations, cubic keys, an instanced node and a pointer. Nodes: 0 skinned, 1 and 2 joints, 3 morphed, 4
/// instanced. Accessors: 2 joints, 3 weights, 4 binds, 5 normals, 6 and 7 target 0, 8 target 1 (sparse, without a
/// view), 9 and 10 weight keys, 11 and 12 rotation keys, 13 and 14 material keys, 15 instances.
inline GltfDraft deform_draft() {
    GltfDraft draft = skin_draft();
    const Json skinned = draft.primitive();
    const int normals = draft.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
    const int moves = draft.add_accessor<float>({0, 0, 1, 0, 0, 2, 0, 0, 3}, "VEC3", 3);
    const int turns = draft.add_accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 0}, "VEC3", 3);
    const int at = draft.add_view({0, 2}), values = draft.add_view(Bytes(24));
    draft.json["accessors"].push_back({{"componentType", 5126},
                                       {"count", 3},
                                       {"type", "VEC3"},
                                       {"sparse",
                                        {{"count", 2},
                                         {"indices", {{"bufferView", at}, {"componentType", 5121}}},
                                         {"values", {{"bufferView", values}}}}}});
    Json morphed = {{"attributes", {{"POSITION", 1}, {"NORMAL", normals}}}};
    morphed["targets"] = {{{"POSITION", moves}, {"NORMAL", turns}}, {{"POSITION", turns + 1}}};
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
