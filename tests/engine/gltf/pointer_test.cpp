// glTF reader: KHR_animation_pointer, and several animations of one property.
#include "engine/gltf/validate/pointer.h"
#include "engine/pose/pose.h"
#include "tests/engine/gltf/fixture.h"

namespace aleph {
namespace {

class GltfPointerTest : public GltfFixture {
  protected:
    static GltfDraft draft_with_everything() {
        GltfDraft draft = triangle_draft();
        draft.json["materials"] = {Json::object()};
        draft.json["cameras"] = {
            {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}},
            {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 1}}}}};
        draft.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", Json::object()}},
                                                                     {{"type", "point"}}};
        draft.json["nodes"] = {{{"mesh", 0}, {"camera", 0}},
                               {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
        draft.json["scenes"][0]["nodes"] = {0, 1};
        return draft;
    }
};

TEST_F(GltfPointerTest, NumbersOfCamerasLightsAndMaterials) {
    const auto is_read = [&](const char* pointer, const auto& track_of) {
        GltfDraft draft = draft_with_everything();
        draft.animate_pointer(pointer, {0, 2}, {0.25f, 0.75f});
        const Scene scene = load(draft);
        const Track<double>& track = track_of(scene);
        EXPECT_EQ(track.values, (std::vector<double>{0.25, 0.75})) << pointer;
        EXPECT_EQ(evaluate(track, 1.0), 0.5) << pointer;
        EXPECT_TRUE(scene.source.warnings.empty()) << scene.source.warnings[0];
    };
    const auto camera = [](std::size_t i, auto member) {
        return [=](const Scene& s) -> const Track<double>& { return s.cameras[i].*member; };
    };
    const auto light = [](auto member) {
        return [=](const Scene& s) -> const Track<double>& { return s.lights[0].*member; };
    };
    const auto material = [](auto... path) {
        return [=](const Scene& s) -> const Track<double>& { return (s.materials[0].*....*path); };
    };
    const std::string lamp = "/extensions/KHR_lights_punctual/lights/0/";
    const std::string more = "/materials/0/extensions/KHR_materials_";
    is_read("/cameras/0/perspective/yfov", camera(0, &Camera::fov));
    is_read("/cameras/1/orthographic/ymag", camera(1, &Camera::half_height));
    is_read((lamp + "intensity").c_str(), light(&Light::intensity));
    is_read((lamp + "range").c_str(), light(&Light::range));
    is_read((lamp + "spot/innerConeAngle").c_str(), light(&Light::inner_cone));
    is_read((lamp + "spot/outerConeAngle").c_str(), light(&Light::outer_cone));
    is_read("/materials/0/pbrMetallicRoughness/metallicFactor", material(&Material::gloss, &Gloss::metallic));
    is_read("/materials/0/pbrMetallicRoughness/roughnessFactor", material(&Material::gloss, &Gloss::roughness));
    is_read((more + "emissive_strength/emissiveStrength").c_str(), material(&Material::glow, &Glow::strength));
    is_read((more + "specular/specularFactor").c_str(), material(&Material::gloss, &Gloss::specular));
    is_read((more + "transmission/transmissionFactor").c_str(), material(&Material::glass, &Glass::transmission));
    is_read((more + "volume/thicknessFactor").c_str(), material(&Material::glass, &Glass::thickness));
    is_read((more + "volume/attenuationDistance").c_str(), material(&Material::glass, &Glass::attenuation_distance));
    is_read((more + "clearcoat/clearcoatFactor").c_str(), material(&Material::layers, &Layers::clearcoat));
    is_read((more + "clearcoat/clearcoatRoughnessFactor").c_str(),
            material(&Material::layers, &Layers::clearcoat_roughness));
    is_read((more + "sheen/sheenRoughnessFactor").c_str(), material(&Material::layers, &Layers::sheen_roughness));
    is_read((more + "anisotropy/anisotropyStrength").c_str(), material(&Material::layers, &Layers::anisotropy));
    is_read((more + "anisotropy/anisotropyRotation").c_str(),
            material(&Material::layers, &Layers::anisotropy_rotation));
}

TEST_F(GltfPointerTest, TheWidthOfAnOrthographicViewFollowsThePicture) {
    GltfDraft draft = draft_with_everything();
    draft.animate_pointer("/cameras/1/orthographic/xmag", {0, 2}, {0.25f, 0.75f});
    const Scene scene = load(draft);
    EXPECT_EQ(scene.cameras[1].half_height, Track<double>(1.0));
    EXPECT_TRUE(scene.source.warnings.empty()) << scene.source.warnings[0];
}

