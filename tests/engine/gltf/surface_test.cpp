// glTF reader: meshes, materials, textures.
#include "engine/image/image_file.h"
#include "tests/engine/gltf/fixture.h"

namespace aleph {
namespace {

class GltfSurface : public GltfFixture {
  protected:
    /// Two pixels, red and blue.
    Bytes png() {
        Image<Rgb> image(2, 1);
        image(0, 0) = Rgb(1, 0, 0);
        image(1, 0) = Rgb(0, 0, 1);
        write_png(folder_ / "made.png", image);
        return read_regular_file(folder_ / "made.png", "made.png", "");
    }
    void add_texture(GltfDraft& draft) {
        draft.json["images"] = {{{"bufferView", draft.add_view(png())}, {"mimeType", "image/png"}}};
        draft.json["textures"] = {{{"source", 0}}};
    }
};

TEST_F(GltfSurface, ColoursInAllTheirForms) {
    const std::vector<glm::vec4> expected = {{1, 0, 0, 1}, {0, 128.0f / 255.0f, 0, 1}, {0, 0, 1.0f / 255.0f, 1}};
    GltfDraft bytes = triangle_draft();
    bytes.primitive()["attributes"]["COLOR_0"] =
        bytes.add_accessor<std::uint8_t>({255, 0, 0, 255, 0, 128, 0, 255, 0, 0, 1, 255}, "VEC4", 4, true);
    EXPECT_EQ(load(bytes).meshes[0].colors, expected);

    GltfDraft words = triangle_draft();
    words.primitive()["attributes"]["COLOR_0"] = words.add_accessor<std::uint16_t>(
        {65535, 0, 0, 65535, 0, 128 * 257, 0, 65535, 0, 0, 257, 65535}, "VEC4", 4, true);
    EXPECT_EQ(load(words).meshes[0].colors, expected);

    GltfDraft floats = triangle_draft();  // three components: alpha is 1
    floats.primitive()["attributes"]["COLOR_0"] =
        floats.add_accessor<float>({1, 0, 0, 0, 128.0f / 255.0f, 0, 0, 0, 1.0f / 255.0f}, "VEC3", 3);
    EXPECT_EQ(load(floats).meshes[0].colors, expected);

    GltfDraft wild = triangle_draft();
    wild.primitive()["attributes"]["COLOR_0"] = wild.add_accessor<float>({2, 0, 0, 0, -1, 0, 0, 0, 0.5f}, "VEC3", 3);
    const Scene clamped = load(wild);
    EXPECT_EQ(clamped.meshes[0].colors[0], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(clamped.meshes[0].colors[1], glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(count_warnings(clamped, "COLOR_0"), 1);
}

TEST_F(GltfSurface, ColourBytesOfThreeComponentsPaddedToFour) {
    GltfDraft draft = triangle_draft();
    const int view = draft.add_view({255, 0, 0, 77, 0, 255, 0, 77, 0, 0, 255}, 4);  // the last element ends early
    draft.json["accessors"].push_back(
        {{"bufferView", view}, {"componentType", 5121}, {"normalized", true}, {"count", 3}, {"type", "VEC3"}});
    draft.primitive()["attributes"]["COLOR_0"] = 2;
    EXPECT_EQ(load(draft).meshes[0].colors, (std::vector<glm::vec4>{{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}}));
}

TEST_F(GltfSurface, BothUvSetsFloatAndNormalized) {
    GltfDraft draft = triangle_draft();
    draft.primitive()["attributes"]["TEXCOORD_0"] = draft.add_accessor<float>({0, 0, 2.5f, 0, 0, -1}, "VEC2", 2);
    draft.primitive()["attributes"]["TEXCOORD_1"] =
        draft.add_accessor<std::uint16_t>({0, 65535, 13107, 0, 0, 0}, "VEC2", 2, true);
    const Mesh mesh = load(draft).meshes[0];
    EXPECT_EQ(mesh.uv[0], (std::vector<glm::vec2>{{0, 0}, {2.5f, 0}, {0, -1}}));
    EXPECT_EQ(mesh.uv[1], (std::vector<glm::vec2>{{0, 1}, {0.2f, 0}, {0, 0}}));
}

TEST_F(GltfSurface, InterleavedPositionsAndNormals) {
    GltfDraft draft = triangle_draft();
    const std::vector<float> both = {0, 0, 5, 0, 0, 1, 1, 0, 5, 0, 1, 0, 0, 1, 5, 1, 0, 0};
    Bytes bytes(both.size() * sizeof(float));
    std::memcpy(bytes.data(), both.data(), bytes.size());
    const int view = draft.add_view(bytes, 24);
    for (const int offset : {0, 12}) {
        draft.json["accessors"].push_back(
            {{"bufferView", view}, {"byteOffset", offset}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    }
    draft.primitive()["attributes"] = {{"POSITION", 2}, {"NORMAL", 3}};
    const Mesh mesh = load(draft).meshes[0];
    EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{0, 0, 5}, {1, 0, 5}, {0, 1, 5}}));
    EXPECT_EQ(mesh.normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}));
}

TEST_F(GltfSurface, IndicesOfEveryWidth) {
    GltfDraft bytes = triangle_draft(), words = triangle_draft(), longs = triangle_draft();
    bytes.primitive()["indices"] = bytes.add_accessor<std::uint8_t>({2, 1, 0, 0, 1, 2}, "SCALAR", 1);
    words.primitive()["indices"] = words.add_accessor<std::uint16_t>({2, 1, 0, 0, 1, 2}, "SCALAR", 1);
    longs.primitive()["indices"] = longs.add_accessor<std::uint32_t>({2, 1, 0, 0, 1, 2}, "SCALAR", 1);
    for (const GltfDraft& draft : {bytes, words, longs}) {
        EXPECT_EQ(load(draft).meshes[0].triangles, (std::vector<glm::uvec3>{{2, 1, 0}, {0, 1, 2}}));
    }
}

TEST_F(GltfSurface, NormalOfLengthZeroMakesTheMeshFlat) {
    GltfDraft draft = triangle_draft();
    draft.primitive()["attributes"]["NORMAL"] = draft.add_accessor<float>({0, 0, 1, 0, 0, 0, 0, 0, 1}, "VEC3", 3);
    const Scene scene = load(draft);
    EXPECT_TRUE(scene.meshes[0].normals.empty());
    EXPECT_EQ(count_warnings(scene, "shaded flat"), 1);
}

TEST_F(GltfSurface, DefaultMaterialIsTheSpecifications) {
    GltfDraft draft = triangle_draft();
    draft.json["materials"] = {Json::object()};
    draft.primitive()["material"] = 0;
    const Scene scene = load(draft);
    Material expected{.name = "material0", .gloss = {.metallic = 1.0}, .include = 0};
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0], expected);
    EXPECT_EQ(scene.meshes[0].material, 0);
}

