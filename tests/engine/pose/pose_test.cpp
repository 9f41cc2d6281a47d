// Known answers of engine/pose/pose.h.

#include "engine/pose/pose.h"
#include "engine/pose/plan.h"
#include "tests/support/scenes/child_node.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(Scene, ElementsAreFoundByTheirNames) {
    Scene scene;
    for (const char* name : {"lamp", "ball", "ball"}) scene.nodes.emplace_back().name = name;
    EXPECT_EQ(find_named(scene.nodes, "ball"), 1);
    expect_refusal([&] { find_named(scene.nodes, "bal"); }, "", "bal", "no element");
}

/// Cubic keys within a range lead out of it between them.
TEST(Pose, ConesThatOvershootStayWithinAQuarterTurn) {
    Scene scene;
    scene.lights.resize(1);
    scene.nodes.resize(1);
    scene.nodes[0].light = 0;
    scene.lights[0].outer_cone = Track<double>({0.0, 1.0}, {0.0, 0.7, 70.0, -70.0, 0.7, 0.0}, Interpolation::cubic);
    scene.lights[0].inner_cone = Track<double>({0.0, 1.0}, {0.0, 0.7, -70.0, 70.0, 0.7, 0.0}, Interpolation::cubic);
    EXPECT_EQ(pose(scene, 0.5).lights[0].outer_cone, pi / 2.0);
    EXPECT_EQ(pose(scene, 0.5).lights[0].inner_cone, 0.0);
}

TEST(Pose, LocalTransformIsTranslationRotationScale) {
    Scene scene;
    scene.nodes.push_back(child_of(no_index, {1.0, 2.0, 3.0}));
    scene.nodes[0].transform.rotation = glm::angleAxis(pi / 2.0, glm::dvec3(0.0, 0.0, 1.0));
    scene.nodes[0].transform.scale = glm::dvec3(2.0, 3.0, 4.0);
    scene.nodes.push_back(child_of(0, {1.0, 1.0, 1.0}));
    const ScenePose frame = pose(scene, 0.0);
    expect_near(frame.world[0] * glm::dvec4(1.0, 1.0, 1.0, 1.0), {-2.0, 4.0, 7.0}, 1e-14);
    expect_near(frame.world[1][3], {-2.0, 4.0, 7.0}, 1e-14);
    expect_near(frame.world[1] * glm::dvec4(1.0, 0.0, 0.0, 1.0), {-2.0, 6.0, 7.0}, 1e-14);
}

TEST(Pose, MatrixStandsForTheWholeTransform) {
    Scene scene;
    scene.nodes.push_back(child_of(no_index, {9.0, 9.0, 9.0}));
    const glm::dmat4 m(1.0, 2.0, 3.0, 0.0, -4.0, 5.0, 6.0, 0.0, 7.0, -8.0, 9.0, 0.0, 1.0, 2.0, 3.0, 1.0);
    scene.nodes[0].transform.matrix = m;
    EXPECT_EQ(pose(scene, 0.0).world[0], m);
}

TEST(Pose, AxisRotationSpinsMoreThanOnce) {
    Scene scene;
    scene.nodes.push_back(child_of(no_index));
    AxisRotation spin{.axis = {0.0, 2.0, 0.0}, .angle = Track<double>({0.0, 1.0}, {0.0, 4.0 * pi})};
    scene.nodes[0].transform.axis_rotation = spin;
    for (double t = 0.0; t <= 1.0; t += 0.0625)
        expect_near(pose(scene, t).world[0][0], {std::cos(4.0 * pi * t), 0.0, -std::sin(4.0 * pi * t)}, 1e-13);
}

