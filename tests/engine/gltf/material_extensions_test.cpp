// glTF reader: volumes, clear coats, sheen, anisotropy, normal maps, and extensions that are not supported.
#include "engine/image/image_file.h"
#include "tests/engine/gltf/fixture.h"

namespace aleph {
namespace {

class GltfMaterialExtensions : public GltfFixture {
  protected:
    /// A triangle with a material; the only texture is one red pixel.
    GltfDraft draft_with(const Json& material) {
        write_png(folder_ / "made.png", Image<Rgb>(1, 1, Rgb(1, 0, 0)));
        GltfDraft draft = triangle_draft();
        const int view = draft.add_view(read_regular_file(folder_ / "made.png", "made.png", ""));
        draft.json["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
        draft.json["textures"] = {{{"source", 0}}};
        draft.json["materials"] = {material};
        draft.primitive()["material"] = 0;
        return draft;
    }
    static Json extensions(const char* name, const Json& members) { return {{"extensions", {{name, members}}}}; }

    /// A texture info whose second set and offset tell it from the others.
    static Json info(double offset) {
        return {{"index", 0}, {"texCoord", 1}, {"extensions", {{"KHR_texture_transform", {{"offset", {offset, 0}}}}}}};
    }
    static void expect_info(const TextureRef& texture, double offset) {
        EXPECT_EQ(texture.image, 0);
        EXPECT_EQ(texture.uv_set, 1);
        EXPECT_EQ(texture.uv_offset, glm::dvec2(offset, 0.0));
    }
};

TEST_F(GltfMaterialExtensions, Volume) {
    const Scene scene = load(draft_with(extensions("KHR_materials_volume", {{"thicknessFactor", 0.5},
                                                                            {"thicknessTexture", info(1)},
                                                                            {"attenuationDistance", 0.25},
                                                                            {"attenuationColor", {0.1, 0.2, 0.3}}})));
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.glass.thickness, Track<double>(0.5));
    expect_info(material.textures[TextureSlot::thickness], 1);
    EXPECT_EQ(material.glass.attenuation_distance, Track<double>(0.25));
    EXPECT_EQ(material.glass.attenuation_color, Track<glm::dvec3>(glm::dvec3(0.1, 0.2, 0.3)));
    EXPECT_TRUE(scene.source.warnings.empty()) << scene.source.warnings[0];
}

TEST_F(GltfMaterialExtensions, ClearcoatWithThreeTextures) {
    Json normal = info(3);
    normal["scale"] = 0.5;
    const Scene scene = load(draft_with(extensions("KHR_materials_clearcoat", {{"clearcoatFactor", 0.75},
                                                                               {"clearcoatTexture", info(1)},
                                                                               {"clearcoatRoughnessFactor", 0.125},
                                                                               {"clearcoatRoughnessTexture", info(2)},
                                                                               {"clearcoatNormalTexture", normal}})));
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.layers.clearcoat, Track<double>(0.75));
    expect_info(material.textures[TextureSlot::clearcoat], 1);
    EXPECT_EQ(material.layers.clearcoat_roughness, Track<double>(0.125));
    expect_info(material.textures[TextureSlot::clearcoat_roughness], 2);
    expect_info(material.textures[TextureSlot::clearcoat_normal], 3);
    EXPECT_EQ(material.textures.clearcoat_normal_scale, 0.5);
    EXPECT_EQ(material.textures.normal_scale, 1.0);
    EXPECT_TRUE(scene.source.warnings.empty()) << scene.source.warnings[0];
}

TEST_F(GltfMaterialExtensions, SheenAndAnisotropy) {
    Json both = extensions("KHR_materials_sheen", {{"sheenColorFactor", {0.25, 0.5, 0.75}},
                                                   {"sheenColorTexture", info(1)},
                                                   {"sheenRoughnessFactor", 0.3},
                                                   {"sheenRoughnessTexture", info(2)}});
    both["extensions"]["KHR_materials_anisotropy"] = {
        {"anisotropyStrength", 0.6}, {"anisotropyRotation", -7}, {"anisotropyTexture", info(3)}};
    const Scene scene = load(draft_with(both));
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.layers.sheen_color, Track<glm::dvec3>(glm::dvec3(0.25, 0.5, 0.75)));
    expect_info(material.textures[TextureSlot::sheen_color], 1);
    EXPECT_EQ(material.layers.sheen_roughness, Track<double>(0.3));
    expect_info(material.textures[TextureSlot::sheen_roughness], 2);
    EXPECT_EQ(material.layers.anisotropy, Track<double>(0.6));
    EXPECT_EQ(material.layers.anisotropy_rotation, Track<double>(-7.0));
    expect_info(material.textures[TextureSlot::anisotropy], 3);
    EXPECT_TRUE(scene.source.warnings.empty()) << scene.source.warnings[0];
}

