// Broken and hostile glTF files: structure and data that break one rule each must end in an InputError with its place.

#include "tests/engine/gltf/bad_change.h"
#include "tests/support/files/gltf_bad_input.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

TEST(GltfBadInput, TheDraftsThemselvesLoad) {
    const ScratchFolder folder;
    int i = 0;
    for (GltfDraft draft : {full_draft(), textured_draft(folder, true), textured_draft(folder, false)}) {
        const fs::path path = folder / (std::to_string(i++) + ".gltf");
        write_text(path, draft.to_text());
        Scene scene;
        append_gltf(path, scene, no_index, 0);
        // The keys turn by 180 degrees on purpose; there is no other warning.
        ASSERT_EQ(scene.source.warnings.size(), 1u);
        EXPECT_NE(scene.source.warnings[0].find("180.0 degrees"), std::string::npos) << scene.source.warnings[0];
    }
}

TEST_P(GltfBadJson, IsRefused) {
    const ScratchFolder folder;
    GltfDraft draft = textured_draft(folder, false);
    draft.set_length();
    GetParam().change(draft);
    const fs::path path = folder / "bad.gltf";
    write_text(path, draft.to_text());
    expect_refused(path, GetParam().place, GetParam().reason);
}

const Json& huge_index() {
    static const Json value = std::uint64_t{1} << 32;
    return value;
}