TEST_F(GltfSurface, FactorsAndExtensions) {
    GltfDraft draft = triangle_draft();
    draft.json["materials"] = {
        {{"name", "lamp"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.75}}},
         {"emissiveFactor", {1, 0.5, 0}},
         {"doubleSided", true},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 5000000000}}},  // an integer beyond 31 bits
           {"KHR_materials_ior", {{"ior", 1.33}}},
           {"KHR_materials_specular", {{"specularFactor", 0}, {"specularColorFactor", {0.5, 2, 1}}}}}}}};
    const Scene scene = load(draft);
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.name, "lamp");
    EXPECT_EQ(material.base_color, Track<glm::dvec3>(glm::dvec3(0.1, 0.2, 0.3)));
    EXPECT_EQ(material.opacity.alpha, Track<double>(0.4));
    EXPECT_EQ(material.gloss.metallic, Track<double>(0.25));
    EXPECT_EQ(material.gloss.roughness, Track<double>(0.75));
    EXPECT_EQ(material.glow.color, Track<glm::dvec3>(glm::dvec3(1, 0.5, 0)));
    EXPECT_EQ(material.glow.strength, Track<double>(5e9));
    EXPECT_EQ(material.gloss.ior, Track<double>(1.33));
    EXPECT_EQ(material.gloss.specular, Track<double>(0.0));
    EXPECT_EQ(material.gloss.specular_color, Track<glm::dvec3>(glm::dvec3(0.5, 2, 1)));
    EXPECT_TRUE(material.double_sided);
    EXPECT_TRUE(scene.source.warnings.empty());
}

TEST_F(GltfSurface, S13_8_FactorsOutOfRangeAreClampedWithAWarning) {
    GltfDraft draft = triangle_draft();
    draft.json["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 1.5}, {"roughnessFactor", -1}}},
                                {"extensions", {{"KHR_materials_ior", {{"ior", 0.5}}}}}}};
    const Scene scene = load(draft);
    EXPECT_EQ(scene.materials[0].gloss.metallic, Track<double>(1.0));
    EXPECT_EQ(scene.materials[0].gloss.roughness, Track<double>(0.0));
    EXPECT_EQ(scene.materials[0].gloss.ior, Track<double>(1.0));
    EXPECT_EQ(count_warnings(scene, "/materials/0: metallicFactor 1.5 is clamped to 1"), 1);
    EXPECT_EQ(scene.source.warnings.size(), 3u);
}