TEST(Pose, VisibilityIsSteppedAndInherited) {
    Scene scene;
    scene.nodes = {child_of(no_index), child_of(0), child_of(1), child_of(no_index)};
    scene.nodes[1].visible = Track<double>({0.0, 1.0, 2.0}, {1.0, 0.0, 1.0}, Interpolation::linear);
    scene.nodes[2].visible = Track<double>({0.0, 3.0}, {0, 1, 0, 0, 0, 0}, Interpolation::cubic);
    EXPECT_EQ(pose(scene, 0.5).visible, (std::vector<std::uint8_t>{1, 1, 1, 1}));
    EXPECT_EQ(pose(scene, 1.0).visible, (std::vector<std::uint8_t>{1, 0, 0, 1}));
    EXPECT_EQ(pose(scene, 1.5).visible, (std::vector<std::uint8_t>{1, 0, 0, 1}));
    EXPECT_EQ(pose(scene, 2.5).visible, (std::vector<std::uint8_t>{1, 1, 1, 1}));
    EXPECT_EQ(pose(scene, 3.0).visible, (std::vector<std::uint8_t>{1, 1, 0, 1}));
}

TEST(Pose, InstancesAreTheSameAtEveryTime) {
    Scene scene;
    scene.nodes = {child_of(no_index), child_of(0), child_of(0)};
    scene.meshes.resize(3);
    scene.nodes[0].meshes = {2};
    scene.nodes[2].meshes = {1, 0};
    scene.nodes[2].visible = Track<double>({0.0, 1.0}, {1.0, 0.0});
    const std::vector<Instance> expected{{0, 2}, {2, 1}, {2, 0}};
    EXPECT_EQ(list_instances(scene), expected);
    EXPECT_EQ(pose(scene, 5.0).instances, expected);
}

TEST(Pose, LightsShineAlongMinusZWithoutTheirScale) {
    Scene scene;
    Light light{.kind = Light::Kind::directional,
                .color = glm::dvec3(1.0, 0.5, 0.25),
                .intensity = Track<double>({0.0, 1.0}, {10.0, 20.0})};
    scene.lights = {light};
    scene.nodes = {child_of(no_index, {1.0, 2.0, 3.0}), child_of(no_index)};
    scene.nodes[0].transform.rotation = glm::angleAxis(-pi / 2.0, glm::dvec3(1.0, 0.0, 0.0));  // -z to -y
    scene.nodes[0].transform.scale = glm::dvec3(1e-3, 5.0, 1e-20);
    scene.nodes[0].light = 0;
    scene.nodes[1].light = 0;
    scene.nodes[1].visible = 0.0;
    const ScenePose frame = pose(scene, 0.5);
    ASSERT_EQ(frame.lights.size(), 1u);
    expect_near(frame.lights[0].direction, {0.0, -1.0, 0.0}, 1e-14);
    expect_near(frame.lights[0].position, {1.0, 2.0, 3.0}, 1e-14);
    EXPECT_EQ(frame.lights[0].intensity, Rgb(15.0f, 7.5f, 3.75f));
    scene.nodes[0].transform.scale = glm::dvec3(0.0);
    EXPECT_EQ(pose(scene, 0.5).lights[0].direction, glm::dvec3(0.0, 0.0, -1.0));
}