TEST_F(GltfMaterialExtensions, NormalMapWithItsScaleAndATangentThatIsIgnored) {
    Json normal = info(1);
    normal["scale"] = -2;
    GltfDraft draft = draft_with({{"normalTexture", normal}});
    draft.primitive()["attributes"]["TANGENT"] =
        draft.add_accessor<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4", 4);
    const Scene scene = load(draft);
    expect_info(scene.materials[0].textures[TextureSlot::normal], 1);
    EXPECT_EQ(scene.materials[0].textures.normal_scale, -2.0);
    EXPECT_EQ(scene.images.size(), 1u);
    EXPECT_TRUE(scene.source.warnings.empty()) << scene.source.warnings[0];
}

TEST_F(GltfMaterialExtensions, FilesMayRequireThemAndDefaultsAreThoseOfTheSpecifications) {
    const Material plain = load(draft_with({{"name", "m"}})).materials[0];
    for (const char* name :
         {"KHR_materials_volume", "KHR_materials_clearcoat", "KHR_materials_sheen", "KHR_materials_anisotropy"}) {
        Json material = extensions(name, Json::object());
        material["name"] = "m";
        GltfDraft draft = draft_with(material);
        draft.json["extensionsUsed"] = draft.json["extensionsRequired"] = {name};
        const Scene scene = load(draft);
        EXPECT_EQ(scene.materials[0], plain) << name;
        EXPECT_TRUE(scene.source.warnings.empty()) << name;
    }
    EXPECT_EQ(plain.glass.attenuation_distance, Track<double>(0.0)) << "glTF's infinite distance";
}

TEST_F(GltfMaterialExtensions, AMemberWithoutANameIsNotTheMaterial) {
    const Scene scene = load(draft_with({{"", {{"emissiveFactor", "red"}}}, {"attenuationDistance", -1}}));
    EXPECT_EQ(key_value(scene.materials[0].glow.color, 0), glm::dvec3(0.0));
}

TEST_F(GltfMaterialExtensions, S13_8_FactorsOutOfRangeAreClampedWithAWarning) {
    const auto expect_clamped = [&](const char* extension, const Json& members, const char* warning) {
        const Scene scene = load(draft_with(extensions(extension, members)));
        EXPECT_EQ(count_warnings(scene, std::string("/materials/0: ") + warning), 1) << warning;
        EXPECT_EQ(scene.source.warnings.size(), 1u) << warning;
        return scene.materials[0];
    };
    EXPECT_EQ(expect_clamped("KHR_materials_volume", {{"thicknessFactor", -1}}, "thicknessFactor -1 is clamped to 0")
                  .glass.thickness,
              Track<double>(0.0));
    EXPECT_EQ(
        expect_clamped("KHR_materials_volume", {{"attenuationColor", {2, 1, 0}}}, "attenuationColor 2 is clamped to 1")
            .glass.attenuation_color,
        Track<glm::dvec3>(glm::dvec3(1, 1, 0)));
    EXPECT_EQ(
        expect_clamped("KHR_materials_clearcoat", {{"clearcoatFactor", 1.5}}, "clearcoatFactor 1.5 is clamped to 1")
            .layers.clearcoat,
        Track<double>(1.0));
    expect_clamped("KHR_materials_clearcoat", {{"clearcoatRoughnessFactor", -1}}, "clearcoatRoughnessFactor -1 is");
    expect_clamped("KHR_materials_sheen", {{"sheenColorFactor", {0, 0, 3}}}, "sheenColorFactor 3 is clamped to 1");
    expect_clamped("KHR_materials_sheen", {{"sheenRoughnessFactor", 2}}, "sheenRoughnessFactor 2 is clamped to 1");
    expect_clamped("KHR_materials_anisotropy", {{"anisotropyStrength", 2}}, "anisotropyStrength 2 is clamped to 1");
}

TEST_F(GltfMaterialExtensions, WhatIsMissingIsSaidOncePerFile) {
    const std::vector<std::pair<const char*, const char*>> missing = {
        {"KHR_materials_iridescence", "without the colours of thin films"},
        {"KHR_materials_dispersion", "without the separation of colours in refraction"},
        {"KHR_materials_diffuse_transmission", "without light that diffuses through thin surfaces"},
        {"KHR_materials_volume_scatter", "without the scattering of light inside volumes"},
        {"KHR_materials_pbrSpecularGlossiness", "without its colours"},
        {"KHR_materials_variants", "without its variants"},
        {"EXT_lights_image_based", "without the light of its pictures"}};
    for (const auto& [name, words] : missing) {
        GltfDraft draft = draft_with(extensions(name, Json::object()));
        draft.json["materials"].push_back(draft.json["materials"][0]);
        draft.json["extensions"][name] = Json::object();
        const Scene scene = load(draft);
        EXPECT_EQ(scene.source.warnings.size(), 1u) << name;
        EXPECT_TRUE(has_warning(scene, std::string("the extension ") + name + " is not supported: ")) << name;
        EXPECT_FALSE(has_warning(scene, ": : ")) << "the warning is of the whole file";
        EXPECT_TRUE(has_warning(scene, words)) << name;
        draft.json["extensionsRequired"] = {name};
        EXPECT_THROW(load(draft), InputError) << name;
    }
    EXPECT_TRUE(has_warning(load(draft_with(extensions("VENDOR_glow", Json::object()))), "VENDOR_glow is ignored"));
}

}  // namespace
}  // namespace aleph
