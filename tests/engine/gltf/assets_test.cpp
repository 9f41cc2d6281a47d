// Whole files: each loads, or is refused for the reason given; and what the models of tests/assets/gltf contain, by the
// numbers of author_models.py.
#include "engine/pose/pose.h"
#include "tests/engine/gltf/model_files.h"
#include "tests/support/files/gltf_draft.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"
#include "tests/support/warnings.h"

namespace aleph {
namespace {

class GltfFiles : public testing::TestWithParam<ModelFile> {};

TEST_P(GltfFiles, LoadOrAreRefused) {
    const auto& [path, warnings, refused_for] = GetParam();
    try {
        const Scene scene = load_model(path);
        EXPECT_EQ(refused_for, "");
        EXPECT_EQ(scene.source.warnings.size(), warnings.size()) << testing::PrintToString(scene.source.warnings);
        for (const std::string& word : warnings) {
            EXPECT_TRUE(has_warning(scene, word)) << word;
        }
    } catch (const InputError& error) {
        ASSERT_NE(refused_for, "") << error.what();
        EXPECT_NE(error.reason().find(refused_for), std::string::npos) << error.what();
        EXPECT_EQ(error.file(), path.string());
    }
}

INSTANTIATE_TEST_SUITE_P(All, GltfFiles, testing::ValuesIn(model_files(false)),
                         [](const auto& file) { return model_name(file.param.path); });

/// The list has the whole folder. Without the folder, this is the one test that says so.
TEST(GltfForeignFiles, AreAllListed) {
    if (!std::filesystem::exists(foreign_models())) GTEST_SKIP() << missing_asset(foreign_models());
    std::vector<std::filesystem::path> listed, found;
    for (const ModelFile& file : foreign_model_files()) listed.push_back(file.path);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(foreign_models()))
        if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb") found.push_back(entry.path());
    std::ranges::sort(listed);
    std::ranges::sort(found);
    EXPECT_EQ(found, listed);
}

TEST(GltfModels, TruckHasItsWheelsTwiceAndTurning) {
    const Scene scene = load_model(own_model("truck.glb"));
    ASSERT_EQ(scene.nodes.size(), 5u);
    ASSERT_EQ(scene.meshes.size(), 4u);  // three primitives of the body, one wheel
    EXPECT_EQ(scene.materials.size(), 4u);
    ASSERT_EQ(scene.images.size(), 1u);  // two textures of one image
    EXPECT_EQ(scene.images[0].bytes.width, 4);
    EXPECT_EQ(scene.images[0].bytes(0, 0), glm::u8vec4(30, 60, 220, 255));
    EXPECT_EQ(scene.images[0].bytes(0, 1), glm::u8vec4(255, 255, 255, 255));
    EXPECT_EQ(scene.materials[0].textures[TextureSlot::base_color].image, 0);
    EXPECT_EQ(scene.materials[0].textures[TextureSlot::base_color].wrap_u, Wrap::repeat);
    EXPECT_EQ(scene.materials[1].textures[TextureSlot::base_color].image, no_index);
    EXPECT_EQ(scene.materials[1].gloss.metallic, Track<double>(0.0));
    EXPECT_EQ(scene.materials[3].textures[TextureSlot::base_color].image, 0);
    EXPECT_EQ(scene.materials[3].textures[TextureSlot::base_color].wrap_u, Wrap::clamp);

    std::vector<int> wheels;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        EXPECT_LT(scene.nodes[i].parent, static_cast<int>(i));
        if (scene.nodes[i].meshes == std::vector<int>{3}) wheels.push_back(static_cast<int>(i));
    }
    ASSERT_EQ(wheels.size(), 2u);
    const Track<glm::dquat>& turn = scene.nodes[wheels[0]].transform.rotation;
    EXPECT_EQ(turn.key_count(), 31u);
    EXPECT_EQ(turn.sampling.times.front(), 0.0);
    EXPECT_EQ(turn.sampling.times.back(), 1.25);
    // The wheels' axles lie where their parents' matrices put them, at every time; the front ones are steered.
    for (const double seconds : {0.0, 0.3, 1.25}) {
        const ScenePose frame = pose(scene, seconds);
        for (const int wheel : wheels) {
            const glm::dmat4& world = frame.world[wheel];
            const bool front = world[3].x > 0.0;
            EXPECT_EQ(world[3], glm::dvec4(front ? 1.5 : -1.375, 0.4375, 0.0, 1.0));
            EXPECT_EQ(world[2], (front ? glm::dvec4(0.28, 0.0, 0.96, 0.0) : glm::dvec4(0.0, 0.0, 1.0, 0.0)));
        }
    }
    const ScenePose start = pose(scene, 0.0), later = pose(scene, 0.3);
    EXPECT_NE(start.world[wheels[0]], later.world[wheels[0]]);
    EXPECT_EQ(start.world[0], later.world[0]);
}

