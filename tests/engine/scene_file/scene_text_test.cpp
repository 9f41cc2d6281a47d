// The scene file: the meaning of the keys of its head, materials, textures, cameras, lights and includes.

#include "engine/scene_file/scene_text.h"
#include "engine/pose/pose.h"
#include "engine/scene_file/tracks.h"
#include "tests/engine/scene_file/scene_texts.h"

namespace aleph {
namespace {

TEST(SceneJson, SmallestFileIsAnEmptyScene) {
    EXPECT_EQ(read(""), Scene{});
}

TEST(SceneJson, Header) {
    const Scene scene = read(R"(, // comments of both kinds
        "$schema": "scene.schema.json", "name": "töst", "fps": "30000/1001", "frames": [-3, 59], "cuts": [10, 30], /* here */
        "viewing": {"pixels_per_degree": 62.5, "display_white": 80, "persistence": 0.5}, "exposure": 0.25, "environment": [0.5, 1, 2])");
    EXPECT_EQ(scene.source.name, "töst");
    EXPECT_EQ(scene.film.frame_rate, (FrameRate{30000, 1001}));
    EXPECT_EQ(scene.film.range, (FrameRange{-3, 59}));
    EXPECT_EQ(scene.film.cuts, (std::vector<std::int64_t>{10, 30}));
    EXPECT_EQ(scene.film.viewing, (ViewingConditions{62.5, 80.0, 0.5}));
    EXPECT_EQ(scene.film.exposure, 0.25);
    EXPECT_EQ(scene.environment.radiance, Track<glm::dvec3>(glm::dvec3(0.5, 1.0, 2.0)));
    EXPECT_EQ(read(", \"fps\": 24").film.frame_rate, (FrameRate{24, 1}));
}

TEST(SceneJson, SettingsKeepTheirTypes) {
    const SettingMap settings =
        read(
            R"(, "settings": {"accuracy": 0.1, "gather": 512, "guide": "full", "neutral_opponent": true, "size": "320x240"})")
            .source.settings;
    EXPECT_EQ(settings, (SettingMap{{"accuracy", 0.1},
                                    {"gather", 512.0},
                                    {"guide", std::string("full")},
                                    {"neutral_opponent", true},
                                    {"size", std::string("320x240")}}));
}

TEST(SceneJson, MaterialsStandInTheOrderOfTheFileAndMetalIsNotTheDefault) {
    const Scene scene =
        read(R"(, "materials": {"z": {}, "a": {"base_color": [0.1, 0.2, 0.3], "alpha": 0.5, "metallic": 1,
        "roughness": 0.25, "specular": 0, "specular_color": [2, 1, 0], "ior": 1.33, "emission": [3, 4, 5],
        "emission_strength": 10, "double_sided": true}})");
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.materials[0].name, "z");
    Material plain{.name = "z", .gloss = {.metallic = 0.0}};
    EXPECT_EQ(scene.materials[0], plain);
    Material a;
    a.name = "a";
    a.base_color = glm::dvec3(0.1, 0.2, 0.3);
    a.opacity.alpha = 0.5;
    a.gloss.metallic = 1.0;
    a.gloss.roughness = 0.25;
    a.gloss.specular = 0.0;
    a.gloss.specular_color = glm::dvec3(2, 1, 0);
    a.gloss.ior = 1.33;
    a.glow.color = glm::dvec3(3, 4, 5);
    a.glow.strength = 10.0;
    a.double_sided = true;
    EXPECT_EQ(scene.materials[1], a);
}

TEST(SceneJson, TexturesShareImages) {
    const SceneText text = read_scene_text(R"({"aleph": 1, "images": {"felt": "a/felt.png"}, "materials": {"m": {
        "base_color_texture": "felt", "emission_texture": "a/felt.png", "specular_texture": "b.exr",
        "metallic_roughness_texture": {"image": "felt", "uv_set": 1, "wrap": ["clamp", "mirror"], "filter": "nearest"},
        "specular_color_texture": {"image": "../b.exr", "wrap": "mirror"}}}})",
                                           "test.json");
    const Scene& scene = text.scene;
    ASSERT_EQ(scene.images.size(), 3u);
    EXPECT_EQ(scene.images[0].name, "felt");
    EXPECT_EQ(scene.images[0].path, "a/felt.png");
    EXPECT_EQ(scene.images[1].path, "b.exr");
    EXPECT_EQ(scene.images[2].path, "../b.exr");
    EXPECT_EQ(text.image_places, (std::vector<std::string>{"/images/felt", "/materials/m/specular_texture",
                                                           "/materials/m/specular_color_texture/image"}));
    const Material& m = scene.materials[0];
    EXPECT_EQ(m.textures[TextureSlot::base_color], (TextureRef{.image = 0}));
    EXPECT_EQ(m.textures[TextureSlot::emission], (TextureRef{.image = 0}));
    EXPECT_EQ(m.textures[TextureSlot::specular], (TextureRef{.image = 1}));
    EXPECT_EQ(m.textures[TextureSlot::metallic_roughness], (TextureRef{0, 1, Wrap::clamp, Wrap::mirror, true}));
    EXPECT_EQ(m.textures[TextureSlot::specular_color], (TextureRef{2, 0, Wrap::mirror, Wrap::mirror, false}));
    EXPECT_EQ(again(scene), scene);
}

