// How scenes are written as files: short for people, soon for programs; what the format cannot hold is refused.
// Meshes that are written to scene files: every bit of their floats, short texts, and what is refused.

#include <bit>

#include "engine/scene_file/fields.h"
#include "engine/scene_file/lists.h"
#include "engine/scene_file/scene_text.h"
#include "engine/surface/shapes.h"
#include "tests/engine/scene_file/scene_texts.h"

namespace aleph {
namespace {

TEST(SceneJsonWrite, NegativeZeroKeepsItsSign) {
    Scene scene = read_scene_text(R"({"aleph": 1, "nodes": [{}]})", "test.json").scene;
    scene.nodes[0].transform.translation = glm::dvec3(-0.0, 0.0, 1.0);  // not all zero: that is left out
    const glm::dvec3 loaded = again(scene).nodes[0].transform.translation.values[0];
    EXPECT_TRUE(loaded.x == 0.0 && std::signbit(loaded.x));
    EXPECT_FALSE(std::signbit(loaded.y));
}

TEST(SceneJsonWrite, SavedTextIsForPeople) {
    const Scene scene =
        read_scene_text(R"({"aleph": 1, "fps": 30, "materials": {"felt": {"base_color": [0.1, 0.4, 0.1]}},
        "meshes": {"ball": {"shape": {"type": "sphere", "radius": 0.0286}, "material": "felt"}},
        "nodes": [{"name": "ball 1", "mesh": "ball", "translation": {"keys": [[0, [0, 0.0286, 0]], [12, [1, 0.0286, 0.25]]]},
                   "rotation": {"axis": [0, 1, 0], "degrees": 45}}]})",
                        "test.json")
            .scene;
    EXPECT_EQ(write_scene_text(scene, "test.json"), R"({
  "aleph": 1,
  "fps": 30,
  "materials": {"felt": {"base_color": [0.1, 0.4, 0.1]}},
  "meshes": {"ball": {"shape": {"type": "sphere", "radius": 0.0286}, "material": "felt"}},
  "nodes": [
    {
      "name": "ball 1",
      "translation": {"keys": [[0, [0, 0.0286, 0]], [12, [1, 0.0286, 0.25]]]},
      "rotation": {"axis": [0, 1, 0], "degrees": 45},
      "mesh": "ball"
    }
  ]
}
)");
}

TEST(SceneJsonWrite, KF24_ChainOfAHundredThousandNodes) {
    Scene scene;
    for (int i = 0; i < 100000; ++i) {
        scene.nodes.push_back({.name = fmt::format("n{}", i),
                               .parent = i - 1,
                               .transform = {.translation = glm::dvec3(0.001 * i, 0.0, 0.0)}});
    }
    EXPECT_TRUE(again(scene) == scene);
}

// ordered_json looks for a key by linear search: filling an object by key would take quadratic time.
TEST(SceneJsonWrite, ManyNamesCostNoMoreThanTheyShould) {
    Scene scene;
    for (int i = 0; i < 30000; ++i) {
        scene.materials.emplace_back();
        scene.materials.back().name = fmt::format("{} of a material whose name is long", 30000 - i);
    }
    EXPECT_TRUE(again(scene) == scene);
}

/// A scene that can be saved; tests change it.
Scene make_good_scene() {
    return read_scene_text(
               R"({"aleph": 1, "nodes": [{"name": "a", "shape": {"type": "box"}, "material": {}, "light": {"type": "point"}},
        {"name": "b", "parent": "a", "camera": {}}]})",
               "test.json")
        .scene;
}

void expect_write_refused(const Scene& scene, const std::string& place, const std::string& word) {
    const Refusal found = find_refusal([&] { write_scene_text(scene, "out.json"); });
    EXPECT_EQ(found.file, "out.json");
    EXPECT_NE(found.place.find(place), std::string::npos) << place << ": " << found.message;
    EXPECT_NE(found.reason.find(word), std::string::npos) << found.message;
}

template <class Spoil>
void expect_spoiled(const Spoil& spoil, const std::string& place, const std::string& word) {
    Scene scene = make_good_scene();
    spoil(scene);
    expect_write_refused(scene, place, word);
}

