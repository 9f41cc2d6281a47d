// Animated files made by other programs, against poses worked out from tinygltf's raw parse.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>

#include "engine/gltf/gltf.h"
#include "engine/pose/pose.h"
#include "tests/support/paths.h"
#include "tests/unit/engine/gltf/raw_gltf.h"

namespace aleph {
namespace {

const fs::path assets = assets_folder() / "gltf";

Scene load(const fs::path& name) {
    Scene scene;
    append_gltf(assets / name, scene, no_index, 0);
    return scene;
}

#define SKIP_WITHOUT(name) \
    if (!fs::exists(assets / (name))) GTEST_SKIP() << missing_asset(assets / (name))

/// Cubic keys of a rotation are floats, off from length 1 by 6e-8; the reader scales them, the formula above does not.
constexpr double pose_tolerance = 1e-8;

/// Every node of the scene, by its name, at times on keys, between them and outside.
void expect_same_poses(const fs::path& name, const std::vector<double>& times) {
    const Raw raw(name);
    const Scene scene = load(name);
    for (const double seconds : times) {
        const std::vector<glm::dmat4> expected = world_matrices(raw, seconds);
        const ScenePose frame = pose(scene, seconds);
        ASSERT_EQ(frame.world.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
            const std::string& own = raw.model.nodes[i].name;
            const std::string node_name = own.empty() ? std::string("node").append(std::to_string(i)) : own;
            const auto node = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                           [&](const Node& n) { return n.name == node_name; });
            ASSERT_NE(node, scene.nodes.end()) << node_name;
            const glm::dmat4& found = frame.world[node - scene.nodes.begin()];
            for (int k = 0; k < 16; ++k) {
                const double size = std::max(1.0, std::abs(expected[i][k / 4][k % 4]));
                EXPECT_NEAR(found[k / 4][k % 4], expected[i][k / 4][k % 4], pose_tolerance * size)
                    << node_name << " at " << seconds << " s, element " << k;
            }
        }
    }
}

TEST(GltfPoses, KF07_InterpolationTestStepLinearCubic) {
    SKIP_WITHOUT("InterpolationTest/InterpolationTest.gltf");
    expect_same_poses("InterpolationTest/InterpolationTest.gltf",
                      {-1.0, 0.0, 0.1, 0.5, 0.75, 0.9999, 1.0, 1.3, 1.5, 1.99, 2.0, 10.0});
}

TEST(GltfPoses, ParentInverseAnimation) {
    SKIP_WITHOUT("06_parent-inverse-anim/06_parent-inverse-anim.gltf");
    expect_same_poses("06_parent-inverse-anim/06_parent-inverse-anim.gltf", {0.0, 0.1, 0.77, 1.5, 2.6, 4.0});
}

TEST(GltfPoses, LightCameraAnimations) {
    SKIP_WITHOUT("lightCameraAnimations/lightCameraAnimations.gltf");
    expect_same_poses("lightCameraAnimations/lightCameraAnimations.gltf", {0.0, 0.05, 1.0, 2.34, 3.75, 5.0});
}

TEST(GltfPoses, FoxSurveysAndItsOtherAnimationsAreNamed) {
    SKIP_WITHOUT("Fox.glb");
    expect_same_poses("Fox.glb", {0.0, 0.31, 1.7, 3.4166667461395264, 9.0});
    const Scene scene = load("Fox.glb");
    ASSERT_EQ(scene.skins.size(), 1u);
    EXPECT_EQ(scene.skins[0].joints.size(), 24u);
    EXPECT_EQ(scene.meshes[0].joints_per_vertex, 4);
    EXPECT_EQ(scene.meshes[0].triangles.size(), 576u);  // 1728 vertices, no indices
    EXPECT_TRUE(scene.meshes[0].normals.empty());
    const auto warns = [&](const std::string& text) {
        return std::any_of(scene.warnings.begin(), scene.warnings.end(),
                           [&](const std::string& warning) { return warning.find(text) != std::string::npos; });
    };
    EXPECT_TRUE(warns("\"Walk\" are left out: \"Survey\" moves the same"));
    EXPECT_TRUE(warns("\"Run\" are left out: \"Survey\" moves the same"));
}

/// Points of a mesh in world space, as pose gives them.
std::vector<glm::dvec3> world_points(const ScenePose& frame, std::size_t mesh) {
    std::vector<glm::dvec3> points;
    for (const Instance& instance : frame.instances) {
        if (instance.mesh != static_cast<int>(mesh)) continue;
        for (const glm::dvec3& p : frame.meshes[mesh].positions) {
            points.emplace_back(frame.world[instance.node] * glm::dvec4(p, 1.0));
        }
    }
    return points;
}

/// glTF 2.0, 3.7.3: world = sum of weight * joint's world * inverse bind, the mesh's own node left out.
void expect_same_skin(const fs::path& name, const std::vector<double>& times) {
    const Raw raw(name);
    const Scene scene = load(name);
    const gltf::Primitive& primitive = raw.model.meshes[0].primitives[0];
    const gltf::Skin& skin = raw.model.skins[0];
    const std::vector<double> points = raw.floats(primitive.attributes.at("POSITION"));
    const std::vector<double> weights = raw.floats(primitive.attributes.at("WEIGHTS_0"));
    const std::vector<double> binds = raw.floats(skin.inverseBindMatrices);
    const gltf::Accessor& accessor = raw.model.accessors[primitive.attributes.at("JOINTS_0")];
    const gltf::BufferView& view = raw.model.bufferViews[accessor.bufferView];
    ASSERT_EQ(accessor.componentType, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
    std::vector<std::uint16_t> joints(accessor.count * 4);
    const auto stride = static_cast<std::size_t>(accessor.ByteStride(view));
    const auto& buffer = raw.model.buffers[view.buffer].data;
    for (std::size_t i = 0; i < accessor.count; ++i) {
        std::memcpy(&joints[4 * i], &buffer.at(view.byteOffset + accessor.byteOffset + i * stride), 8);
    }
    for (const double seconds : times) {
        const std::vector<glm::dmat4> world = world_matrices(raw, seconds);
        std::vector<glm::dmat4> carriers;
        for (std::size_t j = 0; j < skin.joints.size(); ++j) {
            glm::dmat4 bind;
            for (int k = 0; k < 16; ++k) bind[k / 4][k % 4] = binds[16 * j + static_cast<std::size_t>(k)];
            carriers.push_back(world[skin.joints[j]] * bind);
        }
        const std::vector<glm::dvec3> found = world_points(pose(scene, seconds), 0);
        ASSERT_EQ(found.size(), points.size() / 3);
        for (std::size_t i = 0; i < found.size(); ++i) {
            const glm::dvec4 point(points[3 * i], points[3 * i + 1], points[3 * i + 2], 1.0);
            glm::dvec3 sum(0.0);
            double total = 0.0;
            for (std::size_t k = 0; k < 4; ++k) {
                sum += weights[4 * i + k] * glm::dvec3(carriers[joints[4 * i + k]] * point);
                total += weights[4 * i + k];
            }
            sum /= total;
            // Weights are kept as floats after they are brought to a sum of 1.
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[i][k], sum[k], 5e-7 * std::max(1.0, glm::length(sum))) << i;
        }
    }
}

TEST(GltfPoses, SimpleSkinPoints) {
    SKIP_WITHOUT("SimpleSkin.gltf");
    expect_same_skin("SimpleSkin.gltf", {0.0, 0.25, 1.0, 2.2, 5.5});
}

TEST(GltfPoses, FoxPoints) {
    SKIP_WITHOUT("Fox.glb");
    expect_same_skin("Fox.glb", {0.0, 1.234});
}

/// Rest plus weighted displacements, in double; normals likewise, then unit.
TEST(GltfPoses, AnimatedMorphCubeAtKeysAndBetween) {
    const fs::path name = "AnimatedMorphCube/AnimatedMorphCube.gltf";
    SKIP_WITHOUT(name);
    const Raw raw(name);
    const Scene scene = load(name);
    ASSERT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.meshes[0].targets.size(), 2u);
    const gltf::Animation& animation = raw.model.animations[0];
    const Keys weights(raw, animation, animation.channels[0], 2);
    ASSERT_EQ(weights.times.size(), 127u);
    const gltf::Primitive& primitive = raw.model.meshes[0].primitives[0];
    const std::vector<double> rest = raw.floats(primitive.attributes.at("POSITION"));
    const std::vector<double> normals = raw.floats(primitive.attributes.at("NORMAL"));
    std::vector<std::vector<double>> moves, turns;
    for (const auto& target : primitive.targets) {
        moves.push_back(raw.floats(target.at("POSITION")));
        turns.push_back(raw.floats(target.at("NORMAL")));
    }
    double largest_weight = 0.0;
    const double between = 0.5 * (weights.times[40] + weights.times[41]);
    for (const double seconds : {weights.times[0], weights.times[40], between, weights.times[90], 3.21, 99.0}) {
        const std::vector<double> w = weights.at(seconds);
        largest_weight = std::max({largest_weight, w[0], w[1]});
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_NEAR(evaluate(scene.meshes[0].target_weights[k], seconds), w[k], 1e-12) << seconds;
        }
        const PosedMesh posed = pose(scene, seconds).meshes[0];
        ASSERT_EQ(posed.positions.size(), rest.size() / 3);
        ASSERT_EQ(posed.normals.size(), rest.size() / 3);
        for (std::size_t i = 0; i < rest.size() / 3; ++i) {
            glm::dvec3 point, normal;
            for (int k = 0; k < 3; ++k) {
                const std::size_t at = 3 * i + static_cast<std::size_t>(k);
                point[k] = rest[at] + w[0] * moves[0][at] + w[1] * moves[1][at];
                normal[k] = normals[at] + w[0] * turns[0][at] + w[1] * turns[1][at];
                EXPECT_NEAR(posed.positions[i][k], point[k], 1e-12) << seconds;
            }
            normal = glm::normalize(normal);
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(posed.normals[i][k], normal[k], 1e-6) << seconds;
        }
    }
    EXPECT_GT(largest_weight, 0.5) << "nothing morphs at these times, so nothing is compared";
}

TEST(GltfPoses, BoxSparseMorphsFromOneToTwoSeconds) {
    SKIP_WITHOUT("box_sparse.glb");
    const Scene scene = load("box_sparse.glb");
    const Track<double>& weight = scene.meshes[0].target_weights.at(0);
    EXPECT_EQ(weight.sampling.times, (std::vector<double>{1.0, 2.0}));
    EXPECT_EQ(weight.values, (std::vector<double>{0.0, 1.0}));  // the 1 is the sparse value, the 0 its absent base
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("byteOffset means nothing"), std::string::npos);
}

TEST(GltfPoses, CamerasHasAWarning) {
    SKIP_WITHOUT("Cameras.gltf");
    const Scene scene = load("Cameras.gltf");
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("the rotation quaternion has length 0.948683"), std::string::npos);
}

}  // namespace
}  // namespace aleph
