// Meshes that are written to scene files: every bit of their floats, short texts, and what is refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "engine/base/errors.h"
#include "engine/scene_file/lists.h"
#include "engine/scene_file/scene_text.h"
#include "engine/surface/shapes.h"
#include "tests/engine/scene_file/written_again.h"
#include "tests/support/refusal.h"

namespace aleph {
namespace {

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
    mesh.points = 0;
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
    std::mt19937 random(5);
    for (int i = 0; i < 100000; ++i) {
        const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
        if (std::isfinite(value)) {
            EXPECT_EQ(static_cast<float>(widen(value)), value);
        }
    }
}

TEST(SceneJsonMeshes, AMeshOfAProgramIsSavedAsLists) {
    Scene scene;
    Shape torus;
    torus.kind = Shape::Kind::torus;
    torus.segments = 12;
    Mesh mesh = make_shape_mesh(torus, no_index, "bent");
    mesh.shape.reset();
    for (glm::vec3& p : mesh.positions) p.y += 0.1f * p.x * p.x;
    scene.meshes.push_back(mesh);
    EXPECT_EQ(again(scene), scene);
}

TEST(SceneJsonMeshes, MorphTargetsAndSkinsAreRefusedByName) {
    Scene scene;
    Mesh mesh = make_shape_mesh({}, no_index, "face");
    mesh.targets.push_back({"smile", {}, {}});
    mesh.target_weights.emplace_back(0.0);
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
