// Poses of nodes, skins and morph targets of whole files, against tinygltf's raw parse and glTF's formulas.
#include "engine/pose/pose.h"
#include "tests/engine/gltf/model_files.h"
#include "tests/engine/gltf/raw_gltf.h"

namespace aleph {
namespace {

class GltfPoses : public testing::TestWithParam<ModelFile> {
  protected:
    const Raw raw{GetParam().path};
    const Scene scene = load_model(GetParam().path);
    const std::vector<double> times = query_times();

  private:
    /// Before, after and between the keys of all animations, and on some keys.
    std::vector<double> query_times() const {
        std::vector<double> keys;
        for (const gltf::Animation& animation : raw.model.animations)
            for (const gltf::AnimationSampler& sampler : animation.samplers)
                for (const double seconds : raw.floats(sampler.input)) keys.push_back(seconds);
        if (keys.empty()) return {0.0};
        std::ranges::sort(keys);
        const double first = keys.front(), last = keys.back();
        std::vector<double> result{first - 1.0, last + 1.0};
        for (int i = 0; i <= 11; ++i) result.push_back(first + (last - first) * i / 11.0);
        for (std::size_t i = 0; i < 8; ++i) result.push_back(keys[i * (keys.size() - 1) / 7]);
        return result;
    }
};

class GltfSkins : public GltfPoses {};
class GltfMorphs : public GltfPoses {};

const auto name_of = [](const auto& file) { return model_name(file.param.path); };
INSTANTIATE_TEST_SUITE_P(All, GltfPoses, testing::ValuesIn(model_files(true)), name_of);
INSTANTIATE_TEST_SUITE_P(All, GltfSkins, testing::ValuesIn(model_files_named({"skin", "Fox", "SimpleSkin"})), name_of);
INSTANTIATE_TEST_SUITE_P(
    All, GltfMorphs, testing::ValuesIn(model_files_named({"morph_cube", "sparse", "AnimatedMorphCube", "box_sparse"})),
    name_of);

/// Cubic keys of a rotation are floats, off from length 1 by 6e-8; the reader scales them, the formula does not.
constexpr double pose_tolerance = 3e-8;

TEST_P(GltfPoses, EveryNodeByItsName) {
    for (const double seconds : times) {
        const std::vector<glm::dmat4> expected = world_matrices(raw, seconds);
        const ScenePose frame = pose(scene, seconds);
        ASSERT_EQ(frame.world.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
            const std::string& own = raw.model.nodes[i].name;
            const std::string node_name = own.empty() ? std::string("node").append(std::to_string(i)) : own;
            const glm::dmat4& found = frame.world[find_named(scene.nodes, node_name)];
            for (int k = 0; k < 16; ++k) {
                const double size = std::max(1.0, std::abs(expected[i][k / 4][k % 4]));
                EXPECT_NEAR(found[k / 4][k % 4], expected[i][k / 4][k % 4], pose_tolerance * size)
                    << node_name << " at " << seconds << " s, element " << k;
            }
        }
    }
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
TEST_P(GltfSkins, PointsFollowTheirJoints) {
    ASSERT_EQ(scene.skins.size(), 1u);
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
    double moved = 0.0;
    const std::vector<glm::dvec3> rest = world_points(pose(scene, times.front()), 0);
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
            moved = std::max(moved, glm::distance(found[i], rest[i]));
        }
    }
    EXPECT_GT(moved, 0.1) << "nothing moves at these times, so nothing is compared";
}

/// Rest plus weighted displacements, in double; normals likewise, then unit.
TEST_P(GltfMorphs, PointsAndNormalsFollowTheWeights) {
    const gltf::Primitive& primitive = raw.model.meshes.at(0).primitives.at(0);
    const std::size_t count = primitive.targets.size();
    ASSERT_EQ(scene.meshes.at(0).deformation.targets.size(), count);
    const gltf::Animation& animation = raw.model.animations.at(0);
    const gltf::AnimationChannel& channel = animation.channels.at(0);
    ASSERT_EQ(channel.target_path, "weights");
    const Keys weights(raw, animation, channel, count);
    const std::vector<double> rest = raw.floats(primitive.attributes.at("POSITION"));
    const bool flat = !primitive.attributes.contains("NORMAL");
    const std::vector<double> normals = flat ? std::vector<double>{} : raw.floats(primitive.attributes.at("NORMAL"));
    double largest_weight = 0.0;
    for (const double seconds : times) {
        const std::vector<double> w = weights.at(seconds);
        std::vector<double> points = rest, turned = normals;
        for (std::size_t t = 0; t < count; ++t) {
            largest_weight = std::max(largest_weight, w[t]);
            EXPECT_NEAR(evaluate(scene.meshes[0].deformation.target_weights[t], seconds), w[t], 1e-12) << seconds;
            const std::vector<double> moves = raw.floats(primitive.targets[t].at("POSITION"));
            for (std::size_t i = 0; i < points.size(); ++i) points[i] += w[t] * moves[i];
            if (flat) continue;
            const std::vector<double> turns = raw.floats(primitive.targets[t].at("NORMAL"));
            for (std::size_t i = 0; i < turned.size(); ++i) turned[i] += w[t] * turns[i];
        }
        const PosedMesh posed = pose(scene, seconds).meshes[0];
        ASSERT_EQ(posed.positions.size(), rest.size() / 3);
        ASSERT_EQ(posed.normals.size(), normals.size() / 3);
        for (std::size_t i = 0; i < rest.size(); ++i)
            EXPECT_NEAR(posed.positions[i / 3][static_cast<int>(i % 3)], points[i], 1e-12) << seconds;
        for (std::size_t i = 0; i < posed.normals.size(); ++i) {
            const glm::dvec3 unit = glm::normalize(glm::dvec3(turned[3 * i], turned[3 * i + 1], turned[3 * i + 2]));
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(posed.normals[i][k], unit[k], 1e-6) << seconds;
        }
    }
    EXPECT_GT(largest_weight, 0.5) << "nothing morphs at these times, so nothing is compared";
}

/// Half way between keys 0.5 s apart of the values 0 and 1, left with 4 a second and reached level.
TEST(GltfPosesOnPaper, KF07_StepLinearCubic) {
    const ScenePose frame = pose(load_model(own_model("interpolation.glb")), 0.25);
    const auto y = [&](std::size_t node) { return frame.world.at(node)[3].y - 6.0; };
    EXPECT_DOUBLE_EQ(y(6), 0.0);
    EXPECT_DOUBLE_EQ(y(7), 0.5);
    EXPECT_DOUBLE_EQ(y(8), 0.5 + 0.5 * 4.0 / 8.0);
}

}  // namespace
}  // namespace aleph
