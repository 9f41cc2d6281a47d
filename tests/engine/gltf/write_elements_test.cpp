// The writer of .glb: meshes that deform, what is hidden, materials over time, textures, what is lost.
#include "engine/surface/limit_surface.h"
#include "tests/engine/gltf/exported.h"
#include "tests/support/read_bytes.h"
#include "tests/support/scenes/cage_scenes.h"
#include "tests/support/scenes/deforming_scenes.h"

namespace aleph {
namespace {

/// World positions of the vertices of all meshes that are shown, mesh by mesh in the order of nodes; sorted by node.
std::vector<glm::dvec3> shown_points(const Scene& scene, const std::vector<int>& order, double seconds) {
    const ScenePose posed = pose(scene, seconds);
    std::vector<glm::dvec3> points;
    std::vector<int> place(scene.nodes.size(), no_index);
    for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<int>(i);
    std::vector<std::pair<int, std::size_t>> shown;
    for (std::size_t i = 0; i < posed.instances.size(); ++i) {
        int node = posed.instances[i].node;
        if (place[node] == no_index) node = scene.nodes[node].parent;  // a part of the node above
        if (posed.shown[i] != 0) shown.emplace_back(place[node], i);
    }
    std::stable_sort(shown.begin(), shown.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [node, i] : shown) {
        const Instance& instance = posed.instances[i];
        const Mesh& mesh = scene.meshes[instance.mesh];
        const std::vector<glm::dvec3>& moved = posed.meshes[instance.mesh].positions;
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            const glm::dvec3 p = moved.empty() ? glm::dvec3(mesh.positions[v]) : moved[v];
            points.emplace_back(posed.world[instance.node] * glm::dvec4(p, 1.0));
        }
    }
    return points;
}

/// The same points, at any place in the list, are shown at these times.
void expect_same_points(const Exported& files, const std::vector<double>& times, double tolerance) {
    for (const double t : times) {
        std::vector<glm::dvec3> a = shown_points(files.before, files.nodes_before, t),
                                b = shown_points(files.after, files.nodes_after, t);
        ASSERT_EQ(a.size(), b.size()) << t;
        for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT(glm::length(a[i] - b[i]), tolerance) << i << " at " << t;
    }
}

std::vector<double> times_between(double first, double last) {
    std::vector<double> times;
    for (int i = 0; i <= 24; ++i) times.push_back(first + (last - first) * i / 24.0);
    return times;
}

/// Programs that take the width beside the height would else stretch the picture.
TEST(GltfWriteElements, BothSizesOfAnOrthographicViewMove) {
    Scene scene;
    Camera camera;
    camera.name = "view";
    camera.orthographic = true;
    camera.half_height = Track<double>({0.0, 2.0}, {1.0, 4.0});
    scene.cameras.push_back(camera);
    Node node;
    node.name = "eye";
    node.camera = 0;
    scene.nodes.push_back(node);
    const Exported files(scene, "write_view");
    const std::string text = read_bytes(files.file);
    for (const char* const size : {"/cameras/0/orthographic/xmag", "/cameras/0/orthographic/ymag"})
        EXPECT_NE(text.find(size), std::string::npos) << size;
    EXPECT_EQ(evaluate(files.after.cameras[0].half_height, 1.0), 2.5);
}

TEST(GltfWriteElements, EverythingThatCanMove) {
    Scene scene = make_everything_scene();
    scene.film.range = FrameRange{0, 60};
    const Exported files(scene, "write_everything");
    // Half frames too: what is sampled here is a single turn.
    expect_same_points(files, times_between(0.0, 2.0), 1e-5);
    const ScenePose a = pose(files.before, 0.4), b = pose(files.after, 0.4);
    ASSERT_EQ(a.lights.size(), 2u);
    ASSERT_EQ(b.lights.size(), 2u);
    for (int k = 0; k < 2; ++k) EXPECT_FLOAT_EQ(a.lights[k].intensity.x, b.lights[1 - k].intensity.x);
    EXPECT_NEAR(a.materials[1].gloss.roughness, b.materials[1].gloss.roughness, 1e-6);
}

TEST(GltfWriteElements, PointsMoveStraightBetweenSamples) {
    Scene scene = make_sheet_scene(3);
    add_cache(scene, 0, {0.1, 0.4, 0.5, 0.9}, [](const glm::vec3& p, std::size_t sample) {
        const float lift = sample == 2 ? 1.0f : static_cast<float>(sample);  // twice the same shape
        return p + glm::vec3(0.0f, p.x * lift, lift);
    });
    const Exported files(scene, "write_points");
    expect_same_points(files, times_between(0.0, 1.0), 2e-6);
    EXPECT_EQ(files.after.meshes[0].deformation.targets.size(), 2u);
}

TEST(GltfWriteElements, CagesAreWrittenAtTheirLevel) {
    const TestCage cage = make_cube_cage();
    std::vector<glm::dvec3> bent = cage.points;
    for (glm::dvec3& p : bent) p.x += 0.5 * p.y;
    const Exported files(make_cage_scene(cage, {cage.points, bent, cage.points}, 2), "write_cage");
    expect_same_points(files, times_between(0.0, 2.0 / 30.0), 1e-5);
    EXPECT_TRUE(files.after.cages.empty());
}

TEST(GltfWriteElements, HiddenNodesAndWhatIsShownBelowThem) {
    Scene scene = make_sheet_scene(1);
    scene.meshes.push_back(make_sheet(2));
    scene.meshes.push_back(make_sheet(3));
    scene.meshes[1].present = Track<double>({0.1, 0.7}, {0.0, 1.0}, Interpolation::nearest);
    scene.nodes.resize(3);
    scene.nodes[0].meshes = {0, 1};
    scene.nodes[0].visible = Track<double>({0.0, 0.3, 0.6}, {1.0, 0.0, 1.0}, Interpolation::step);
    scene.nodes[1] = {.name = "below", .parent = 0, .meshes = {2}};
    scene.nodes[2] = {.name = "lamp", .parent = 1, .light = 0};
    scene.lights.resize(1);
    const std::vector<double> times = times_between(0.0, 1.0);
    expect_same_points(Exported(scene, "write_hidden"), times, 1e-6);
    scene.nodes[1].visible = Track<double>({0.0, 0.45}, {2.0, 1.0}, Interpolation::step);
    const Exported files(scene, "write_shown_below");
    expect_same_points(files, times, 1e-6);
    for (const double t : times)
        EXPECT_EQ(pose(files.before, t).lights.size(), pose(files.after, t).lights.size()) << t;
}

TEST(GltfWriteElements, MaterialsOverTime) {
    Scene scene = make_sheet_scene();
    Material material;
    material.name = "all";
    const auto track = [](double from, double to) { return Track<double>({0.0, 0.7, 1.0}, {from, to, from}); };
    material.base_color = Track<glm::dvec3>({0.0, 0.5}, {{0.1, 0.2, 0.3}, {1.0, 0.5, 0.0}});
    material.opacity.alpha = Track<double>({0.25, 0.75}, {1.0, 0.5}, Interpolation::step);
    material.glow.color = Track<glm::dvec3>({0.0, 1.0}, {{5.0, 2.0, 0.0}, {0.0, 20.0, 1.0}});
    material.glow.strength = track(0.5, 3.0);
    material.gloss = {.metallic = track(0.0, 1.0),
                      .roughness = track(0.2, 0.9),
                      .specular = track(1.0, 0.1),
                      .specular_color = Track(glm::dvec3(1.0, 2.0, 3.0)),
                      .ior = track(1.1, 2.0)};
    material.glass = {.transmission = track(0.0, 0.5),
                      .thickness = track(0.1, 0.2),
                      .attenuation_distance = track(0.5, 2.0),
                      .attenuation_color = Track(glm::dvec3(0.5))};
    material.layers = {.clearcoat = track(0.0, 1.0),
                       .clearcoat_roughness = track(0.3, 0.4),
                       .sheen_color = Track<glm::dvec3>({0.0, 1.0}, {{0, 0, 0}, {1, 0.5, 0.25}}),
                       .sheen_roughness = track(0.1, 0.9),
                       .anisotropy = track(0.0, 0.7),
                       .anisotropy_rotation = track(-1.0, 7.0)};
    scene.materials = {material};
    scene.meshes[0].material = 0;
    const Exported files(scene, "write_materials");
    for (const double t : times_between(0.0, 1.0)) {
        const MaterialValues a = pose(files.before, t).materials[0], b = pose(files.after, t).materials[0];
        const auto near = [&](const Rgb& x, const Rgb& y, const char* name) {
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(x[k], y[k], 1e-5) << name << " at " << t;
        };
        near(a.base_color, b.base_color, "base colour");
        near(a.emission, b.emission, "emission");
        near(a.layers.sheen_color, b.layers.sheen_color, "sheen");
        near(a.gloss.specular_color, b.gloss.specular_color, "specular colour");
        near({a.alpha, a.gloss.metallic, a.gloss.roughness}, {b.alpha, b.gloss.metallic, b.gloss.roughness}, "core");
        near({a.gloss.specular, a.gloss.ior, a.glass.transmission},
             {b.gloss.specular, b.gloss.ior, b.glass.transmission}, "gloss");
        near({a.glass.thickness, a.glass.attenuation_distance, a.glass.attenuation_color.x},
             {b.glass.thickness, b.glass.attenuation_distance, b.glass.attenuation_color.x}, "volume");
        near({a.layers.clearcoat, a.layers.clearcoat_roughness, a.layers.sheen_roughness},
             {b.layers.clearcoat, b.layers.clearcoat_roughness, b.layers.sheen_roughness}, "layers");
        near({a.layers.anisotropy, a.layers.anisotropy_rotation, 0},
             {b.layers.anisotropy, b.layers.anisotropy_rotation, 0}, "anisotropy");
    }
}

TEST(GltfWriteElements, TexturesKeepTheirBytes) {
    Scene scene = make_sheet_scene();
    Image<glm::u8vec4> bytes(3, 2);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const auto c = static_cast<std::uint8_t>(40 * i);
        bytes.pixels[i] = {c, 255 - c, 7, 128 + c / 2};  // colours below alpha 1 stay as they are
    }
    scene.images.push_back({.name = "bytes", .path = "", .bytes = bytes, .floats = {}});
    scene.images.push_back(
        {.name = "floats", .path = "sky.exr", .bytes = {}, .floats = Image<glm::vec4>(1, 1, {0.5f, 3, 0, 1})});
    Material material;
    material.textures[TextureSlot::base_color] = {.image = 0,
                                                  .uv_set = 1,
                                                  .wrap_u = Wrap::mirror,
                                                  .wrap_v = Wrap::clamp,
                                                  .nearest = true,
                                                  .uv_offset = {0.25, -3},
                                                  .uv_scale = {2, -1},
                                                  .uv_rotation = 0.5};
    material.textures[TextureSlot::emission] = {.image = 1};
    material.textures[TextureSlot::normal] = {.image = 1};
    material.glow.color = glm::dvec3(1.0);
    scene.materials = {material};
    scene.meshes[0].material = 0;
    const Exported files(scene, "write_textures");
    const MaterialImages& textures = files.after.materials[0].textures;
    const TextureRef& base = textures[TextureSlot::base_color];
    EXPECT_EQ(files.after.images[base.image].bytes, bytes);
    TextureRef expected = material.textures[TextureSlot::base_color];
    expected.image = base.image;
    EXPECT_EQ(base, expected);
    const auto texel = [&](TextureSlot slot) { return files.after.images[textures[slot].image].bytes.pixels[0]; };
    EXPECT_EQ(texel(TextureSlot::emission), glm::u8vec4(188, 255, 0, 255)) << "sRGB";
    EXPECT_EQ(texel(TextureSlot::normal), glm::u8vec4(128, 255, 0, 255)) << "linear";
    EXPECT_EQ(files.after.meshes[0].uv[1].size(), files.after.meshes[0].positions.size())
        << "zeros: the material looks there";
    EXPECT_EQ(files.losses.size(), 2u);
}