TEST(SceneJsonWrite, WhatTheFormatCannotSayIsRefused) {
    EXPECT_EQ(again(make_good_scene()), make_good_scene());
    expect_spoiled([](Scene& s) { s.meshes[0].deformation.points = 0; }, "mesh 0", "points");
    expect_spoiled([](Scene& s) { s.meshes[0].uv[0].pop_back(), s.meshes[0].shape.reset(); }, "/meshes/a/shape/uv",
                   "one for each");
    expect_spoiled([](Scene& s) { s.meshes[0].shape.reset(), s.meshes[0].positions[3].x = float_nan; }, "", "finite");
    expect_spoiled([](Scene& s) { s.point_caches.emplace_back().name = "p"; }, "\"p\"", "no positions");
    expect_spoiled([](Scene& s) { s.cages.emplace_back().name = "c"; }, "c", "points -1, which belongs to an include");
    expect_spoiled(
        [](Scene& s) {
            PointCache& points = s.point_caches.emplace_back();
            points.name = "p";
            points.positions = {{{0, 0, 0}}};
            Cage& cage = s.cages.emplace_back();
            cage.name = "c";
            cage.faces.sizes = {5};
            cage.points = 0;
        },
        "c", "corners");
    expect_spoiled([](Scene& s) { s.meshes[0].positions[3].x += 1.0f; }, "mesh 0", "exactly");
    expect_spoiled([](Scene& s) { s.images.push_back({.name = "embedded", .path = "", .bytes = {}, .floats = {}}); },
                   "image", "path");
    expect_spoiled([](Scene& s) { s.nodes[1].name = "a"; }, "node 1", "name");
    expect_spoiled([](Scene& s) { s.nodes[0].name = ""; }, "node 1", "parent");
    expect_spoiled([](Scene& s) { s.materials[0].name = ""; }, "material 0", "name");
    expect_spoiled([](Scene& s) { s.nodes[0].parent = 1; }, "node 0", "1");
    expect_spoiled([](Scene& s) { s.nodes[0].meshes = {5}; }, "node 0", "mesh 5");
    expect_spoiled([](Scene& s) { s.nodes[1].camera = 5; }, "node 1", "camera 5");
    expect_spoiled([](Scene& s) { s.meshes[0].material = 1; }, "mesh 0", "material 1");
    expect_spoiled([&](Scene& s) { s.nodes[0].transform.translation = glm::dvec3(0.0, not_a_number, 0.0); },
                   "translation", "nan");
    expect_spoiled([&](Scene& s) { s.materials[0].gloss.roughness = infinity; }, "roughness", "inf");
    expect_spoiled([&](Scene& s) { s.film.exposure = not_a_number; }, "", "finite");
    expect_spoiled([&](Scene& s) { s.film.viewing.display_white = infinity; }, "", "finite");
    expect_spoiled([](Scene& s) { s.materials[0].gloss.roughness = 2.0; }, "/materials/a/roughness", "between 0 and 1");
    expect_spoiled([](Scene& s) { s.nodes[0].transform.rotation = glm::dquat(0, 0, 0, 0); }, "rotation", "zero");
    expect_spoiled([](Scene& s) { s.nodes[0].transform.scale.values.clear(); }, "scale", "no keys");
    expect_spoiled([](Scene& s) { s.nodes[0].visible = 0.5; }, "node 0", "exactly");
    expect_spoiled(
        [](Scene& s) {
            s.nodes[0].transform.axis_rotation = AxisRotation{{0, 2, 0}, {0.5}};
        },
        "node 0", "exactly");
    expect_spoiled([](Scene& s) { s.film.frame_rate = {0, 1}; }, "/fps", "whole number");
    expect_spoiled([](Scene& s) { s.source.settings["unheard_of"] = 1.0; }, "/settings/unheard_of", "unknown");
    expect_spoiled([](Scene& s) { s.source.name = "\xff\xfe"; }, "", "UTF-8");
    expect_spoiled([](Scene& s) { s.materials[0].textures.normal_scale = not_a_number; }, "", "finite");
    expect_spoiled([](Scene& s) { s.materials[0].glass.thickness = -1.0; }, "/materials/a/thickness", "at least 0");
    expect_spoiled([](Scene& s) { s.materials[0].layers.anisotropy_rotation = not_a_number; }, "anisotropy_rotation",
                   "nan");
    expect_spoiled([](Scene& s) { s.film.viewing.persistence = 2.0; }, "/viewing/persistence", "from 0 to 1");
    expect_spoiled([](Scene& s) { s.environment.image = 0, s.environment.radiance = glm::dvec3(1.0); },
                   "environment_image", "image 0, which");
    expect_spoiled(
        [](Scene& s) {
            s.images.push_back({.name = "sky", .path = "sky.exr", .bytes = {}, .floats = {}});
            s.environment.image = 0;
        },
        "environment_image", "needs `environment`");
    expect_spoiled([](Scene& s) { s.environment.rotation = glm::dquat(0, 1, 0, 0); }, "/environment_rotation",
                   "\"environment_image\", which is not given");
    expect_spoiled([](Scene& s) { s.source.includes = {{"b.glb", 1}, {"a.glb", 0}}; }, "includes", "exactly");
    expect_spoiled([](Scene& s) { s.source.includes = {{"a.glb", 9}}; }, "include 0", "node 9");
    expect_spoiled([](Scene& s) { s.source.includes = {{"/abs.glb", 0}}; }, "/nodes/0/include", "absolute");
    expect_spoiled([](Scene& s) { s.nodes[0].include = 0; }, "node 1", "after");
    expect_spoiled(
        [](Scene& s) {
            s.nodes[0].transform.scale.values = {glm::dvec3(1.0),
                                                 glm::dvec3(2.0)};  // times of an acyclic sampling left over
            s.nodes[0].transform.scale.sampling.times = {0.0, 1.0};
        },
        "node 0", "exactly");
}