TEST(GltfModels, LampBoxHasItsLampAndColours) {
    const Scene scene = load_model(own_model("lamp_box.glb"));
    ASSERT_EQ(scene.nodes.size(), 5u);
    ASSERT_EQ(scene.meshes.size(), 6u);
    EXPECT_EQ(scene.nodes[3].meshes, (std::vector<int>{3, 4, 5}));
    ASSERT_EQ(scene.materials.size(), 5u);
    EXPECT_EQ(scene.materials[0].glow.color, Track<glm::dvec3>(glm::dvec3(1.0)));
    EXPECT_EQ(scene.materials[0].glow.strength, Track<double>(20.0));
    EXPECT_TRUE(scene.materials[0].double_sided);
    EXPECT_EQ(scene.materials[2].base_color, Track<glm::dvec3>(glm::dvec3(0.5, 0.0, 0.0)));
    EXPECT_FALSE(scene.materials[2].double_sided);
    EXPECT_EQ(scene.materials[4].gloss.metallic, Track<double>(1.0));
    EXPECT_EQ(scene.materials[4].gloss.roughness, Track<double>(0.25));
    const Mesh& lamp = scene.meshes[0];
    EXPECT_EQ(lamp.colors, (std::vector<glm::vec4>{{1, 1, 1, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 0, 0}}));
    EXPECT_EQ(lamp.uv[0], (std::vector<glm::vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
    EXPECT_EQ(lamp.uv[1], (std::vector<glm::vec2>{{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}));
    EXPECT_TRUE(scene.meshes[1].colors.empty());
    EXPECT_EQ(scene.nodes[0].transform.translation, Track<glm::dvec3>(glm::dvec3(0, 1.9375, -0.25)));
}

TEST(GltfModels, RoomHasLambertSurfacesLampAndCamera) {
    const Scene scene = load_model(source_folder() / "scenes/room/room.glb");
    EXPECT_EQ(scene.nodes.size(), 60u);
    EXPECT_EQ(scene.meshes.size(), 83u);  // 58 in the file, some of several primitives
    ASSERT_EQ(scene.materials.size(), 24u);
    EXPECT_EQ(scene.materials[0].gloss.specular, Track<double>(0.0));
    EXPECT_EQ(scene.cameras.size(), 1u);
    EXPECT_TRUE(std::ranges::any_of(
        scene.materials, [](const Material& material) { return material.glow.color.values[0] != glm::dvec3(0.0); }));
    for (const Mesh& mesh : scene.meshes) EXPECT_TRUE(mesh.normals.empty());
}

TEST(GltfModels, InterleavedBox) {
    const Scene scene = load_model(own_model("interleaved.glb"));
    ASSERT_EQ(scene.meshes.size(), 1u);
    const Mesh& box = scene.meshes[0];
    EXPECT_EQ(box.triangles.size(), 12u);
    ASSERT_EQ(box.positions.size(), 24u);
    ASSERT_EQ(box.normals.size(), 24u);
    for (std::size_t i = 0; i < box.positions.size(); ++i) {
        for (int k = 0; k < 3; ++k) EXPECT_EQ(std::abs(box.positions[i][k]), 0.5f);
        EXPECT_EQ(glm::length(box.normals[i]), 1.0f);
        EXPECT_EQ(glm::dot(box.positions[i], box.normals[i]), 0.5f);
    }
}

TEST(GltfModels, TrianglesWithoutIndices) {
    const Scene scene = load_model(own_model("triangles.gltf"));
    ASSERT_EQ(scene.nodes.size(), 2u);
    EXPECT_TRUE(scene.nodes[1].meshes.empty());
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {3, 4, 5}}));
    EXPECT_EQ(mesh.positions.at(4), glm::vec3(1, 1, 0));
    EXPECT_TRUE(mesh.normals.empty());
}

TEST(GltfModels, SparseValuesOnABaseOnZerosAndOfKeys) {
    const Scene scene = load_model(own_model("sparse.glb"));
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {2, 2, 0}, {0, 1, 0}}));
    const Track<double>& weight = mesh.deformation.target_weights.at(0);
    EXPECT_EQ(weight.sampling.times, (std::vector<double>{1.0, 2.0}));
    EXPECT_EQ(weight.values, (std::vector<double>{0.0, 1.0}));
    const std::vector<glm::dvec3> lifted = pose(scene, 1.5).meshes[0].positions;
    EXPECT_EQ(lifted, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 2}, {2, 2, 0}, {0, 1, 0}}));
}