TEST(Pose, CamerasAreOrthonormalWhateverTheScale) {
    Scene scene;
    scene.cameras.resize(1);
    scene.nodes = {child_of(no_index), child_of(0, {0.0, 0.0, 10.0})};
    scene.nodes[1].camera = 0;
    scene.nodes[1].visible = 0.0;  // a hidden camera still sees
    const glm::dquat rotation = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1.0, 2.0, -1.0)));
    scene.nodes[1].transform.rotation = rotation;
    for (const glm::dvec3 scale :
         {glm::dvec3(1.0), glm::dvec3(2.0, 0.1, 1e-20), glm::dvec3(1e30), glm::dvec3(-1, 1, 1)}) {
        scene.nodes[1].transform.scale = scale;
        const CameraValues camera = pose(scene, 0.0).cameras.at(0);
        const glm::dmat3 expected = glm::mat3_cast(rotation);
        for (int i = 0; i < 3; ++i) expect_near(camera.axes[i], expected[i], 1e-14);
        expect_near(camera.position, {0.0, 0.0, 10.0}, 1e-14);
    }
    scene.nodes[0].transform.scale = glm::dvec3(1.0, 3.0, 1.0);  // with the rotation below it: a shear
    const CameraValues sheared = pose(scene, 0.0).cameras.at(0);
    const glm::dmat3 product = glm::transpose(sheared.axes) * sheared.axes;
    for (int i = 0; i < 3; ++i) expect_near(product[i], glm::dmat3(1.0)[i], 1e-14);
    EXPECT_GT(glm::determinant(sheared.axes), 0.99);
    scene.nodes[1].transform.scale = glm::dvec3(0.0);
    EXPECT_EQ(pose(scene, 0.0).cameras[0].axes, glm::dmat3(1.0));
}

TEST(Pose, MaterialsStayInRangeWhereCubicKeysOvershoot) {
    const auto overshoot = Track<double>({0.0, 1.0}, {0.0, 1.0, 9.0, -9.0, 1.0, 0.0}, Interpolation::cubic);
    const auto below = Track<double>({0.0, 1.0}, {0.0, 0.0, -9.0, 9.0, 0.0, 0.0}, Interpolation::cubic);
    Scene scene;
    Material material{.glow = {.color = glm::dvec3(1.0, 2.0, 3.0), .strength = 4.0}};
    material.glass.thickness = material.glass.attenuation_distance = below;
    material.gloss.roughness = material.layers.clearcoat = material.layers.clearcoat_roughness =
        material.layers.sheen_roughness = material.layers.anisotropy = overshoot;
    material.layers.anisotropy_rotation = below;
    material.glass.attenuation_color = material.layers.sheen_color = Track<glm::dvec3>(
        {0.0, 1.0}, {{0, 0, 0}, {1, 0, 0.5}, {9, -9, 0}, {-9, 9, 0}, {1, 0, 0.5}, {0, 0, 0}}, Interpolation::cubic);
    scene.materials = {material};
    const auto [color, alpha, emission, gloss, glass, layers] = pose(scene, 0.5).materials[0];
    // The curves are at 3.25, -2.25 and (3.25, -2.25, 0.5).
    for (const float value :
         {gloss.roughness, layers.clearcoat, layers.clearcoat_roughness, layers.sheen_roughness, layers.anisotropy})
        EXPECT_EQ(value, 1.0f);
    EXPECT_EQ(glass.thickness, 0.0f);
    EXPECT_EQ(glass.attenuation_distance, 0.0f);
    EXPECT_EQ(glass.attenuation_color, Rgb(1.0f, 0.0f, 0.5f));
    EXPECT_EQ(layers.sheen_color, Rgb(1.0f, 0.0f, 0.5f));
    EXPECT_EQ(layers.anisotropy_rotation, -2.25f);
    EXPECT_EQ(emission, Rgb(4.0f, 8.0f, 12.0f));
    EXPECT_EQ(gloss.ior, 1.5f);
}

TEST(Pose, TheEnvironmentTurnsByQuaternionsOrAboutAnAxis) {
    Scene scene;
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(1.0));
    scene.environment.rotation = Track<glm::dquat>(
        {0.0, 1.0}, {glm::dquat(1.0, 0.0, 0.0, 0.0), glm::angleAxis(pi / 2.0, glm::dvec3(0.0, 0.0, 1.0))});
    EXPECT_TRUE(is_world_animated(scene));
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 30}));
    expect_near(pose(scene, 0.5).environment_rotation[0], {std::sqrt(0.5), std::sqrt(0.5), 0.0}, 1e-14);
    scene.environment.axis_rotation = AxisRotation{{0.0, 2.0, 0.0}, Track<double>({0.0, 2.0}, {0.0, 4.0 * pi})};
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 60}));
    const PosePlan plan = make_pose_plan(scene);
    ScenePose updated = pose(scene, 0.0);
    for (double t = 0.0; t <= 2.0; t += 0.125) {
        update_pose(scene, plan, t, updated);
        EXPECT_EQ(updated.environment_rotation, pose(scene, t).environment_rotation);
        expect_near(updated.environment_rotation[0], {std::cos(2.0 * pi * t), 0.0, -std::sin(2.0 * pi * t)}, 1e-13);
    }
    scene.environment.axis_rotation->angle = Track<double>(0.5);
    EXPECT_FALSE(is_world_animated(scene)) << "the quaternions do not count beside an axis";
}