TEST_F(GltfSurface, TexturesWithSamplersUvSetsAndOneSharedImage) {
    GltfDraft draft = triangle_draft();
    const int view = draft.add_view(png());
    draft.json["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}, {"name", "two"}}};
    draft.json["samplers"] = {{{"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33648}}};
    draft.json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 0}}};
    draft.json["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 1}}}}},
         {"emissiveTexture", {{"index", 1}, {"texCoord", 1}}},
         {"extensions",
          {{"KHR_materials_specular",
            {{"specularTexture", {{"index", 0}, {"texCoord", 1}}}, {"specularColorTexture", {{"index", 1}}}}}}}}};
    const Scene scene = load(draft);
    ASSERT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(scene.images[0].name, "two");
    EXPECT_EQ(scene.images[0].path, "");
    ASSERT_EQ(scene.images[0].bytes.width, 2);
    EXPECT_EQ(scene.images[0].bytes(0, 0), glm::u8vec4(255, 0, 0, 255));
    EXPECT_EQ(scene.images[0].bytes(1, 0), glm::u8vec4(0, 0, 255, 255));
    const Material& material = scene.materials[0];
    const TextureRef sampled{0, 0, Wrap::clamp, Wrap::mirror, true}, plain{0, 0, Wrap::repeat, Wrap::repeat, false};
    TextureRef second = plain, sampled_second = sampled;
    second.uv_set = sampled_second.uv_set = 1;
    EXPECT_EQ(material.textures[TextureSlot::base_color], sampled);
    EXPECT_EQ(material.textures[TextureSlot::metallic_roughness], plain);
    EXPECT_EQ(material.textures[TextureSlot::emission], second);
    EXPECT_EQ(material.textures[TextureSlot::specular], sampled_second);
    EXPECT_EQ(material.textures[TextureSlot::specular_color], plain);
}

TEST_F(GltfSurface, ImagesFromFilesAndDataUris) {
    const Bytes encoded = png();
    write_bytes(folder_ / "red blue.png", encoded);
    for (const std::string& uri : {std::string("red%20blue.png"), "data:image/png;base64," + to_base64(encoded)}) {
        GltfDraft draft = triangle_draft();
        draft.json["images"] = {{{"uri", uri}}};
        draft.json["textures"] = {{{"source", 0}}};
        draft.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
        const Scene scene = load(draft);
        ASSERT_EQ(scene.images.size(), 1u);
        EXPECT_EQ(scene.images[0].bytes(1, 0), glm::u8vec4(0, 0, 255, 255));
        EXPECT_EQ(scene.images[0].path, uri[0] == 'r' ? "red blue.png" : "");
    }
}

TEST_F(GltfSurface, OcclusionTexturesGiveOneWarningAndAreNotDecoded) {
    GltfDraft draft = triangle_draft();
    add_texture(draft);
    const Json material = {{"occlusionTexture", {{"index", 0}, {"texCoord", 2}}}};
    draft.json["materials"] = {material, material};
    const Scene scene = load(draft);
    EXPECT_EQ(scene.source.warnings.size(), 1u);
    EXPECT_EQ(count_warnings(scene, "materials: occlusion textures (2) are not used"), 1);
    EXPECT_TRUE(scene.images.empty());
}

/// EXT_texture_webp and KHR_texture_basisu beside a PNG: glTF 2.0, 3.12, lets readers ignore what is not required.
TEST_F(GltfSurface, ImagesOfOptionalExtensionsAreNotRead) {
    for (const auto& [extension, type] :
         {std::pair("EXT_texture_webp", "image/webp"), {"KHR_texture_basisu", "image/ktx2"}}) {
        GltfDraft draft = triangle_draft();
        add_texture(draft);
        draft.json["images"].push_back({{"uri", "absent.bin"}, {"mimeType", type}});
        draft.json["textures"][0]["extensions"][extension] = {{"source", 1}};
        draft.json["extensionsUsed"] = {extension};
        draft.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
        const Scene scene = load(draft);
        EXPECT_EQ(scene.images.size(), 1u);
    }
}

