// Files made by other programs: each loads, or is refused for the reason given here.
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>
#include <string>

#include "engine/base/errors.h"
#include "engine/gltf/gltf.h"
#include "engine/pose/pose.h"
#include "tests/support/paths.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

const fs::path assets = assets_folder();

Scene load(const std::string& name) {
    Scene scene;
    append_gltf(assets / name, scene, no_index, 0);
    return scene;
}

#define SKIP_WITHOUT(name) \
    if (!fs::exists(assets / (name))) GTEST_SKIP() << missing_asset(assets / (name))

TEST(GltfAssets, MilkTruckHasItsWheelsTwiceAndTurning) {
    SKIP_WITHOUT("gltf/CesiumMilkTruck.glb");
    const Scene scene = load("gltf/CesiumMilkTruck.glb");
    ASSERT_EQ(scene.nodes.size(), 5u);
    ASSERT_EQ(scene.meshes.size(), 4u);  // three primitives of the truck, one wheel
    EXPECT_EQ(scene.materials.size(), 4u);
    ASSERT_EQ(scene.images.size(), 1u);  // two textures of one image
    EXPECT_EQ(scene.images[0].bytes.width, 2048);
    EXPECT_EQ(scene.images[0].bytes.height, 2048);
    EXPECT_EQ(scene.materials[0].base_color_texture.image, 0);
    EXPECT_EQ(scene.materials[1].base_color_texture.image, no_index);
    EXPECT_EQ(scene.materials[1].metallic, Track<double>(0.0));

    std::vector<int> wheels;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        EXPECT_LT(scene.nodes[i].parent, static_cast<int>(i));
        if (scene.nodes[i].meshes == std::vector<int>{3}) wheels.push_back(static_cast<int>(i));
    }
    ASSERT_EQ(wheels.size(), 2u);
    const Track<glm::dquat>& turn = scene.nodes[wheels[0]].rotation;
    EXPECT_EQ(turn.key_count(), 31u);
    EXPECT_EQ(first_time(turn), 0.0);
    EXPECT_EQ(last_time(turn), 1.25);
    // The wheel's axle lies where the parent's matrix puts it, at every time.
    for (const double seconds : {0.0, 0.3, 1.25}) {
        const ScenePose frame = pose(scene, seconds);
        const glm::dvec4 axle = frame.world[wheels[0]][3];
        EXPECT_DOUBLE_EQ(std::abs(axle.x), axle.x > 0 ? 1.432669997215271 : 1.352329969406128);
        EXPECT_DOUBLE_EQ(axle.y, 0.4277220070362091);
    }
    const ScenePose start = pose(scene, 0.0), later = pose(scene, 0.3);
    EXPECT_NE(start.world[wheels[0]], later.world[wheels[0]]);
    EXPECT_EQ(start.world[0], later.world[0]);
}

TEST(GltfAssets, CornellBoxHasItsLampAndColours) {
    SKIP_WITHOUT("gltf/CornellBox.glb");
    const Scene scene = load("gltf/CornellBox.glb");
    ASSERT_EQ(scene.nodes.size(), 4u);
    ASSERT_EQ(scene.meshes.size(), 6u);
    EXPECT_EQ(scene.nodes[3].meshes, (std::vector<int>{3, 4, 5}));
    ASSERT_EQ(scene.materials.size(), 5u);
    EXPECT_EQ(scene.materials[0].emission, Track<glm::dvec3>(glm::dvec3(1.0)));
    EXPECT_EQ(scene.materials[0].emission_strength, Track<double>(100.0));
    EXPECT_TRUE(scene.materials[0].double_sided);
    EXPECT_EQ(scene.materials[3].base_color, Track<glm::dvec3>(glm::dvec3(0.5, 0.0, 0.0)));
    EXPECT_FALSE(scene.meshes[0].colors.empty());
    EXPECT_FALSE(scene.meshes[0].uv[1].empty());
    EXPECT_TRUE(scene.meshes[1].colors.empty());
    EXPECT_EQ(scene.nodes[0].translation, Track<glm::dvec3>(glm::dvec3(-278, 547.9134521484375, -279.5)));
}

TEST(GltfAssets, RoomHasLambertSurfacesLampAndCamera) {
    SKIP_WITHOUT("room/room.glb");
    const Scene scene = load("room/room.glb");
    EXPECT_EQ(scene.nodes.size(), 60u);
    EXPECT_EQ(scene.meshes.size(), 83u);  // 58 in the file, some of several primitives
    ASSERT_EQ(scene.materials.size(), 24u);
    EXPECT_EQ(scene.materials[0].specular, Track<double>(0.0));
    EXPECT_EQ(scene.cameras.size(), 1u);
    int emitters = 0;
    for (const Material& material : scene.materials) {
        if (material.emission.values[0] != glm::dvec3(0.0)) ++emitters;
    }
    EXPECT_GE(emitters, 1);
    for (const Mesh& mesh : scene.meshes) EXPECT_TRUE(mesh.normals.empty());
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
}

