// Materials, lights and cameras that are written as .glb and read again are the same.
#include "engine/scene_file/fields.h"
#include "tests/engine/gltf/exported.h"

namespace aleph {
namespace {

TEST(GltfRoundTrip, EveryPropertyOfAMaterial) {
    std::filesystem::create_directories(round_trip_folder);
    Scene scene;
    scene.images.push_back(
        {.name = "dot", .path = "", .bytes = Image<glm::u8vec4>(1, 1, {9, 8, 7, 255}), .floats = {}});
    Material m{.name = "all"};
    double value = 0.0;  // another one for each property
    const auto next = [&] { return value += 0.03125; };
    for (const auto& field : material_numbers) field.in(m) = next();
    for (const auto& field : material_angles) field.in(m) = next();
    for (const auto& field : material_colors) field.in(m) = glm::dvec3(next(), next(), next());
    m.glow.strength = 2.0;
    m.gloss.ior = 1.25;
    m.textures.normal_scale = 0.25;
    m.textures.clearcoat_normal_scale = -0.75;
    int set = 0;
    for (const auto& field : material_textures) m.textures[field.slot] = TextureRef{.image = 0, .uv_set = set++ % 2};
    scene.materials = {m};
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.uv[0] = mesh.uv[1] = {{0, 0}, {1, 0}, {0, 1}};
    mesh.triangles = {{0, 1, 2}};
    mesh.material = 0;
    scene.meshes = {mesh};
    scene.nodes.emplace_back().meshes = {0};
    write_gltf(scene, round_trip_folder / "materials.glb");
    Scene loaded = load_scene(round_trip_folder / "materials.glb");
    ASSERT_EQ(loaded.materials.size(), 1u);
    loaded.materials[0].include = no_index;
    EXPECT_EQ(loaded.materials[0], m);
}

TEST(GltfRoundTrip, LightsAndCameras) {
    Scene scene;
    const auto light = [&](Light::Kind kind, double range) {
        scene.lights.push_back({.name = std::string("light").append(std::to_string(scene.lights.size())),
                                .kind = kind,
                                .color = glm::dvec3(0.1, 0.2, 0.3),
                                .intensity = 683.0,
                                .range = range});
    };
    light(Light::Kind::point, 2.5);
    light(Light::Kind::directional, 0.0);
    light(Light::Kind::spot, 0.0);
    scene.lights[2].inner_cone = 0.2;
    scene.lights[2].outer_cone = 0.7;
    scene.cameras.resize(2);
    scene.cameras[0] = Camera{.name = "a", .fov = 0.6};
    scene.cameras[1] = Camera{.name = "b", .orthographic = true, .half_height = 3.25};
    for (int i = 0; i < 3; ++i) {
        scene.nodes.push_back({.name = std::string("n").append(std::to_string(i)),
                               .parent = i - 1,
                               .transform = {.translation = glm::dvec3(0.1, 0.2, 0.3 * i),
                                             .rotation = glm::normalize(glm::dquat(1.0, 0.1, 0.2, 0.3))},
                               .camera = i < 2 ? i : no_index,
                               .light = i});
    }
    std::filesystem::create_directories(round_trip_folder);
    write_gltf(scene, round_trip_folder / "lights.glb");
    Scene loaded = load_scene(round_trip_folder / "lights.glb");
    for (Light& each : loaded.lights) each.include = no_index;
    for (Camera& each : loaded.cameras) each.include = no_index;
    EXPECT_EQ(loaded.lights, scene.lights);
    EXPECT_EQ(loaded.cameras, scene.cameras);
    const ScenePose a = pose(scene, 0.0), b = pose(loaded, 0.0);
    ASSERT_EQ(a.world.size(), b.world.size());
    for (std::size_t i = 0; i < a.world.size(); ++i) {
        for (int k = 0; k < 16; ++k) EXPECT_NEAR(a.world[i][k / 4][k % 4], b.world[i][k / 4][k % 4], 1e-15);
    }
}

}  // namespace
}  // namespace aleph