TEST(GltfWriteElements, LossesAreNamedOnce) {
    EXPECT_TRUE(Exported(make_sheet_scene(), "write_plain").losses.empty());
    Scene scene = make_everything_scene();
    scene.film.exposure = 2.0;
    scene.film.cuts = {3};
    scene.nodes[10].name = "first";
    scene.nodes[11].name = "second";
    scene.film.camera_keys = {{0, "first"}, {5, "second"}};
    scene.film.viewing.display_white = 300.0;
    scene.cameras[0].aperture = 0.1;
    scene.cameras[1].aperture = 0.1;
    scene.source.settings["spp"] = 4.0;
    const std::vector<std::string> losses = Exported(scene, "write_losses").losses;
    ASSERT_EQ(losses.size(), 7u);
    const char* words[] = {"environment", "exposure", "cuts", "change of cameras", "aperture", "display", "settings"};
    for (std::size_t i = 0; i < losses.size(); ++i) EXPECT_NE(losses[i].find(words[i]), std::string::npos) << losses[i];
}

TEST(GltfWriteElements, NormalsWithoutDirectionAreReplaced) {
    Scene scene = make_sheet_scene(1);
    scene.meshes[0].normals = {{0, 0, 0}, {0, 0, 3}, {0, 3e-30f, 4e-30f}, {0, 0, 1}};
    const Exported files(scene, "write_normals");
    const std::vector<glm::vec3> expected = {{0, 0, 1}, {0, 0, 1}, {0, 0.6f, 0.8f}, {0, 0, 1}};
    EXPECT_EQ(files.after.meshes[0].normals, expected);
    EXPECT_EQ(files.losses.size(), 1u);
}

TEST(GltfWriteElements, EmptyScenesAndSharedMeshes) {
    EXPECT_TRUE(Exported(Scene{}, "write_empty").before.nodes.empty());
    Scene scene = make_sheet_scene();
    scene.nodes.resize(20, scene.nodes[0]);
    EXPECT_EQ(Exported(scene, "write_shared").after.meshes.size(), 1u);
}

TEST(GltfWriteElements, SaveSceneWritesGlbAndNoGltf) {
    const Scene scene = make_sheet_scene();
    std::filesystem::create_directories(round_trip_folder);
    EXPECT_TRUE(save_scene(scene, round_trip_folder / "saved.GLB").empty());
    EXPECT_EQ(load_scene(round_trip_folder / "saved.GLB").meshes[0].positions, scene.meshes[0].positions);
    EXPECT_THROW(save_scene(scene, round_trip_folder / "saved.gltf"), InputError);
    Scene broken = scene;
    broken.nodes[0].transform.translation = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    EXPECT_THROW(save_scene(broken, round_trip_folder / "broken.glb"), InputError);
    EXPECT_FALSE(std::filesystem::exists(round_trip_folder / "broken.glb"));
}

}  // namespace
}  // namespace aleph