TEST(SceneJsonMeshes, FloatsOfEveryKindComeBack) {
    std::mt19937 random(3);
    Scene scene;
    PointCache cache;
    cache.name = "cache";
    Mesh mesh;
    mesh.name = "mesh";
    const auto any = [&] {
        for (;;) {
            const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
            if (std::isfinite(value) && std::abs(value) <= 1e18f) return value;
        }
    };
    for (int sample = 0; sample < 3; ++sample) {
        auto& points = cache.positions.emplace_back();
        for (int i = 0; i < 1000; ++i) points.emplace_back(any(), any(), any());
        cache.sampling.times.push_back(sample * 0.1);
    }
    cache.sampling.kind = TimeSampling::Kind::acyclic;
    mesh.deformation.points = 0;
    mesh.positions = cache.positions[0];
    for (int i = 0; i < 1000; ++i) {
        mesh.normals.emplace_back(any(), any(), any());
        mesh.uv[0].emplace_back(any(), any());
        mesh.colors.emplace_back(any(), any(), any(), any());
        mesh.triangles.emplace_back(random() % 1000, random() % 1000, random() % 1000);
    }
    scene.point_caches.push_back(cache);
    scene.meshes.push_back(mesh);
    const std::string text = write_scene_text(scene, "test.json");
    EXPECT_TRUE(read_scene_text(text, "test.json").scene == scene);
    std::size_t lines = 0, max_length = 0, last = 0;
    for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', end + 1)) {
        max_length = std::max(max_length, end - last);
        last = end + 1;
        ++lines;
    }
    EXPECT_LE(max_length, 112u);
    EXPECT_LT(lines, text.size() / 90) << "long lists fill their lines";
}

TEST(SceneJsonMeshes, FloatsAreWrittenShort) {
    EXPECT_EQ(widen(0.1f), 0.1);
    EXPECT_EQ(widen(-1.0e-30f), -1.0e-30);
    EXPECT_EQ(widen(16777216.0f), 16777216.0);
}

TEST(SceneJsonMeshes, MorphTargetsAndSkinsAreRefusedByName) {
    Scene scene;
    Mesh mesh = make_shape_mesh({}, no_index, "face");
    mesh.deformation.targets.emplace_back();
    mesh.deformation.target_weights.emplace_back(0.0);
    scene.meshes.push_back(mesh);
    const Refusal found = find_refusal([&] { write_scene_text(scene, "out.json"); });
    EXPECT_NE(found.place.find("\"face\""), std::string::npos);
    EXPECT_NE(found.reason.find(".glb"), std::string::npos);
    scene.meshes.clear();
    scene.skins.emplace_back().name = "bones";
    EXPECT_THROW(write_scene_text(scene, "out.json"), InputError);
}

}  // namespace
}  // namespace aleph
