// Broken and hostile glTF files: skins, morph targets, sparse values, cubic keys, instances, animation pointers.

#include "tests/engine/gltf/bad_change.h"
#include "tests/support/files/gltf_bad_input.h"
#include "tests/support/files/gltf_deform_draft.h"

namespace aleph {
namespace {

class GltfBadDeform : public testing::TestWithParam<BadChange> {};

TEST_P(GltfBadDeform, IsRefused) {
    const ScratchFolder folder;
    GltfDraft draft = deform_draft();
    draft.set_length();
    GetParam().change(draft);
    write_text(folder / "bad.gltf", draft.to_text());
    expect_refused(folder / "bad.gltf", GetParam().place, GetParam().reason);
}

void put_float(GltfDraft& d, std::size_t accessor, std::size_t element, float value) {
    const Json& view = d.json["bufferViews"][d.json["accessors"][accessor]["bufferView"].get<std::size_t>()];
    std::memcpy(&d.buffer.at(view["byteOffset"].get<std::size_t>() + 4 * element), &value, 4);
}
std::uint8_t& sparse_byte(GltfDraft& d, std::size_t i) {
    const Json& sparse = d.json["accessors"][8]["sparse"]["indices"];
    return d.buffer.at(d.json["bufferViews"][sparse["bufferView"].get<std::size_t>()]["byteOffset"].get<std::size_t>() +
                       i);
}
std::uint8_t& joint_byte(GltfDraft& d, std::size_t i) {
    return d.buffer.at(d.json["bufferViews"][d.json["accessors"][2]["bufferView"].get<std::size_t>()]["byteOffset"]
                           .get<std::size_t>() +
                       i);
}
Json& skinned(GltfDraft& d) {
    return d.json["meshes"][0]["primitives"][0];
}
Json& morphed(GltfDraft& d) {
    return d.json["meshes"][1]["primitives"][0];
}
Json& sparse(GltfDraft& d) {
    return d.json["accessors"][8]["sparse"];
}
Json& instancing(GltfDraft& d) {
    return d.json["nodes"][4]["extensions"]["EXT_mesh_gpu_instancing"];
}
Json& pointer(GltfDraft& d) {
    return d.json["animations"][2]["channels"][0]["target"]["extensions"]["KHR_animation_pointer"]["pointer"];
}

const std::string instancing_place = "/nodes/4/extensions/EXT_mesh_gpu_instancing";
const std::string pointer_place = "/animations/2/channels/0/target/extensions/KHR_animation_pointer/pointer";

const std::vector<BadChange> bad_skins = {
    BAD("Joints", "/skins/0", "\"joints\" is missing", d.json["skins"][0].erase("joints")),
    SET("JointsEmpty", "/skins/0/joints", "must not be empty", Json::array()),
    SET("JointRange", "/skins/0/joints/1", "no node 99", 99),
    SET("JointTwice", "/skins/0/joints/1", "listed twice", 1),
    BAD("JointOutsideTheScene", "/skins/0/joints/0", "node 1 is not in the scene",
        d.json["scenes"][0]["nodes"] = {0, 3, 4}),
    BAD("JointsWithoutCommonRoot", "/skins/0/joints/1", "below one root", d.json["nodes"][1].erase("children");
        d.json["scenes"][0]["nodes"] = {0, 1, 2, 3, 4}),
    SET("Skeleton", "/skins/0/skeleton", "no node 7", 7),
    SET("BindsRange", "/skins/0/inverseBindMatrices", "no accessor 99", 99),
    SET("BindsType", "/skins/0/inverseBindMatrices", "float MAT4", 1),
    BAD("BindsTooFew", "/skins/0/inverseBindMatrices", "1 inverse bind matrices for 2 joints",
        d.json["accessors"][4]["count"] = 1),
    BAD("BindsNotAffine", "/skins/0/inverseBindMatrices", "matrix 1 is not affine", put_float(d, 4, 16 + 3, 0.5f)),
    BAD("BindsNaN", "/accessors/4", "element 0 is nan", put_float(d, 4, 5, float_nan)),
    SET("NodeSkinRange", "/nodes/0/skin", "no skin 1", 1),
    BAD("NodeSkinWithoutMesh", "/nodes/0/skin", "needs a mesh", d.json["nodes"][0].erase("mesh")),
    BAD("NodeSkinOfRigidMesh", "/meshes/1/primitives/0/attributes", "no JOINTS_0", d.json["nodes"][0]["mesh"] = 1),
    BAD("JointsWithoutWeights", "/meshes/0/primitives/0/attributes", "must stand together",
        skinned(d)["attributes"].erase("WEIGHTS_0")),
    BAD("SecondSetAlone", "/meshes/0/primitives/0/attributes", "JOINTS_1 without JOINTS_0",
        skinned(d)["attributes"]["JOINTS_1"] = 2;
        skinned(d)["attributes"]["WEIGHTS_1"] = 3; skinned(d)["attributes"].erase("JOINTS_0");
        skinned(d)["attributes"].erase("WEIGHTS_0")),
    SET("JointsAreFloats", "/meshes/0/primitives/0/attributes/JOINTS_0", "unsigned integers", 3),
    SET("WeightsAreIntegers", "/meshes/0/primitives/0/attributes/WEIGHTS_0", "normalized", 2),
    BAD("JointIndexRange", "/accessors/2", "element 1 is joint index 7, there are 2", joint_byte(d, 8) = 7),
    BAD("JointIndexHuge", "/accessors/2", "joint index 65280", joint_byte(d, 1) = 255),
    BAD("WeightNegative", "/accessors/3", "must not be negative", put_float(d, 3, 0, -1.0f)),
    BAD("WeightNaN", "/accessors/3", "element 0 is nan", put_float(d, 3, 0, float_nan)),
    BAD("WeightInfinite", "/accessors/3", "element 2 is inf", put_float(d, 3, 8, float_infinity)),
};

const std::vector<BadChange> bad_morphs = {
    SET("TargetsEmpty", "/meshes/1/primitives/0/targets", "must not be empty", Json::array()),
    SET("TargetNotObject", "/meshes/1/primitives/0/targets/0", "must be an object", 6),
    SET("TargetRange", "/meshes/1/primitives/0/targets/0/POSITION", "no accessor 99", 99),
    SET("TargetType", "/meshes/1/primitives/0/targets/0/POSITION", "float VEC3", 3),
    BAD("TargetCount", "/meshes/1/primitives/0/targets/0/NORMAL", "2 elements, POSITION has 3",
        d.json["accessors"][7]["count"] = 2),
    BAD("TargetWithoutBase", "/meshes/1/primitives/0/targets/0/NORMAL", "itself has no NORMAL",
        morphed(d)["attributes"].erase("NORMAL")),
    BAD("TargetNaN", "/accessors/6", "element 2 is nan", put_float(d, 6, 8, float_nan)),
    BAD("TargetsUnequal", "/meshes/1/primitives/1", "1 morph targets, the mesh's first primitive has 2",
        Json other = morphed(d);
        other["targets"].erase(1); d.json["meshes"][1]["primitives"].push_back(other)),
    SET("KF29_MeshWeightCount", "/meshes/1/weights", "3 weights for 2 morph targets", {0, 0, 0}),
    SET("KF29_NodeWeightCount", "/nodes/3/weights", "1 weights for 2 morph targets", {0}),
    SET("WeightText", "/meshes/1/weights/1", "must be a number", "1"),
    SET("WeightHuge", "/meshes/1/weights/1", "within", 1e300),
    SET("WeightsWithoutMesh", "/nodes/1/weights", "without a mesh", {1}),
    BAD("KF29_WeightKeyCount", "/animations/0/samplers/0/output", "3 values for 2 key times, expected 4",
        d.json["accessors"][10]["count"] = 3),
    SET("WeightKeysAreVectors", "/animations/0/samplers/0/output", "SCALAR", 6),
    BAD("WeightKeysOfRigidNode", "/animations/0/channels/0/target/path", "node 0 has no morph targets",
        d.json["animations"][0]["channels"][0]["target"]["node"] = 0),
    BAD("CubicKeyCount", "/animations/1/samplers/0/output", "5 values for 2 key times, expected 6",
        d.json["accessors"][12]["count"] = 5),
    BAD("KF05_CubicKeyZero", "/animations/1/samplers/0: node 2 \"node2\" key 1", "is zero", put_float(d, 12, 18, 0.0f)),
};

const std::vector<BadChange> bad_sparse = {
    SET("CountZero", "/accessors/8/sparse/count", "must lie within", 0),
    SET("CountBeyond", "/accessors/8/sparse/count", "must lie within 1 and 3", 4),
    SET("CountGigabytes", "/accessors/8/sparse/count", "must lie within", 2147483647),
    BAD("IndicesMissing", "/accessors/8/sparse", "\"indices\" is missing", sparse(d).erase("indices")),
    BAD("ValuesMissing", "/accessors/8/sparse", "\"values\" is missing", sparse(d).erase("values")),
    SET("IndicesFloat", "/accessors/8/sparse/indices/componentType", "unsigned integers", 5126),
    SET("IndicesView", "/accessors/8/sparse/indices/bufferView", "no buffer view 99", 99),
    BAD("IndicesBeyondView", "/accessors/8/sparse/indices", "2 elements need 8 bytes",
        sparse(d)["indices"]["componentType"] = 5125),
    BAD("IndicesOffset", "/accessors/8/sparse/indices", "the view has 2", sparse(d)["indices"]["byteOffset"] = 1),
    BAD("IndicesOffsetHuge", "/accessors/8/sparse/indices", "the view has 2",
        sparse(d)["indices"]["byteOffset"] = 2147483647),
    BAD("IndicesStrided", "/accessors/8/sparse/indices/bufferView", "byteStride",
        Json& view = d.json["bufferViews"][sparse(d)["indices"]["bufferView"].get<std::size_t>()];
        view["byteStride"] = 4; view["byteLength"] = 8),
    SET("ValuesView", "/accessors/8/sparse/values/bufferView", "no buffer view -1", -1),
    BAD("ValuesBeyondView", "/accessors/8/sparse/values", "2 elements need 24 bytes",
        sparse(d)["values"]["byteOffset"] = 4),
    BAD("ValuesUnaligned", "/accessors/8/sparse/values", "no multiple", sparse(d)["values"]["byteOffset"] = 2),
    BAD("IndexBeyond", "/accessors/8/sparse/indices", "index 1 is 3, the accessor has 3", sparse_byte(d, 1) = 3),
    BAD("IndexTwice", "/accessors/8/sparse/indices", "must strictly increase", sparse_byte(d, 0) = 2),
    BAD("IndicesUnsorted", "/accessors/8/sparse/indices", "must strictly increase", sparse_byte(d, 0) = 2;
        sparse_byte(d, 1) = 1),
    SET("CountWithoutView", "/accessors/8/count", "without a buffer view", 100000000),
};

const std::vector<BadChange> bad_instances = {
    BAD("Attributes", instancing_place, "\"attributes\" is missing", instancing(d).erase("attributes")),
    SET("NoAttribute", instancing_place + "/attributes", "no attribute", Json::object()),
    SET("AttributeRange", instancing_place + "/attributes/SCALE", "no accessor 99", 99),
    SET("AttributeType", instancing_place + "/attributes/TRANSLATION", "float VEC3", 3),
    BAD("RotationType", instancing_place + "/attributes/ROTATION", "VEC4",
        instancing(d)["attributes"] = {{"ROTATION", 6}}),
    BAD("CountsUnequal", instancing_place + "/attributes/TRANSLATION", "2 elements, other instance attributes have 3",
        instancing(d)["attributes"]["SCALE"] = 6),
    BAD("WithoutMesh", instancing_place, "without a mesh", d.json["nodes"][4].erase("mesh")),
    BAD("Skinned", instancing_place, "skinned mesh cannot", d.json["nodes"][4].update({{"mesh", 0}, {"skin", 0}})),
    BAD("ZeroRotation", instancing_place + "/attributes/ROTATION: instance 0", "is zero",
        instancing(
            d)["attributes"] = {{"ROTATION", d.add_accessor<std::int8_t>({0, 0, 0, 0, 0, 0, 0, 1}, "VEC4", 4, true)}};
        d.json["buffers"][0]["byteLength"] = d.buffer.size()),
    SET("PointerNotText", pointer_place, "must be a string", 7),
    SET("PointerEmpty", pointer_place, "no JSON pointer", ""),
    SET("PointerRelative", pointer_place, "no JSON pointer", "materials/0/emissiveFactor"),
    SET("PointerToNothing", pointer_place, "leads to nothing", "/materials/1/emissiveFactor"),
    SET("PointerToNoCamera", pointer_place, "leads to nothing", "/cameras/0/perspective/yfov"),
    BAD("PointerType", "/animations/2/samplers/0/output", "must be a VEC4 accessor",
        pointer(d) = "/materials/0/pbrMetallicRoughness/baseColorFactor"),
    BAD("PointerAndNode", "/animations/2/channels/0/target/path", "either a node or a pointer",
        d.json["animations"][2]["channels"][0]["target"]["node"] = 0),
    BAD("VisibilityKeysAreFloats", "/animations/2/samplers/0/output", "8-bit unsigned integers",
        pointer(d) = "/nodes/0/extensions/KHR_node_visibility/visible";
        d.json["animations"][2]["samplers"][0].update({{"output", 9}, {"interpolation", "STEP"}})),
};

INSTANTIATE_TEST_SUITE_P(Skins, GltfBadDeform, testing::ValuesIn(bad_skins), bad_name);
INSTANTIATE_TEST_SUITE_P(Morphs, GltfBadDeform, testing::ValuesIn(bad_morphs), bad_name);
INSTANTIATE_TEST_SUITE_P(Sparse, GltfBadDeform, testing::ValuesIn(bad_sparse), bad_name);
INSTANTIATE_TEST_SUITE_P(Instances, GltfBadDeform, testing::ValuesIn(bad_instances), bad_name);

}  // namespace
}  // namespace aleph