TEST(SceneJson, CamerasAndLights) {
    const Scene scene =
        read(R"(, "cameras": {"main": {"fov": 90, "near": 0.5, "shutter": [-0.25, 0.25], "aperture": 0.01, "focus": 3},
          "flat": {"orthographic": true, "half_height": 2}},
        "lights": {"key": {"type": "point", "color": [1, 0.5, 0], "intensity": 40, "range": 9}, "sun": {"type": "directional"}})");
    ASSERT_EQ(scene.cameras.size(), 2u);
    Camera main;
    main.name = "main";
    main.fov = to_radians(90.0);
    main.near_plane = 0.5;
    main.shutter = {-0.25, 0.25};
    main.aperture = 0.01;
    main.focus_distance = 3.0;
    EXPECT_EQ(scene.cameras[0], main);
    EXPECT_NEAR(scene.cameras[0].fov.values[0], std::numbers::pi / 2.0, 1e-15);
    EXPECT_TRUE(scene.cameras[1].orthographic);
    EXPECT_EQ(scene.cameras[1].half_height, Track<double>(2.0));
    EXPECT_EQ(scene.lights[0].intensity, Track<double>(40.0));
    EXPECT_EQ(scene.lights[0].range, 9.0);
    EXPECT_EQ(scene.lights[1].kind, Light::Kind::directional);
}

TEST(SceneJson, AnAlphaCutoffAboveOneCutsOutEverythingAsInGltf) {
    const Scene scene = read(R"(, "materials": {"m": {"alpha_mode": "mask", "alpha_cutoff": 1.5}})");
    EXPECT_EQ(scene.materials[0].opacity.cutoff, 1.5);
    EXPECT_EQ(again(scene), scene);
}

TEST(SceneJson, SpotLightsShiftedLensesAndWhatMaterialsDo) {
    const Scene scene =
        read(R"(, "lights": {"s": {"type": "spot", "inner_cone": 20, "outer_cone": {"keys": [[0, 30], [30, 60]]},
          "range": {"keys": [[0, 5], [30, 0]]}}},
        "cameras": {"c": {"shift_x": 0.25, "shift_y": {"keys": [[0, 0], [10, -1]]}}},
        "materials": {"m": {"transmission": 0.75, "transmission_texture": "t.png", "alpha_mode": "mask", "alpha_cutoff": 0.25,
          "unlit": true, "base_color_texture": {"image": "t.png", "offset": [0.5, 0.25], "scale": [2, -3], "rotation": 90}}})");
    EXPECT_EQ(scene.lights[0].kind, Light::Kind::spot);
    EXPECT_EQ(scene.lights[0].inner_cone, Track<double>(to_radians(20.0)));
    EXPECT_EQ(scene.lights[0].outer_cone.values, (std::vector<double>{to_radians(30.0), to_radians(60.0)}));
    EXPECT_EQ(scene.lights[0].range.values, (std::vector<double>{5.0, 0.0}));
    EXPECT_EQ(scene.cameras[0].shift_x, Track<double>(0.25));
    EXPECT_EQ(scene.cameras[0].shift_y.values, (std::vector<double>{0.0, -1.0}));
    const Material& m = scene.materials[0];
    EXPECT_EQ(m.glass.transmission, Track<double>(0.75));
    EXPECT_EQ(m.textures[TextureSlot::transmission], (TextureRef{.image = 0}));
    EXPECT_EQ(m.opacity.mode, Opacity::Mode::mask);
    EXPECT_EQ(m.opacity.cutoff, 0.25);
    EXPECT_TRUE(m.unlit);
    EXPECT_EQ(m.textures[TextureSlot::base_color].uv_offset, glm::dvec2(0.5, 0.25));
    EXPECT_EQ(m.textures[TextureSlot::base_color].uv_scale, glm::dvec2(2.0, -3.0));
    EXPECT_EQ(m.textures[TextureSlot::base_color].uv_rotation, to_radians(90.0));
    EXPECT_EQ(again(scene), scene);
}

TEST(SceneJson, IncludesAreNamedInOrder) {
    const SceneText text = read_scene_text(
        R"({"aleph": 1, "include": "z.glb", "nodes": [{}, {"name": "t", "include": ["a.gltf", "../lib/b.glb"]}]})",
        "t.json");
    EXPECT_EQ(text.scene.source.includes,
              (std::vector<Include>{{"a.gltf", 1}, {"../lib/b.glb", 1}, {"z.glb", no_index}}));
    EXPECT_EQ(text.include_places, (std::vector<std::string>{"/nodes/1/include/0", "/nodes/1/include/1", "/include"}));
    EXPECT_EQ(again(text.scene), text.scene);
}

TEST(SceneJson, CamerasTakeTurns) {
    const auto read_keys = [](const char* keys) { return read(std::string(R"(, "camera": {"keys": )") + keys + "}"); };
    EXPECT_EQ(read_keys(R"([[-2, "wide"], [40, "close"]])").film.camera_keys,
              (std::vector<CameraKey>{{-2, "wide"}, {40, "close"}}));
    EXPECT_EQ(frame_range(read_keys(R"([[-2, "wide"], [40, "close"]])")), (FrameRange{-2, 40}));
    expect_all_refused({
        scene(R"("camera": {"keys": [[0, "a"], [0, "b"]]})", "/camera/keys/1", "key times have to ascend"),
        scene(R"("camera": {"keys": [[0.5, "a"]]})", "/camera", "a name"),
        scene(R"("camera": {"keys": []})", "/camera", "a name"),
        scene(R"("camera": {"keys": [[0, "a", 1]]})", "/camera", "a name"),
    });
}

}  // namespace
}  // namespace aleph