TEST_F(GltfPointerTest, ColoursAndIor) {
    GltfDraft draft = draft_with_everything();
    draft.animate_pointer("/materials/0/pbrMetallicRoughness/baseColorFactor", {0, 1}, {0, 0, 0, 1, 1, 0.5f, 0, 0});
    draft.animate_pointer("/materials/0/emissiveFactor", {0, 1}, {0, 0, 0, 0, 0, 1});
    draft.animate_pointer("/materials/0/extensions/KHR_materials_specular/specularColorFactor", {0, 1},
                          {0, 0, 0, 0, 0, 4});
    draft.animate_pointer("/materials/0/extensions/KHR_materials_ior/ior", {0, 1}, {1, 2}, "STEP");
    draft.animate_pointer("/extensions/KHR_lights_punctual/lights/0/color", {0, 1}, {0, 0, 0, 2, 0, 0});
    draft.animate_pointer("/materials/0/extensions/KHR_materials_volume/attenuationColor", {0, 1}, {0, 0, 0, 1, 0, 0});
    draft.animate_pointer("/materials/0/extensions/KHR_materials_sheen/sheenColorFactor", {0, 1}, {0, 0, 0, 0, 1, 0});
    const Scene scene = load(draft);
    const ScenePose half = pose(scene, 0.5);
    EXPECT_EQ(half.materials[0].base_color, Rgb(0.5f, 0.25f, 0.0f));
    EXPECT_EQ(half.materials[0].alpha, 0.5f);
    EXPECT_EQ(half.materials[0].emission, Rgb(0.0f, 0.0f, 0.5f));
    EXPECT_EQ(half.materials[0].gloss.specular_color, Rgb(0.0f, 0.0f, 2.0f));
    EXPECT_EQ(half.materials[0].gloss.ior, 1.0f);
    EXPECT_EQ(half.materials[0].glass.attenuation_color, Rgb(0.5f, 0.0f, 0.0f));
    EXPECT_EQ(half.materials[0].layers.sheen_color, Rgb(0.0f, 0.5f, 0.0f));
    EXPECT_EQ(pose(scene, 1.0).materials[0].gloss.ior, 2.0f);
    EXPECT_EQ(half.lights[0].intensity, Rgb(1.0f, 0.0f, 0.0f));
}

/// KHR_materials_ior: 0 stands for full reflection.
TEST_F(GltfPointerTest, AnIorOfZeroIsNoSmallOne) {
    GltfDraft draft = draft_with_everything();
    draft.animate_pointer("/materials/0/extensions/KHR_materials_ior/ior", {0, 1, 2}, {0, 0.5f, 2}, "STEP");
    const Scene scene = load(draft);
    EXPECT_EQ(pose(scene, 0.5).materials[0].gloss.ior, 0.0f);
    EXPECT_EQ(pose(scene, 1.5).materials[0].gloss.ior, 1.0f);
    EXPECT_TRUE(has_warning(scene, "clamped"));
}