TEST_F(GltfSurface, AlphaModesAndCutoff) {
    GltfDraft draft = triangle_draft();
    draft.json["materials"] = {
        {{"alphaMode", "MASK"}, {"alphaCutoff", 0.3}}, {{"alphaMode", "BLEND"}}, {{"alphaMode", "OPAQUE"}}};
    const Scene scene = load(draft);
    EXPECT_EQ(scene.materials[0].opacity.mode, Opacity::Mode::mask);
    EXPECT_EQ(scene.materials[0].opacity.cutoff, 0.3);
    EXPECT_EQ(scene.materials[1].opacity.mode, Opacity::Mode::blend);
    EXPECT_EQ(scene.materials[2].opacity.mode, Opacity::Mode::opaque);
    EXPECT_EQ(scene.materials[2].opacity.cutoff, 0.5);
    EXPECT_TRUE(scene.source.warnings.empty());
}

TEST_F(GltfSurface, TextureTransformsOfEveryTexture) {
    GltfDraft draft = triangle_draft();
    add_texture(draft);
    draft.json["extensionsUsed"] = {"KHR_texture_transform"};
    draft.json["extensionsRequired"] = {"KHR_texture_transform"};
    const auto info = [](double offset, Json more) {
        more["offset"] = {offset, -offset};
        return Json{{"index", 0}, {"extensions", {{"KHR_texture_transform", more}}}};
    };
    Json moved = info(0.25, {{"texCoord", 1}, {"rotation", 0.5}});
    moved["texCoord"] = 5;  // overridden by the transform's
    draft.json["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorTexture", moved}, {"metallicRoughnessTexture", info(0.5, {{"scale", {2, -3}}})}}},
         {"emissiveTexture", info(0.75, Json::object())},
         {"extensions",
          {{"KHR_materials_specular",
            {{"specularTexture", info(1.0, Json::object())}, {"specularColorTexture", {{"index", 0}}}}},
           {"KHR_materials_transmission",
            {{"transmissionFactor", 0.25}, {"transmissionTexture", info(1.25, Json::object())}}}}}}};
    const Scene scene = load(draft);
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.textures[TextureSlot::base_color].uv_offset, glm::dvec2(0.25, -0.25));
    EXPECT_EQ(material.textures[TextureSlot::base_color].uv_scale, glm::dvec2(1.0));
    EXPECT_EQ(material.textures[TextureSlot::base_color].uv_rotation, 0.5);
    EXPECT_EQ(material.textures[TextureSlot::base_color].uv_set, 1);
    EXPECT_EQ(material.textures[TextureSlot::metallic_roughness].uv_scale, glm::dvec2(2.0, -3.0));
    EXPECT_EQ(material.textures[TextureSlot::metallic_roughness].uv_rotation, 0.0);
    EXPECT_EQ(material.textures[TextureSlot::emission].uv_offset, glm::dvec2(0.75, -0.75));
    EXPECT_EQ(material.textures[TextureSlot::specular].uv_offset, glm::dvec2(1.0, -1.0));
    EXPECT_EQ(material.textures[TextureSlot::specular_color].uv_offset, glm::dvec2(0.0));
    EXPECT_EQ(material.glass.transmission, Track<double>(0.25));
    EXPECT_EQ(material.textures[TextureSlot::transmission].uv_offset, glm::dvec2(1.25, -1.25));
    EXPECT_TRUE(scene.source.warnings.empty());
}

TEST_F(GltfSurface, UnlitTransmissionAndIor) {
    GltfDraft draft = triangle_draft();
    draft.json["materials"] = {
        {{"extensions", {{"KHR_materials_unlit", Json::object()}}}},
        {{"extensions",
          {{"KHR_materials_transmission", {{"transmissionFactor", 2}}}, {"KHR_materials_ior", {{"ior", 0}}}}}}};
    const Scene scene = load(draft);
    EXPECT_TRUE(scene.materials[0].unlit);
    EXPECT_EQ(scene.materials[0].glass.transmission, Track<double>(0.0));
    EXPECT_FALSE(scene.materials[1].unlit);
    EXPECT_EQ(scene.materials[1].glass.transmission, Track<double>(1.0));
    EXPECT_EQ(scene.materials[1].gloss.ior, Track<double>(0.0));  // allowed: reflects everything
    EXPECT_EQ(count_warnings(scene, "transmissionFactor 2 is clamped to 1"), 1);
    EXPECT_EQ(scene.source.warnings.size(), 1u);
}

}  // namespace
}  // namespace aleph