TEST(GltfAssets, InterleavedBox) {
    SKIP_WITHOUT("gltf/BoxInterleaved.glb");
    const Scene scene = load("gltf/BoxInterleaved.glb");
    ASSERT_EQ(scene.meshes.size(), 1u);
    const Mesh& box = scene.meshes[0];
    EXPECT_EQ(box.triangles.size(), 12u);
    ASSERT_EQ(box.positions.size(), 24u);
    for (std::size_t i = 0; i < box.positions.size(); ++i) {
        for (int k = 0; k < 3; ++k) EXPECT_EQ(std::abs(box.positions[i][k]), 0.5f);
        EXPECT_EQ(glm::length(box.normals[i]), 1.0f);
        EXPECT_EQ(glm::dot(box.positions[i], box.normals[i]), 0.5f);
    }
}

TEST(GltfAssets, Cameras) {
    SKIP_WITHOUT("gltf/Cameras.gltf");
    const Scene scene = load("gltf/Cameras.gltf");
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_FALSE(scene.cameras[0].orthographic);
    EXPECT_EQ(scene.cameras[0].fov, Track<double>(0.7));
    EXPECT_TRUE(scene.cameras[1].orthographic);
    EXPECT_EQ(scene.cameras[1].half_height, Track<double>(1.0));
}

TEST(GltfAssets, LightAndCameraMove) {
    SKIP_WITHOUT("gltf/lightCameraAnimations/lightCameraAnimations.gltf");
    const Scene scene = load("gltf/lightCameraAnimations/lightCameraAnimations.gltf");
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].kind, Light::Kind::point);
    const ScenePose first = pose(scene, 0.0), last = pose(scene, 100.0);
    ASSERT_EQ(first.lights.size(), 1u);
    ASSERT_EQ(first.cameras.size(), 1u);
    EXPECT_NE(first.lights[0].position, last.lights[0].position);
    EXPECT_NE(first.cameras[0].position, last.cameras[0].position);
}

/// The arrows of this model point at their targets only if matrices and rotations are read the right way round.
TEST(GltfAssets, OrientationTestArrowsPointAtTheirTargets) {
    SKIP_WITHOUT("gltf/OrientationTest.glb");
    const Scene scene = load("gltf/OrientationTest.glb");
    const ScenePose frame = pose(scene, 0.0);
    const auto world_mean = [&](const std::string& name) {
        for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
            if (scene.nodes[i].name != name) continue;
            const Mesh& mesh = scene.meshes[scene.nodes[i].meshes.at(0)];
            glm::dvec3 sum(0.0);
            for (const glm::vec3& p : mesh.positions) sum += glm::dvec3(frame.world[i] * glm::dvec4(p, 1.0));
            return sum / static_cast<double>(mesh.positions.size());
        }
        ADD_FAILURE() << "no node " << name;
        return glm::dvec3(0.0);
    };
    for (const std::string axis : {"X", "Y", "Z"}) {
        for (const std::string side : {"1", "2"}) {
            const glm::dvec3 arrow = world_mean("Arrow" + axis + side), target = world_mean("Target" + axis + side);
            // Seen from the base at the origin, arrow and target lie in one direction across the arrow's axis.
            const int k = axis[0] - 'X';
            glm::dvec3 a = arrow, t = target;
            a[k] = t[k] = 0.0;
            EXPECT_GT(glm::dot(glm::normalize(a), glm::normalize(t)), 0.999) << axis << side;
        }
    }
}

struct Verdict {
    const char* file;
    const char* refused_for;  ///< word in the message; empty: it loads
};

class GltfAssetVerdict : public testing::TestWithParam<Verdict> {};

TEST_P(GltfAssetVerdict, IsAsExpected) {
    const Verdict& verdict = GetParam();
    SKIP_WITHOUT(verdict.file);
    try {
        load(verdict.file);
        EXPECT_STREQ(verdict.refused_for, "");
    } catch (const InputError& error) {
        ASSERT_STRNE(verdict.refused_for, "") << error.what();
        EXPECT_NE(std::string(error.what()).find(verdict.refused_for), std::string::npos) << error.what();
        EXPECT_EQ(error.file(), (assets / verdict.file).string());
    }
}

INSTANTIATE_TEST_SUITE_P(
    All, GltfAssetVerdict,
    testing::Values(Verdict{"gltf/BoxInterleaved.glb", ""}, Verdict{"gltf/BoxVertexColors.glb", ""},
                    Verdict{"gltf/Cameras.gltf", ""}, Verdict{"gltf/CesiumMilkTruck.glb", ""},
                    Verdict{"gltf/CompareRoughness.glb", ""}, Verdict{"gltf/CornellBox.glb", ""},
                    Verdict{"gltf/OrientationTest.glb", ""}, Verdict{"room/room.glb", ""},
                    Verdict{"gltf/lightCameraAnimations/lightCameraAnimations.gltf", ""}, Verdict{"gltf/Fox.glb", ""},
                    Verdict{"gltf/SimpleSkin.gltf", ""}, Verdict{"gltf/RecursiveNodes.gltf", "cycle"},
                    Verdict{"gltf/TriangleWithoutIndices.gltf", ""}, Verdict{"gltf/box_sparse.glb", ""},
                    Verdict{"gltf/06_parent-inverse-anim/06_parent-inverse-anim.gltf", ""},
                    Verdict{"gltf/09_texture_transform/09_texture_transform.gltf", ""},
                    Verdict{"gltf/AnimatedMorphCube/AnimatedMorphCube.gltf", ""},
                    Verdict{"gltf/InterpolationTest/InterpolationTest.gltf", ""}));

}  // namespace
}  // namespace aleph