TEST_F(GltfPointerTest, NodesWeightsAndVisibility) {
    GltfDraft draft = draft_with_everything();
    draft.animate_pointer("/nodes/1/translation", {0, 1}, {0, 0, 0, 2, 0, 0});
    draft.animate_pointer("/nodes/1/rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 0, 1});
    draft.animate_pointer("/nodes/1/scale", {0, 1}, {1, 1, 1, 3, 3, 3});
    draft.primitive()["targets"] = {{{"POSITION", 1}}};
    draft.animate_pointer("/nodes/0/weights", {0, 1}, {0, 1});
    const int times = draft.add_accessor<float>({0, 1}, "SCALAR", 1);
    const int shown = draft.add_accessor<std::uint8_t>({0, 7}, "SCALAR", 1);
    draft.add_pointer_channel("/nodes/1/extensions/KHR_node_visibility/visible", times, shown, "STEP");
    const Scene scene = load(draft);
    EXPECT_EQ(pose(scene, 0.5).world[1], glm::dmat4(2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 0, 0, 1));
    EXPECT_EQ(scene.meshes[0].deformation.target_weights[0].values, (std::vector<double>{0, 1}));
    EXPECT_EQ(pose(scene, 0.9).visible[1], 0);
    EXPECT_EQ(pose(scene, 1.0).visible[1], 1);
}

TEST_F(GltfPointerTest, CubicKeysPassUnchanged) {
    GltfDraft draft = draft_with_everything();
    draft.animate_pointer("/cameras/0/perspective/yfov", {0, 2}, {9, 0.5f, 0.25f, -0.125f, 1, 9}, "CUBICSPLINE");
    const Scene scene = load(draft);
    EXPECT_EQ(scene.cameras[0].fov.interpolation, Interpolation::cubic);
    EXPECT_EQ(scene.cameras[0].fov.values, (std::vector<double>{9, 0.5, 0.25, -0.125, 1, 9}));
    // Hermite at s = 1/2, tangents times the interval of 2 s: (p0 + p1) / 2 + 2 (m0 - m1) / 8.
    EXPECT_DOUBLE_EQ(evaluate(scene.cameras[0].fov, 1.0), 0.75 + 2.0 * (0.25 + 0.125) / 8.0);
}

TEST_F(GltfPointerTest, KeysOutOfRangeAreClampedWithAWarning) {
    GltfDraft draft = draft_with_everything();
    draft.animate_pointer("/materials/0/pbrMetallicRoughness/metallicFactor", {0, 1}, {-1, 2});
    const Scene scene = load(draft);
    EXPECT_EQ(scene.materials[0].gloss.metallic.values, (std::vector<double>{0, 1}));
    EXPECT_EQ(count_warnings(scene, "metallicFactor leave 0 to 1 and are clamped"), 1);

    GltfDraft volume = draft_with_everything();
    const std::string more = "/materials/0/extensions/KHR_materials_";
    volume.animate_pointer((more + "volume/attenuationDistance").c_str(), {0, 1}, {-1, 2});
    volume.animate_pointer((more + "volume/thicknessFactor").c_str(), {0, 1}, {-1, 2});
    volume.animate_pointer((more + "sheen/sheenColorFactor").c_str(), {0, 1}, {0, 0, 0, 0, 0, 2});
    volume.animate_pointer((more + "anisotropy/anisotropyRotation").c_str(), {0, 1}, {-20, 20});
    const Scene clamped = load(volume);
    const Material& material = clamped.materials[0];
    EXPECT_EQ(material.glass.attenuation_distance.values, (std::vector<double>{min_gltf_size, 2})) << "0 is none";
    EXPECT_EQ(material.glass.thickness.values, (std::vector<double>{0, 2}));
    EXPECT_EQ(material.layers.sheen_color.values[1], glm::dvec3(0, 0, 1));
    EXPECT_EQ(material.layers.anisotropy_rotation.values, (std::vector<double>{-20, 20}));
    EXPECT_EQ(clamped.source.warnings.size(), 3u);
}

TEST_F(GltfPointerTest, WhatIsNotSupportedIsNamed) {
    for (const char* pointer : {"/materials/0/alphaCutoff", "/materials/0/normalTexture/scale",
                                "/cameras/0/perspective/znear", "/nodes/0/weights/1",
                                "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/"
                                "offset",
                                "/materials/00/emissiveFactor", "/materials/+0/emissiveFactor", "/nodes//scale",
                                "/materials/0/emissiveFactor/0", "/"}) {
        GltfDraft draft = draft_with_everything();
        draft.animate_pointer(pointer, {0, 1}, {0, 1});
        const Scene scene = load(draft);
        EXPECT_TRUE(has_warning(scene, std::string("the animation of ") + pointer + " is not supported")) << pointer;
        EXPECT_EQ(scene.source.warnings.size(), 1u) << pointer;
    }
}

TEST_F(GltfPointerTest, KF29_TheFirstAnimationOfAPropertyWinsAndTheOthersAreNamed) {
    GltfDraft draft = draft_with_everything();
    draft.animate(0, "translation", {0, 1}, {0, 0, 0, 1, 0, 0});
    draft.animate(0, "translation", {0, 1}, {0, 0, 0, 0, 1, 0});
    draft.animate(0, "scale", {0, 1}, {1, 1, 1, 2, 2, 2});
    draft.animate_pointer("/nodes/0/translation", {0, 1}, {0, 0, 0, 0, 0, 1});
    draft.json["animations"][0]["name"] = "Walk";
    draft.json["animations"][1]["name"] = "Run";
    const Scene scene = load(draft);
    EXPECT_EQ(scene.nodes[0].transform.translation.values[1], glm::dvec3(1, 0, 0));
    EXPECT_EQ(scene.nodes[0].transform.scale.key_count(), 2u);
    EXPECT_EQ(scene.source.warnings.size(), 2u);
    EXPECT_TRUE(
        has_warning(scene, "1 of the 1 channels of \"Run\" are left out: \"Walk\" moves the same and comes first"));
    EXPECT_TRUE(has_warning(scene, "1 of the 1 channels of animation 3 are left out: \"Walk\""));
}

}  // namespace
}  // namespace aleph