TEST(GltfModels, PicturesBesideTheFileAndInsideItAndTheirTransform) {
    const Scene scene = load_model(own_model("textures.gltf"));
    ASSERT_EQ(scene.images.size(), 2u);
    const Image<glm::u8vec4>& squares = scene.images[0].bytes;
    ASSERT_EQ(squares.size(), 4u);
    EXPECT_EQ(squares(1, 0), glm::u8vec4(0, 255, 0, 255));
    EXPECT_EQ(squares(0, 1), glm::u8vec4(0, 0, 255, 255));
    EXPECT_EQ(scene.images[1].bytes(0, 0), glm::u8vec4(0, 64, 255, 255));
    EXPECT_EQ(scene.images[1].bytes(1, 0), glm::u8vec4(0, 255, 0, 255));
    const TextureRef &moved = scene.materials.at(0).textures[TextureSlot::base_color],
                     &plain = scene.materials[0].textures[TextureSlot::metallic_roughness];
    EXPECT_EQ(moved, (TextureRef{0, 1, Wrap::clamp, Wrap::mirror, true, {0.25, -0.5}, {2, 3}, 0.5}));
    EXPECT_EQ(plain, TextureRef{.image = 1});
    EXPECT_EQ(scene.meshes.at(0).uv[1].at(1), glm::vec2(2, 2));
}

TEST(GltfModels, Cameras) {
    const Scene scene = load_model(own_model("cameras.gltf"));
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_FALSE(scene.cameras[0].orthographic);
    EXPECT_EQ(scene.cameras[0].fov, Track<double>(0.7));
    EXPECT_TRUE(scene.cameras[1].orthographic);
    EXPECT_EQ(scene.cameras[1].half_height, Track<double>(1.5));
    // Turned by 30 degrees about y, 2 m further back: back is (sin 30, 0, cos 30).
    const std::vector<CameraValues> posed = pose(scene, 0.0).cameras;
    ASSERT_EQ(posed.size(), 2u);
    const glm::dvec3 back(0.5, 0.0, std::numbers::sqrt3 / 2.0);
    EXPECT_NEAR(glm::distance(posed[1].position, glm::dvec3(0, 1, 4) + 2.0 * back), 0.0, 1e-7);
    EXPECT_NEAR(glm::distance(posed[0].axes[2], back), 0.0, 1e-7);
}

TEST(GltfModels, ARotationOfAnotherLengthIsMadeUnit) {
    GltfDraft draft = triangle_draft();
    draft.json["nodes"][0]["rotation"] = {0, 0, 0.3, 0.9};
    const ScratchFolder folder;
    write_text(folder / "turned.gltf", draft.to_text());
    const Scene scene = load_model(folder / "turned.gltf");
    ASSERT_EQ(scene.source.warnings.size(), 1u);
    EXPECT_NE(scene.source.warnings[0].find("the rotation quaternion has length 0.948683"), std::string::npos);
    const glm::dvec4 right = pose(scene, 0.0).world[0][0];  // the turn has a tangent of a half of 1 / 3
    EXPECT_NEAR(right.x, 0.8, 1e-15);
    EXPECT_NEAR(right.y, 0.6, 1e-15);
}

TEST(GltfModels, LightAndCameraMove) {
    const Scene scene = load_model(own_model("moving_light.gltf"));
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].kind, Light::Kind::point);
    EXPECT_EQ(scene.lights[0].color, Track<glm::dvec3>(glm::dvec3(1.0, 0.5, 0.25)));
    EXPECT_EQ(scene.lights[0].intensity, Track<double>(40.0));
    EXPECT_EQ(scene.lights[0].range, Track<double>(8.0));
    const ScenePose first = pose(scene, 0.0), last = pose(scene, 100.0);
    ASSERT_EQ(first.lights.size(), 1u);
    ASSERT_EQ(first.cameras.size(), 1u);
    EXPECT_EQ(first.lights[0].position, glm::dvec3(0, 2, 0));
    EXPECT_EQ(last.lights[0].position, glm::dvec3(1.375, 2, 0));
    EXPECT_EQ(first.cameras[0].position, glm::dvec3(0, 1, 5));
    EXPECT_EQ(last.cameras[0].position, glm::dvec3(0, 1.6875, 5));
}

/// The arrows of this model point at their targets only if matrices and rotations are read the right way round.
TEST(GltfModels, ArrowsPointAtTheirTargets) {
    const Scene scene = load_model(own_model("orientation.glb"));
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
            EXPECT_NEAR(glm::length(target), 2.0, 1e-6);
            EXPECT_NEAR(glm::distance(arrow, target * (2.0 / 3.0)), 0.0, 1e-6) << axis << side;
        }
    }
}

/// 1 of the file's three animations plays; the others move the same joints.
TEST(GltfModels, SkinWithoutIndicesAndNormals) {
    const Scene scene = load_model(own_model("skin.glb"));
    ASSERT_EQ(scene.skins.size(), 1u);
    EXPECT_EQ(scene.skins[0].joints.size(), 3u);
    EXPECT_EQ(scene.meshes[0].deformation.joints_per_vertex, 4);
    EXPECT_EQ(scene.meshes[0].triangles.size(), 32u);
    EXPECT_TRUE(scene.meshes[0].normals.empty());
    const Track<glm::dquat>& knee = std::ranges::find(scene.nodes, "knee", &Node::name)->transform.rotation;
    EXPECT_EQ(knee.sampling.times.back(), 2.0);
}

}  // namespace
}  // namespace aleph
