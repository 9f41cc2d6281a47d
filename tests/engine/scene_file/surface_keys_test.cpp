// The scene file: keys of volumes, coats, sheen, anisotropy, normal maps, and of the environment and its picture.

#include "engine/pose/pose.h"
#include "engine/scene_file/fields.h"
#include "engine/scene_file/tracks.h"
#include "tests/engine/scene_file/scene_texts.h"

namespace aleph {
namespace {

TEST(SceneJsonSurfaces, EveryNumberOfAMaterial) {
    const Scene scene = read(R"(, "materials": {"m": {"transmission": 1, "thickness": 0.5, "attenuation_distance": 0.25,
        "attenuation_color": [0.1, 0.2, 0.3], "clearcoat": 0.75, "clearcoat_roughness": 0.125, "sheen_color": [0.4, 0.5, 0.6],
        "sheen_roughness": 0.3, "anisotropy": 0.8, "anisotropy_rotation": -30, "normal_scale": -2,
        "clearcoat_normal_scale": 0.5}})");
    Material m;
    m.name = "m";
    m.glass.transmission = 1.0;
    m.glass.thickness = 0.5;
    m.glass.attenuation_distance = 0.25;
    m.glass.attenuation_color = glm::dvec3(0.1, 0.2, 0.3);
    m.layers.clearcoat = 0.75;
    m.layers.clearcoat_roughness = 0.125;
    m.layers.sheen_color = glm::dvec3(0.4, 0.5, 0.6);
    m.layers.sheen_roughness = 0.3;
    m.layers.anisotropy = 0.8;
    m.layers.anisotropy_rotation = to_radians(-30.0);
    m.textures.normal_scale = -2.0;
    m.textures.clearcoat_normal_scale = 0.5;
    EXPECT_EQ(scene.materials[0], m);
    EXPECT_EQ(again(scene), scene);
    EXPECT_EQ(
        read(R"(, "materials": {"m": {"anisotropy_rotation_radians": 0.1}})").materials[0].layers.anisotropy_rotation,
        Track<double>(0.1));
}

TEST(SceneJsonSurfaces, EveryTextureHasItsOwnKey) {
    const Scene scene = read(R"(, "materials": {"m": {"normal_texture": "0.png", "thickness_texture": "1.png",
        "clearcoat_texture": "2.png", "clearcoat_roughness_texture": "3.png", "clearcoat_normal_texture": "4.png",
        "sheen_color_texture": "5.png", "sheen_roughness_texture": "6.png",
        "anisotropy_texture": {"image": "7.png", "uv_set": 1}}})");
    const Material& m = scene.materials[0];
    const auto path = [&](const TextureRef& texture) { return scene.images.at(texture.image).path; };
    int number = 0;
    for (const TextureSlot slot : {TextureSlot::normal, TextureSlot::thickness, TextureSlot::clearcoat,
                                   TextureSlot::clearcoat_roughness, TextureSlot::clearcoat_normal,
                                   TextureSlot::sheen_color, TextureSlot::sheen_roughness, TextureSlot::anisotropy})
        EXPECT_EQ(path(m.textures[slot]), fmt::format("{}.png", number++));
    EXPECT_EQ(m.textures[TextureSlot::anisotropy].uv_set, 1);
    EXPECT_EQ(again(scene), scene);
}

TEST(SceneJsonEnvironment, APictureAloneHasTheFactorOne) {
    const SceneText text = read_scene_text(
        R"({"aleph": 1, "materials": {"m": {"base_color_texture": "a.png"}}, "environment_image": "sky.exr"})",
        "test.json");
    const Scene& scene = text.scene;
    ASSERT_EQ(scene.images.size(), 2u);
    EXPECT_EQ(scene.environment.image, 1);
    EXPECT_EQ(scene.images[1].path, "sky.exr");
    EXPECT_EQ(text.image_places[1], "/environment_image");
    EXPECT_EQ(scene.environment.radiance, Track<glm::dvec3>(glm::dvec3(1.0)));
    EXPECT_EQ(pose(scene, 0.0).environment_rotation, glm::dmat3(1.0));
    EXPECT_EQ(again(scene), scene);
}

TEST(SceneJsonEnvironment, ThePictureMayHaveANameAndAFactor) {
    const Scene scene = read(R"(, "images": {"other": "o.png", "sky": "sky.hdr"}, "environment_image": "sky",
        "environment": {"keys": [[0, [0, 0, 0]], [30, [2, 4, 8]]]}, "viewing": {"persistence": 0.1})");
    EXPECT_EQ(scene.environment.image, 1);
    EXPECT_EQ(scene.images.size(), 2u);
    EXPECT_EQ(pose(scene, 0.5).environment, Rgb(1.0f, 2.0f, 4.0f));
    EXPECT_EQ(scene.film.viewing, (ViewingConditions{31.0, 100.0, 0.1}));
    EXPECT_EQ(again(scene), scene);
}

TEST(SceneJsonEnvironment, ThePictureTurnsBeyondAHalfTurn) {
    const Scene scene = read(R"(, "environment_image": "sky.exr",
        "environment_rotation": {"axis": [0, 2, 0], "degrees": {"keys": [[0, 0], [60, 720]]}})");
    ASSERT_TRUE(scene.environment.axis_rotation.has_value());
    EXPECT_EQ(scene.environment.axis_rotation->axis, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 60}));
    EXPECT_TRUE(is_world_animated(scene));
    // A quarter turn about y after a quarter of a second: z goes to x. After half a second -z, as a half turn.
    const glm::dvec3 quarter = pose(scene, 0.25).environment_rotation * glm::dvec3(0.0, 0.0, 1.0);
    EXPECT_NEAR(quarter.x, 1.0, 1e-15);
    EXPECT_NEAR(quarter.z, 0.0, 1e-15);
    EXPECT_NEAR((pose(scene, 0.5).environment_rotation * glm::dvec3(0.0, 0.0, 1.0)).z, -1.0, 1e-15);
    EXPECT_EQ(again(scene), scene);
}

TEST(SceneJsonEnvironment, ThePictureTurnsByQuaternions) {
    const Scene still = read(R"(, "environment_image": "s.exr", "environment_rotation": [0, 1, 0, 0])");
    EXPECT_EQ(pose(still, 0.0).environment_rotation * glm::dvec3(1.0, 2.0, 3.0), glm::dvec3(-1.0, 2.0, -3.0));
    EXPECT_FALSE(is_world_animated(still));
    EXPECT_EQ(again(still), still);
    const Scene keyed = read(R"(, "environment_image": "s.exr",
        "environment_rotation": {"keys": [[0, [0, 0, 0, 1]], [30, [0, 0.6, 0, 0.8]]]})");
    EXPECT_EQ(keyed.environment.rotation.values[1], glm::dquat(0.8, 0.0, 0.6, 0.0));
    EXPECT_TRUE(is_world_animated(keyed));
    EXPECT_EQ(again(keyed), keyed);
}

}  // namespace
}  // namespace aleph