const std::vector<BadChange> bad_structure = {
    BAD("AssetMissing", "", "\"asset\" is missing", d.json.erase("asset")),
    BAD("VersionMissing", "/asset", "\"version\" is missing", d.json["asset"] = Json::object()),
    BAD("VersionOne", "/asset/version", "\"1.0\"", d.json["asset"]["version"] = "1.0"),
    BAD("VersionThree", "/asset/version", "\"3.0\"", d.json["asset"]["version"] = "3.0"),
    BAD("VersionNumber", "/asset/version", "must be a string", d.json["asset"]["version"] = 2.0),
    BAD("VersionNamedWithControlBytes", "/asset/version", "\\x1b[2J", d.json["asset"]["version"] = "\x1b[2J"),
    BAD("MinVersion", "/asset/minVersion", "2.1", d.json["asset"]["minVersion"] = "2.1"),
    BAD("RequiredUnknown", "/extensionsRequired/0", "VENDOR_x", d.json["extensionsRequired"] = {"VENDOR_x"}),
    BAD("RequiredDispersion", "/extensionsRequired/0", "KHR_materials_dispersion",
        d.json["extensionsRequired"] = {"KHR_materials_dispersion"}),
    BAD("RequiredNotText", "/extensionsRequired/0", "must be a string", d.json["extensionsRequired"] = {1}),
    BAD("UsedNotArray", "/extensionsUsed", "must be an array", d.json["extensionsUsed"] = "KHR_x"),
    BAD("Draco", "extensions", "KHR_draco_mesh_compression",
        d.primitive()["extensions"]["KHR_draco_mesh_compression"] = Json::object()),
    BAD("Meshopt", "extensions", "EXT_meshopt_compression",
        d.json["bufferViews"][1]["extensions"]["EXT_meshopt_compression"] = Json::object()),
    BAD("TransmissionText", "/materials/0/extensions/KHR_materials_transmission/transmissionFactor", "must be a number",
        d.json["materials"][0]["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = "1"),
    BAD("UnlitNotObject", "/materials/0/extensions/KHR_materials_unlit", "must be an object",
        d.json["materials"][0]["extensions"]["KHR_materials_unlit"] = true),
    BAD("VisibilityNumber", "/nodes/1/extensions/KHR_node_visibility/visible", "true or false",
        d.json["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = 0),

    BAD("NodesNotArray", "/nodes", "must be an array", d.json["nodes"] = Json::object()),
    BAD("NodeNotObject", "/nodes/2", "must be an object", d.json["nodes"][2] = 7),
    BAD("NodeNameNumber", "/nodes/0/name", "must be a string", d.json["nodes"][0]["name"] = 5),
    BAD("S13_3_NodeMeshRange", "/nodes/1/mesh", "no mesh 1", d.json["nodes"][1]["mesh"] = 1),
    BAD("S12_8_NodeMeshNegative", "/nodes/1/mesh", "no mesh -4", d.json["nodes"][1]["mesh"] = -4),
    BAD("S13_2_NodeMeshFraction", "/nodes/1/mesh", "must be an integer, found 0.5", d.json["nodes"][1]["mesh"] = 0.5),
    BAD("S12_8_NodeMeshWholeFloat", "/nodes/1/mesh", "must be an integer", d.json["nodes"][1]["mesh"] = 0.0),
    BAD("S12_8_NodeMeshText", "/nodes/1/mesh", "must be an integer", d.json["nodes"][1]["mesh"] = "0"),
    BAD("S12_7_NodeMeshTwoTo32", "/nodes/1/mesh", "no mesh 4294967296", d.json["nodes"][1]["mesh"] = huge_index()),
    BAD("S12_7_NodeMeshTwoTo63", "/nodes/1/mesh", "must lie within",
        d.json["nodes"][1]["mesh"] = std::uint64_t{1} << 63),
    BAD("NodeCamera", "/nodes/2/camera", "no camera 3", d.json["nodes"][2]["camera"] = 3),
    BAD("NodeLight", "/nodes/2/extensions/KHR_lights_punctual/light", "no light 1",
        d.json["nodes"][2]["extensions"]["KHR_lights_punctual"]["light"] = 1),
    BAD("NodeSkin", "/nodes/1/skin", "no skin 0", d.json["nodes"][1]["skin"] = 0),
    BAD("KF29_NodeWeights", "/nodes/1/weights", "1 weights for 0 morph targets", d.json["nodes"][1]["weights"] = {1}),
    BAD("NodeTranslationShort", "/nodes/1/translation", "needs 3 numbers, found 2",
        d.json["nodes"][1]["translation"] = {1, 2}),
    BAD("NodeTranslationText", "/nodes/1/translation/1", "must be a number",
        d.json["nodes"][1]["translation"] = {1, "2", 3}),
    BAD("NodeTranslationHuge", "/nodes/1/translation/0", "within", d.json["nodes"][1]["translation"] = {1e19, 0, 0}),
    BAD("KF05_NodeRotationZero", "/nodes/1/rotation", "is zero", d.json["nodes"][1]["rotation"] = {0, 0, 0, 0}),
    BAD("NodeMatrixLength", "/nodes/2/matrix", "needs 16 numbers", d.json["nodes"][2]["matrix"] = {1, 2, 3}),
    BAD("NodeMatrixAndScale", "/nodes/2/matrix", "either a matrix or",
        d.json["nodes"][2].update(
            {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, {"scale", {1, 1, 1}}})),
    BAD("NodeMatrixProjective", "/nodes/2/matrix/11", "not affine",
        d.json["nodes"][2]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -1, 0, 0, 0, 1}),
    BAD("NodeOwnChild", "/nodes/1/children/0", "its own child", d.json["nodes"][1]["children"] = {1}),
    BAD("S13_5_NodeCycle", "/nodes/0", "cycle", d.json["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
        d.json.erase("scenes"); d.json.erase("scene"); d.json.erase("animations")),
    BAD("S13_5_NodeTwoParents", "/nodes/1/children/0", "node 2 has two parents", d.json["nodes"][1]["children"] = {2}),
    BAD("NodeChildTwice", "/nodes/0/children/2", "two parents", d.json["nodes"][0]["children"] = {1, 2, 1}),
    BAD("NodeChildRange", "/nodes/1/children/0", "no node 9", d.json["nodes"][1]["children"] = {9}),
    BAD("SceneRange", "/scene", "no scene 1", d.json["scene"] = 1),
    BAD("SceneNegative", "/scene", "no scene -1", d.json["scene"] = -1),
    BAD("SceneNode", "/scenes/0/nodes/0", "no node 3", d.json["scenes"][0]["nodes"] = {3}),
    BAD("SceneRootHasParent", "/scenes/0/nodes/1", "has a parent", d.json["scenes"][0]["nodes"] = {0, 1}),
    BAD("SceneRootTwice", "/scenes/0/nodes/1", "listed twice", d.json["scenes"][0]["nodes"] = {0, 0}),
};

const std::vector<BadChange> bad_data = {
    BAD("BufferLengthMissing", "/buffers/0", "\"byteLength\" is missing", d.json["buffers"][0].erase("byteLength")),
    BAD("BufferLengthZero", "/buffers/0/byteLength", "must lie within", d.json["buffers"][0]["byteLength"] = 0),
    BAD("BufferLengthHuge", "/buffers/0/byteLength", "must lie within",
        d.json["buffers"][0]["byteLength"] = huge_index()),
    BAD("BufferLongerThanData", "/buffers/0", "the data has", d.json["buffers"][0]["byteLength"] = 2000000000),
    BAD("BufferUriNumber", "/buffers/0/uri", "must be a string", d.json["buffers"][0]["uri"] = 4),
    BAD("BufferWithoutUri", "/buffers/1", "no BIN chunk", d.json["buffers"].push_back({{"byteLength", 4}})),
    BAD("BufferNotBase64", "/buffers/0/uri", "only base64",
        d.json["buffers"][0]["uri"] = "data:application/octet-stream,abc"),
    BAD("BufferBadBase64", "/buffers/0/uri", "is not base64",
        d.json["buffers"][0]["uri"] = "data:application/octet-stream;base64,AA*A"),
    BAD("BufferCutBase64", "/buffers/0/uri", "cut off",
        d.json["buffers"][0]["uri"] = "data:application/octet-stream;base64,AAAAA"),
    BAD("BufferNoComma", "/buffers/0/uri", "no comma", d.json["buffers"][0]["uri"] = "data:;base64"),
    BAD("ViewBuffer", "/bufferViews/0/buffer", "no buffer 1", d.json["bufferViews"][0]["buffer"] = 1),
    BAD("ViewBufferMissing", "/bufferViews/0", "\"buffer\" is missing", d.json["bufferViews"][0].erase("buffer")),
    BAD("S12_1_ViewLengthBeyond", "/bufferViews/0", "lie outside", d.json["bufferViews"][0]["byteLength"] = 100000),
    BAD("ViewOffsetBeyond", "/bufferViews/0", "lie outside", d.json["bufferViews"][0]["byteOffset"] = 2147483647),
    BAD("ViewOffsetNegative", "/bufferViews/0/byteOffset", "must lie within",
        d.json["bufferViews"][0]["byteOffset"] = -4),
    BAD("S13_4_ViewOffsetWraps", "/bufferViews/0/byteOffset", "must lie within",
        d.json["bufferViews"][0]["byteOffset"] = 18446744073709551612ull),
    BAD("ViewLengthZero", "/bufferViews/0/byteLength", "must lie within", d.json["bufferViews"][0]["byteLength"] = 0),
    BAD("ViewStrideSmall", "/bufferViews/1/byteStride", "must lie within", d.json["bufferViews"][1]["byteStride"] = 3),
    BAD("ViewStrideLarge", "/bufferViews/1/byteStride", "must lie within",
        d.json["bufferViews"][1]["byteStride"] = 256),
    BAD("ViewStrideOdd", "/bufferViews/1", "no multiple of 4", d.json["bufferViews"][1]["byteStride"] = 14),
    BAD("StrideBelowElement", "/accessors/1", "below the element", d.json["bufferViews"][1]["byteStride"] = 8),
    BAD("AccessorView", "/accessors/1/bufferView", "no buffer view 99", d.json["accessors"][1]["bufferView"] = 99),
    BAD("S13_4_AccessorOfZerosClaimsGigabytes", "/accessors/1/count", "2147483647 elements without a buffer view",
        d.json["accessors"][1].erase("bufferView");
        d.json["accessors"][1]["count"] = 2147483647),
    BAD("AccessorComponent5124", "/accessors/1/componentType", "no component type",
        d.json["accessors"][1]["componentType"] = 5124),
    BAD("AccessorComponentDouble", "/accessors/1/componentType", "no component type",
        d.json["accessors"][1]["componentType"] = 5130),
    BAD("AccessorType", "/accessors/1/type", "no accessor type", d.json["accessors"][1]["type"] = "VEC5"),
    BAD("AccessorTypeMissing", "/accessors/1", "\"type\" is missing", d.json["accessors"][1].erase("type")),
    BAD("AccessorCountZero", "/accessors/1/count", "must lie within", d.json["accessors"][1]["count"] = 0),
    BAD("AccessorCountNegative", "/accessors/1/count", "must lie within", d.json["accessors"][1]["count"] = -1),
    BAD("AccessorCountBeyond", "/accessors/1", "the view has 36", d.json["accessors"][1]["count"] = 4),
    BAD("S13_4_AccessorCountClaimsGigabytes", "/accessors/1", "the view has 36",
        d.json["accessors"][1]["count"] = 2147483647),
    BAD("AccessorOffsetBeyond", "/accessors/1", "the view has 36", d.json["accessors"][1]["byteOffset"] = 40),
    BAD("AccessorUnaligned", "/accessors/1", "no multiple", d.json["accessors"][1]["byteOffset"] = 2),
    BAD("AccessorNormalizedFloat", "/accessors/1/normalized", "only 8-bit",
        d.json["accessors"][1]["normalized"] = true),
    BAD("AccessorNormalizedText", "/accessors/1/normalized", "true or false",
        d.json["accessors"][1]["normalized"] = "yes"),
    BAD("AccessorSparse", "/accessors/1/sparse", "\"count\" is missing",
        d.json["accessors"][1]["sparse"] = Json::object()),
    BAD("PositionNaN", "/accessors/1", "element 1 is nan", d.buffer.at(20) = 0, d.buffer.at(21) = 0,
        d.buffer.at(22) = 0xc0, d.buffer.at(23) = 0x7f),
    BAD("S13_6_PositionInfinite", "/accessors/1", "element 1 is inf", d.buffer.at(20) = 0, d.buffer.at(21) = 0,
        d.buffer.at(22) = 0x80, d.buffer.at(23) = 0x7f),
    BAD("S13_6_PositionBeyondLimit", "/accessors/1", "element 1 is", d.buffer.at(20) = 0, d.buffer.at(21) = 0,
        d.buffer.at(22) = 0x70, d.buffer.at(23) = 0x7f),
    BAD("IndexBeyondVertices", "/accessors/0", "element 0 is vertex index 3, there are 3", d.buffer.at(0) = 3),
    BAD("IndexIsRestartValue", "/accessors/0", "vertex index 65535", d.buffer.at(0) = d.buffer.at(1) = 255),

    BAD("ImageUriAndView", "/images/0", "either", d.json["images"][0]["uri"] = "image.png"),
    BAD("ImageNeither", "/images/0", "either", d.json["images"][0].erase("bufferView")),
    BAD("ImageWithoutType", "/images/0", "\"mimeType\" is missing", d.json["images"][0].erase("mimeType")),
    BAD("ImageType", "/images/0/mimeType", "only image/png", d.json["images"][0]["mimeType"] = "image/tiff"),
    BAD("ImageDataUriType", "/images/0/uri", "only image/png",
        d.json["images"][0] = {{"uri", "data:image/tiff;base64,AAAA"}}),
    BAD("S12_1_ImageView", "/images/0/bufferView", "no buffer view 99", d.json["images"][0]["bufferView"] = 99),
    BAD("ImageNotPng", "/images/0", "neither PNG nor JPEG", d.json["images"][0]["bufferView"] = 1),
    BAD("S12_13_ImageDamaged", "/images/0", "",
        // The magic bytes stay, all after the header is noise.
        for (std::size_t i = d.buffer.size() - 30; i < d.buffer.size(); ++i) d.buffer[i] = 0x55),
    BAD("ImageMissing", "/images/0/uri", "no such file", d.json["images"][0] = {{"uri", "absent.png"}}),
    BAD("ImageEmptyUri", "/images/0/uri", "empty", d.json["images"][0] = {{"uri", ""}}),
    BAD("SamplerWrap", "/samplers/0/wrapS", "not an allowed value", d.json["samplers"][0]["wrapS"] = 10496),
    BAD("SamplerFilter", "/samplers/0/magFilter", "not an allowed value", d.json["samplers"][0]["magFilter"] = 9984),
    BAD("TextureSource", "/textures/0/source", "no image 1", d.json["textures"][0]["source"] = 1),
    BAD("TextureWithoutSource", "/textures/0", "\"source\" is missing", d.json["textures"][0].erase("source")),
    BAD("TextureSampler", "/textures/0/sampler", "no sampler -1", d.json["textures"][0]["sampler"] = -1),
};

INSTANTIATE_TEST_SUITE_P(Structure, GltfBadJson, testing::ValuesIn(bad_structure), bad_name);
INSTANTIATE_TEST_SUITE_P(Data, GltfBadJson, testing::ValuesIn(bad_data), bad_name);

}  // namespace
}  // namespace aleph