TEST(FrameRange, SpansTheKeysRoundedInwards) {
    Scene scene;
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 0}));
    scene.nodes = {child_of(no_index)};
    scene.nodes[0].transform.translation = Track<glm::dvec3>({3.0}, {glm::dvec3(0.0)});  // one key is no animation
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 0}));
    scene.nodes[0].transform.translation = Track<glm::dvec3>({0.05, 1.05}, {glm::dvec3(0.0), glm::dvec3(1.0)});
    EXPECT_EQ(frame_range(scene), (FrameRange{2, 31}));  // 1.5 to 31.5
    scene.cameras.resize(1);
    scene.cameras[0].fov = Track<double>({-1.0, 0.0}, {1.0, 1.0});
    EXPECT_EQ(frame_range(scene), (FrameRange{-30, 31}));
    scene.materials.resize(1);
    scene.materials[0].gloss.ior = Track<double>({0.0, 4.0}, {1.0, 1.0});
    EXPECT_EQ(frame_range(scene), (FrameRange{-30, 120}));
    scene.film.range = FrameRange{5, 6};
    EXPECT_EQ(frame_range(scene), (FrameRange{5, 6}));
}

TEST(Pose, AFilmKeepsItsTimesAtAnotherRate) {
    Film film;
    film.frame_rate = {30, 1};
    film.range = FrameRange{-3, 89};
    film.cuts = {30, 31, 33};
    film.camera_keys = {{0, "a"}, {30, "b"}, {31, "c"}};
    Film faster = film, slower = film;
    change_frame_rate(faster, {60, 1});
    EXPECT_EQ(faster.range, (FrameRange{-6, 178}));
    EXPECT_EQ(faster.cuts, (std::vector<std::int64_t>{60, 62, 66}));
    EXPECT_EQ(faster.camera_keys, (std::vector<CameraKey>{{0, "a"}, {60, "b"}, {62, "c"}}));
    // Frames 31 and 33 lie at 15.5 and 16.5: their shots begin with the frames after.
    change_frame_rate(slower, {15, 1});
    EXPECT_EQ(slower.range, (FrameRange{-1, 44}));
    EXPECT_EQ(slower.cuts, (std::vector<std::int64_t>{15, 16, 17}));
    EXPECT_EQ(slower.camera_keys, (std::vector<CameraKey>{{0, "a"}, {15, "b"}, {16, "c"}}));
    change_frame_rate(film, {2, 1});
    EXPECT_EQ(film.cuts, (std::vector<std::int64_t>{2, 3}));
    EXPECT_EQ(film.camera_keys, (std::vector<CameraKey>{{0, "a"}, {2, "b"}, {3, "c"}}));
}

