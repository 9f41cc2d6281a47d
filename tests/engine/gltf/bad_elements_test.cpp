// Broken and hostile glTF files: materials, cameras, lights, meshes and animations that break one rule each.

#include "tests/engine/gltf/bad_change.h"
#include "tests/support/files/gltf_draft.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

const std::string base_texture = "/materials/0/pbrMetallicRoughness/baseColorTexture";
const std::string first_light = "/extensions/KHR_lights_punctual/lights/0";

Json& light(GltfDraft& d) {
    return d.json[Json::json_pointer(first_light)];
}

const std::vector<BadChange> bad_use = {
    SET("MaterialTexture", base_texture + "/index", "no texture 5", 5),
    SET("MaterialTextureIndexMissing", "/materials/0/emissiveTexture", "\"index\" is missing", Json::object()),
    SET("MaterialUvSet", base_texture + "/texCoord", "sets 0 and 1", 2),
    SET("TextureTransformOffset", base_texture + "/extensions/KHR_texture_transform/offset", "needs 2 numbers",
        {1, 2, 3}),
    SET("TextureTransformUvSet", base_texture + "/extensions/KHR_texture_transform/texCoord", "sets 0 and 1", 7),
    SET("MaterialAlphaCutoff", "/materials/0/alphaCutoff", "not be negative", -0.5),
    SET("S12_6_MaterialColourOfThree", "/materials/0/pbrMetallicRoughness/baseColorFactor", "needs 4 numbers",
        {1, 1, 1}),
    SET("MaterialEmissionOfFour", "/materials/0/emissiveFactor", "needs 3 numbers", {1, 1, 1, 1}),
    SET("MaterialMetallicText", "/materials/0/pbrMetallicRoughness/metallicFactor", "must be a number", "1"),
    SET("MaterialDoubleSidedNumber", "/materials/0/doubleSided", "true or false", 1),
    SET("MaterialAlphaMode", "/materials/0/alphaMode", "no alpha mode", "GLASS"),
    SET("MaterialSpecularText", material_extension + "specular/specularFactor", "must be a number", true),
    SET("VolumeThicknessText", material_extension + "volume/thicknessFactor", "must be a number", "thick"),
    SET("VolumeDistanceZero", material_extension + "volume/attenuationDistance", "must be above 0", 0),
    SET("VolumeDistanceNegative", material_extension + "volume/attenuationDistance", "must be above 0", -1),
    SET("VolumeColourOfFour", material_extension + "volume/attenuationColor", "needs 3 numbers", {1, 1, 1, 1}),
    SET("VolumeTexture", material_extension + "volume/thicknessTexture/index", "no texture 9", 9),
    SET("ClearcoatNotObject", material_extension + "clearcoat", "must be an object", 1),
    SET("ClearcoatFactorText", material_extension + "clearcoat/clearcoatFactor", "must be a number", "1"),
    SET("ClearcoatRoughnessArray", material_extension + "clearcoat/clearcoatRoughnessFactor", "must be a number", {1}),
    SET("ClearcoatTexture", material_extension + "clearcoat/clearcoatTexture", "\"index\" is missing", Json::object()),
    BAD("ClearcoatRoughnessTexture", material_extension + "clearcoat/clearcoatRoughnessTexture/texCoord",
        "sets 0 and 1",
        d.json[Json::json_pointer(material_extension + "clearcoat/clearcoatRoughnessTexture")] = {{"index", 0},
                                                                                                  {"texCoord", 2}}),
    BAD("ClearcoatNormalScaleText", material_extension + "clearcoat/clearcoatNormalTexture/scale", "must be a number",
        d.json[Json::json_pointer(material_extension + "clearcoat/clearcoatNormalTexture")] = {{"index", 0},
                                                                                               {"scale", "1"}}),
    SET("SheenColourOfOne", material_extension + "sheen/sheenColorFactor", "needs 3 numbers", {1}),
    SET("SheenColourTexture", material_extension + "sheen/sheenColorTexture/index", "no texture 1", 1),
    SET("SheenRoughnessNull", material_extension + "sheen/sheenRoughnessFactor", "must be a number", nullptr),
    SET("SheenRoughnessTexture", material_extension + "sheen/sheenRoughnessTexture", "must be an object", 0),
    SET("AnisotropyStrengthText", material_extension + "anisotropy/anisotropyStrength", "must be a number", "1"),
    SET("AnisotropyRotationHuge", material_extension + "anisotropy/anisotropyRotation", "finite", 1e19),
    SET("AnisotropyTexture", material_extension + "anisotropy/anisotropyTexture/index", "no texture 3", 3),
    SET("NormalTexture", "/materials/0/normalTexture/index", "no texture 4", 4),
    BAD("NormalScaleText", "/materials/0/normalTexture/scale", "must be a number",
        d.json["materials"][0]["normalTexture"] = {{"index", 0}, {"scale", "x"}}),
    SET("MaterialExtensionsArray", "/materials/0/extensions", "must be an object", Json::array()),
    SET("CameraType", "/cameras/0/type", "no camera type", "fisheye"),
    BAD("CameraLensMissing", "/cameras/0", "\"perspective\" is missing", d.json["cameras"][0].erase("perspective")),
    SET("CameraFovZero", "/cameras/0/perspective/yfov", "must be above 0", 0),
    SET("CameraFovHalfTurn", "/cameras/0/perspective/yfov", "below pi", 3.15),
    BAD("CameraMagnificationZero", "/cameras/0/orthographic/ymag", "must not be 0",
        d.json["cameras"][0] = {{"type", "orthographic"},
                                {"orthographic", {{"xmag", 1}, {"ymag", 0}, {"znear", 0}, {"zfar", 1}}}}),
    BAD("CameraWidthZero", "/cameras/0/orthographic/xmag", "must not be 0",
        d.json["cameras"][0] = {{"type", "orthographic"},
                                {"orthographic", {{"xmag", 0}, {"ymag", 1}, {"znear", 0}, {"zfar", 1}}}}),
    SET("CameraPlanesSwapped", "/cameras/0/perspective/zfar", "beyond znear", 0.1),
    BAD("LightSpotWithoutCone", first_light, "\"spot\" is missing", light(d)["type"] = "spot"),
    BAD("LightConeInsideOut", first_light + "/spot", "narrower than the outer",
        light(d).update({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.5}}}})),
    BAD("LightConeTooWide", first_light + "/spot/outerConeAngle", "quarter turn",
        light(d).update({{"type", "spot"}, {"spot", {{"outerConeAngle", 1.6}}}})),
    BAD("LightConeNegative", first_light + "/spot/innerConeAngle", "not be negative",
        light(d).update({{"type", "spot"}, {"spot", {{"innerConeAngle", -0.1}}}})),
    SET("LightType", first_light + "/type", "no light type", "area"),
    SET("LightColour", first_light + "/color", "needs 3 numbers", {1}),
    SET("LightRangeZero", first_light + "/range", "must be above 0", 0),

    SET("MeshWithoutPrimitives", "/meshes/0/primitives", "must not be empty", Json::array()),
    SET("KF29_MeshWeights", "/meshes/0/weights", "1 weights for 0 morph targets", {0}),
    BAD("PrimitiveStripTooShort", "/meshes/0/primitives/0/indices", "needs 3 indices", d.primitive()["mode"] = 5;
        d.json["accessors"][0]["count"] = 2),
    BAD("PrimitiveLinesOdd", "/meshes/0/primitives/0/indices", "whole lines", d.primitive()["mode"] = 1),
    SET("PrimitiveModeUnknown", "/meshes/0/primitives/0/mode", "must lie within", 7),
    SET("PrimitiveMaterial", "/meshes/0/primitives/0/material", "no material 2", 2),
    BAD("S12_6_PrimitiveWithoutAttributes", "/meshes/0/primitives/0", "\"attributes\" is missing",
        d.primitive().erase("attributes")),
    BAD("PrimitiveWithoutPosition", "/meshes/0/primitives/0/attributes", "\"POSITION\" is missing",
        d.primitive()["attributes"].erase("POSITION")),
    BAD("AttributeUnaligned", "/meshes/0/primitives/0/attributes/COLOR_0", "multiples of 4 bytes",
        d.json["accessors"][3]["type"] = "VEC3"),
    SET("AttributeRange", "/meshes/0/primitives/0/attributes/NORMAL", "no accessor 77", 77),
    SET("AttributeFraction", "/meshes/0/primitives/0/attributes/POSITION", "must be an integer", 1.5),
    SET("AttributeNameEscaped", "/meshes/0/primitives/0/attributes/a~1b~0", "no accessor 77", 77),
    BAD("AttributeCount", "/meshes/0/primitives/0/attributes/NORMAL", "2 elements, POSITION has 3",
        d.json["accessors"][2]["count"] = 2),
    SET("PositionIsColour", "/meshes/0/primitives/0/attributes/POSITION", "float VEC3", 3),
    BAD("ColourNotNormalized", "/meshes/0/primitives/0/attributes/COLOR_0", "COLOR_0 must be",
        d.json["accessors"][3].erase("normalized")),
    SET("UvIsVec3", "/meshes/0/primitives/0/attributes/TEXCOORD_1", "TEXCOORD_1 must be", 2),
    SET("IndicesAreFloats", "/meshes/0/primitives/0/indices", "unsigned integers", 4),
    BAD("IndicesSigned", "/meshes/0/primitives/0/indices", "unsigned integers",
        d.json["accessors"][0]["componentType"] = 5122),
    BAD("IndicesStrided", "/meshes/0/primitives/0/indices", "byteStride",
        d.json["bufferViews"][0].update({{"byteStride", 4}, {"byteLength", 12}})),
    BAD("IndicesNotTriangles", "/meshes/0/primitives/0/indices", "whole triangles",
        d.json["accessors"][0]["count"] = 2),

    BAD("AnimationWithoutSamplers", "/animations/0", "\"samplers\" is missing",
        d.json["animations"][0].erase("samplers")),
    SET("AnimationWithoutChannels", "/animations/0/channels", "must not be empty", Json::array()),
    SET("ChannelSampler", "/animations/0/channels/0/sampler", "no sampler 1", 1),
    SET("ChannelNode", "/animations/0/channels/0/target/node", "no node 8", 8),
    SET("ChannelPath", "/animations/0/channels/0/target/path", "no animated property", "colour"),
    BAD("S12_6_ChannelPathMissing", "/animations/0/channels/0/target", "\"path\" is missing",
        d.json["animations"][0]["channels"][0]["target"].erase("path")),
    SET("ChannelWeights", "/animations/0/channels/0/target/path", "no morph targets", "weights"),
    BAD("ChannelOnMatrixNode", "/animations/0/channels/0/target/path", "node 0 has a matrix",
        d.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        d.json["animations"][0]["channels"][0]["target"]["node"] = 0),
    BAD("KF29_TwoChannelsOnOneProperty", "/animations/0/channels/1/target/path",
        "a second channel of the animation moves /nodes/1/rotation",
        d.json["animations"][0]["channels"].push_back(Json(d.json["animations"][0]["channels"][0]))),
    SET("SamplerInterpolation", "/animations/0/samplers/0/interpolation", "no interpolation", "linear"),
    BAD("SamplerCubic", "/animations/0/samplers/0/output", "2 values for 2 key times, expected 6",
        d.json["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE"),
    SET("SamplerInputType", "/animations/0/samplers/0/input", "float SCALAR", 0),
    SET("SamplerOutputType", "/animations/0/samplers/0/output", "VEC4", 1),
    BAD("SamplerOutputCount", "/animations/0/samplers/0/output", "1 values for 2 key times",
        d.json["accessors"][5]["count"] = 1),
    SET("SamplerOutputIsColours", "/animations/1/samplers/0/output", "VEC3", 3),
};

INSTANTIATE_TEST_SUITE_P(Use, GltfBadJson, testing::ValuesIn(bad_use), bad_name);

}  // namespace
}  // namespace aleph
