// Broken and hostile glTF files: structure and data that break one rule each must end in an InputError with its place.

#include "tests/engine/gltf/bad_change.h"
#include "tests/support/files/gltf_bad_input.h"

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
    SET("VersionMissing", "/asset", "\"version\" is missing", Json::object()),
    SET("VersionOne", "/asset/version", "\"1.0\"", "1.0"),
    SET("VersionThree", "/asset/version", "\"3.0\"", "3.0"),
    SET("VersionNumber", "/asset/version", "must be a string", 2.0),
    SET("VersionNamedWithControlBytes", "/asset/version", "\\x1b[2J", "\x1b[2J"),
    SET("MinVersion", "/asset/minVersion", "2.1", "2.1"),
    SET("RequiredUnknown", "/extensionsRequired/0", "VENDOR_x", "VENDOR_x"),
    SET("RequiredDispersion", "/extensionsRequired/0", "KHR_materials_dispersion", "KHR_materials_dispersion"),
    SET("RequiredNotText", "/extensionsRequired/0", "must be a string", 1),
    SET("UsedNotArray", "/extensionsUsed", "must be an array", "KHR_x"),
    BAD("Draco", "extensions", "KHR_draco_mesh_compression",
        d.primitive()["extensions"]["KHR_draco_mesh_compression"] = Json::object()),
    BAD("Meshopt", "extensions", "EXT_meshopt_compression",
        d.json["bufferViews"][1]["extensions"]["EXT_meshopt_compression"] = Json::object()),
    SET("TransmissionText", material_extension + "transmission/transmissionFactor", "must be a number", "1"),
    SET("UnlitNotObject", material_extension + "unlit", "must be an object", true),
    SET("VisibilityNumber", "/nodes/1/extensions/KHR_node_visibility/visible", "true or false", 0),

    SET("NodesNotArray", "/nodes", "must be an array", Json::object()),
    SET("NodeNotObject", "/nodes/2", "must be an object", 7),
    SET("NodeNameNumber", "/nodes/0/name", "must be a string", 5),
    SET("S13_3_NodeMeshRange", "/nodes/1/mesh", "no mesh 1", 1),
    SET("S12_8_NodeMeshNegative", "/nodes/1/mesh", "no mesh -4", -4),
    SET("S13_2_NodeMeshFraction", "/nodes/1/mesh", "must be an integer, found 0.5", 0.5),
    SET("S12_8_NodeMeshWholeFloat", "/nodes/1/mesh", "must be an integer", 0.0),
    SET("S12_8_NodeMeshText", "/nodes/1/mesh", "must be an integer", "0"),
    SET("S12_7_NodeMeshTwoTo32", "/nodes/1/mesh", "no mesh 4294967296", huge_index()),
    SET("S12_7_NodeMeshTwoTo63", "/nodes/1/mesh", "must lie within", std::uint64_t{1} << 63),
    SET("NodeCamera", "/nodes/2/camera", "no camera 3", 3),
    SET("NodeLight", "/nodes/2/extensions/KHR_lights_punctual/light", "no light 1", 1),
    SET("NodeSkin", "/nodes/1/skin", "no skin 0", 0),
    SET("KF29_NodeWeights", "/nodes/1/weights", "1 weights for 0 morph targets", {1}),
    SET("NodeTranslationShort", "/nodes/1/translation", "needs 3 numbers, found 2", {1, 2}),
    SET("NodeTranslationText", "/nodes/1/translation/1", "must be a number", "2"),
    SET("NodeTranslationHuge", "/nodes/1/translation/0", "within", 1e19),
    SET("KF05_NodeRotationZero", "/nodes/1/rotation", "is zero", {0, 0, 0, 0}),
    SET("NodeMatrixLength", "/nodes/2/matrix", "needs 16 numbers", {1, 2, 3}),
    BAD("NodeMatrixAndScale", "/nodes/2/matrix", "either a matrix or",
        d.json["nodes"][2].update(
            {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, {"scale", {1, 1, 1}}})),
    BAD("NodeMatrixProjective", "/nodes/2/matrix/11", "not affine",
        d.json["nodes"][2]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -1, 0, 0, 0, 1}),
    SET("NodeOwnChild", "/nodes/1/children/0", "its own child", 1),
    BAD("S13_5_NodeCycle", "/nodes/0", "cycle", d.json["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
        d.json.erase("scenes"); d.json.erase("scene"); d.json.erase("animations")),
    SET("S13_5_NodeTwoParents", "/nodes/1/children/0", "node 2 has two parents", 2),
    SET("NodeChildTwice", "/nodes/0/children/2", "two parents", 1),
    SET("NodeChildRange", "/nodes/1/children/0", "no node 9", 9),
    SET("SceneRange", "/scene", "no scene 1", 1),
    SET("SceneNegative", "/scene", "no scene -1", -1),
    SET("SceneNode", "/scenes/0/nodes/0", "no node 3", 3),
    SET("SceneRootHasParent", "/scenes/0/nodes/1", "has a parent", 1),
    SET("SceneRootTwice", "/scenes/0/nodes/1", "listed twice", 0),
};