TEST(FrameRange, TakesTheNoiseOfSinglePrecisionTimes) {
    Scene scene;
    scene.nodes = {child_of(no_index)};
    for (int first = 1; first < 2000; first += 7) {
        const double begin = static_cast<float>(first) / 30.0f, end = static_cast<float>(first + 50) / 30.0f;
        scene.nodes[0].visible = Track<double>({begin, end}, {1.0, 0.0});
        ASSERT_EQ(frame_range(scene), (FrameRange{first, first + 50}));
    }
    float sum = 0.0f;  // times that are added up
    for (int frame = 0; frame < 126; ++frame) sum += 1.0f / 30.0f;
    ASSERT_LT(sum * 30.0, 126.0 - 5e-5);
    scene.nodes[0].visible = Track<double>({0.0, double{sum}}, {1.0, 0.0});
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 126}));
    scene.nodes[0].visible = Track<double>({0.01, 0.02}, {1.0, 0.0});  // between two frames
    EXPECT_EQ(frame_range(scene), (FrameRange{1, 1}));
    scene.nodes[0].visible = Track<double>({-1e300, 1e300}, {1.0, 0.0});
    EXPECT_LT(frame_range(scene).first, -1'000'000'000'000);
}

TEST(FindCamera, ByNodeThenByCameraThenTheScenesChoice) {
    Scene scene;
    scene.source.file = "room.json";
    EXPECT_THROW(CameraNames(scene).find(""), InputError);
    scene.cameras.resize(2);
    scene.cameras[0].name = "wide";
    scene.cameras[1].name = "near";
    scene.nodes = {child_of(no_index), child_of(no_index), child_of(no_index)};
    scene.nodes[0].name = "wall";
    scene.nodes[1].name = "left";
    scene.nodes[1].camera = 0;
    scene.nodes[2].name = "wide";  // a node's name goes first
    scene.nodes[2].camera = 1;
    EXPECT_EQ(CameraNames(scene).find(""), 0);
    EXPECT_EQ(CameraNames(scene).find("left"), 0);
    EXPECT_EQ(CameraNames(scene).find("wide"), 1);
    EXPECT_EQ(CameraNames(scene).find("near"), 1);
    scene.film.camera = "near";
    EXPECT_EQ(CameraNames(scene).find(""), 1);
    EXPECT_EQ(find_refusal([&] { CameraNames(scene).find("wall"); }).message,
              "room.json: camera: there is no camera 'wall'; there is 'left', 'wide'");
}

TEST(IsWorldAnimated, CamerasDoNotCount) {
    const auto moving = Track<glm::dvec3>({0.0, 1.0}, {glm::dvec3(0.0), glm::dvec3(1.0)});
    Scene scene;
    scene.meshes.resize(1);
    scene.cameras.resize(1);
    scene.lights.resize(1);
    scene.nodes = {child_of(no_index), child_of(0), child_of(no_index), child_of(2)};
    scene.nodes[1].meshes = {0};
    scene.nodes[3].camera = 0;
    EXPECT_FALSE(is_world_animated(scene));
    scene.nodes[2].transform.translation = moving;  // the camera's rig
    scene.cameras[0].fov = Track<double>({0.0, 1.0}, {1.0, 2.0});
    EXPECT_FALSE(is_world_animated(scene));

    const auto animated_with = [&](const std::function<void(Scene&)>& change) {
        Scene other = scene;
        change(other);
        return is_world_animated(other);
    };
    const auto fading = Track<double>({0.0, 1.0}, {1.0, 0.0});
    EXPECT_TRUE(animated_with([](Scene& s) { s.nodes[3].light = 0; })) << "a lamp on the rig";
    EXPECT_TRUE(animated_with([&](Scene& s) { s.nodes[0].transform.translation = moving; }));
    EXPECT_TRUE(animated_with([&](Scene& s) { s.nodes[1].visible = fading; }));
    EXPECT_TRUE(animated_with([&](Scene& s) { s.materials.emplace_back().glow.strength = fading; }));
    EXPECT_TRUE(animated_with([&](Scene& s) { s.environment.radiance = moving; }));
    EXPECT_FALSE(animated_with([&](Scene& s) {
        s.nodes[0].transform.translation = moving;
        s.nodes[0].transform.matrix = glm::dmat4(1.0);
    })) << "which replaces the translation";
}

}  // namespace
}  // namespace aleph