const std::vector<BadChange> bad_data = {
    BAD("BufferLengthMissing", "/buffers/0", "\"byteLength\" is missing", d.json["buffers"][0].erase("byteLength")),
    SET("BufferLengthZero", "/buffers/0/byteLength", "must lie within", 0),
    SET("BufferLengthHuge", "/buffers/0/byteLength", "must lie within", huge_index()),
    BAD("BufferLongerThanData", "/buffers/0", "the data has", d.json["buffers"][0]["byteLength"] = 2000000000),
    SET("BufferUriNumber", "/buffers/0/uri", "must be a string", 4),
    SET("BufferWithoutUri", "/buffers/1", "no BIN chunk", {{"byteLength", 4}}),
    SET("BufferNotBase64", "/buffers/0/uri", "only base64", "data:application/octet-stream,abc"),
    SET("BufferBadBase64", "/buffers/0/uri", "is not base64", "data:application/octet-stream;base64,AA*A"),
    SET("BufferCutBase64", "/buffers/0/uri", "cut off", "data:application/octet-stream;base64,AAAAA"),
    SET("BufferNoComma", "/buffers/0/uri", "no comma", "data:;base64"),
    SET("ViewBuffer", "/bufferViews/0/buffer", "no buffer 1", 1),
    BAD("ViewBufferMissing", "/bufferViews/0", "\"buffer\" is missing", d.json["bufferViews"][0].erase("buffer")),
    BAD("S12_1_ViewLengthBeyond", "/bufferViews/0", "lie outside", d.json["bufferViews"][0]["byteLength"] = 100000),
    BAD("ViewOffsetBeyond", "/bufferViews/0", "lie outside", d.json["bufferViews"][0]["byteOffset"] = 2147483647),
    SET("ViewOffsetNegative", "/bufferViews/0/byteOffset", "must lie within", -4),
    SET("S13_4_ViewOffsetWraps", "/bufferViews/0/byteOffset", "must lie within", 18446744073709551612ull),
    SET("ViewLengthZero", "/bufferViews/0/byteLength", "must lie within", 0),
    SET("ViewStrideSmall", "/bufferViews/1/byteStride", "must lie within", 3),
    SET("ViewStrideLarge", "/bufferViews/1/byteStride", "must lie within", 256),
    BAD("ViewStrideOdd", "/bufferViews/1", "no multiple of 4", d.json["bufferViews"][1]["byteStride"] = 14),
    BAD("StrideBelowElement", "/accessors/1", "below the element", d.json["bufferViews"][1]["byteStride"] = 8),
    SET("AccessorView", "/accessors/1/bufferView", "no buffer view 99", 99),
    BAD("S13_4_AccessorOfZerosClaimsGigabytes", "/accessors/1/count", "2147483647 elements without a buffer view",
        d.json["accessors"][1].erase("bufferView");
        d.json["accessors"][1]["count"] = 2147483647),
    SET("AccessorComponent5124", "/accessors/1/componentType", "no component type", 5124),
    SET("AccessorComponentDouble", "/accessors/1/componentType", "no component type", 5130),
    SET("AccessorType", "/accessors/1/type", "no accessor type", "VEC5"),
    BAD("AccessorTypeMissing", "/accessors/1", "\"type\" is missing", d.json["accessors"][1].erase("type")),
    SET("AccessorCountZero", "/accessors/1/count", "must lie within", 0),
    SET("AccessorCountNegative", "/accessors/1/count", "must lie within", -1),
    BAD("AccessorCountBeyond", "/accessors/1", "the view has 36", d.json["accessors"][1]["count"] = 4),
    BAD("S13_4_AccessorCountClaimsGigabytes", "/accessors/1", "the view has 36",
        d.json["accessors"][1]["count"] = 2147483647),
    BAD("AccessorOffsetBeyond", "/accessors/1", "the view has 36", d.json["accessors"][1]["byteOffset"] = 40),
    BAD("AccessorUnaligned", "/accessors/1", "no multiple", d.json["accessors"][1]["byteOffset"] = 2),
    SET("AccessorNormalizedFloat", "/accessors/1/normalized", "only 8-bit", true),
    SET("AccessorNormalizedText", "/accessors/1/normalized", "true or false", "yes"),
    SET("AccessorSparse", "/accessors/1/sparse", "\"count\" is missing", Json::object()),
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
    SET("ImageType", "/images/0/mimeType", "only image/png", "image/tiff"),
    BAD("ImageDataUriType", "/images/0/uri", "only image/png",
        d.json["images"][0] = {{"uri", "data:image/tiff;base64,AAAA"}}),
    SET("S12_1_ImageView", "/images/0/bufferView", "no buffer view 99", 99),
    BAD("ImageNotPng", "/images/0", "neither PNG nor JPEG", d.json["images"][0]["bufferView"] = 1),
    BAD("S12_13_ImageDamaged", "/images/0", "",  // The magic bytes stay, all after the header is noise.
        for (std::size_t i = d.buffer.size() - 30; i < d.buffer.size(); ++i) d.buffer[i] = 0x55),
    BAD("ImageMissing", "/images/0/uri", "no such file", d.json["images"][0] = {{"uri", "absent.png"}}),
    BAD("ImageEmptyUri", "/images/0/uri", "empty", d.json["images"][0] = {{"uri", ""}}),
    SET("SamplerWrap", "/samplers/0/wrapS", "not an allowed value", 10496),
    SET("SamplerFilter", "/samplers/0/magFilter", "not an allowed value", 9984),
    SET("TextureSource", "/textures/0/source", "no image 1", 1),
    BAD("TextureWithoutSource", "/textures/0", "\"source\" is missing", d.json["textures"][0].erase("source")),
    SET("TextureSampler", "/textures/0/sampler", "no sampler -1", -1),
};

INSTANTIATE_TEST_SUITE_P(Structure, GltfBadJson, testing::ValuesIn(bad_structure), bad_name);
INSTANTIATE_TEST_SUITE_P(Data, GltfBadJson, testing::ValuesIn(bad_data), bad_name);

}  // namespace
}  // namespace aleph
