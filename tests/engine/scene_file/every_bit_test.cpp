// A scene with everything that a scene file can say comes back bit by bit, in every locale.

#include <bit>
#include <clocale>
#include <type_traits>

#include "engine/scene/operations.h"
#include "engine/scene/visit.h"
#include "engine/scene_file/fields.h"
#include "engine/scene_file/scene_text.h"
#include "engine/scene_file/tracks.h"
#include "engine/surface/shapes.h"
#include "tests/support/german_locale.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(SceneJson, WholeDegreesComeBackAsWritten) {
    for (int degrees = -1080; degrees <= 1080; ++degrees) {
        EXPECT_EQ(exact_degrees(to_radians(degrees)), static_cast<double>(degrees));
        EXPECT_EQ(exact_degrees(to_radians(degrees + 0.1)), degrees + 0.1);
    }
}

// Doubles from their bits: subnormals, huge ones, every exponent.
class Numbers {
  public:
    double any() {
        for (;;) {
            const double value = std::bit_cast<double>(random_());
            if (std::isfinite(value) && std::abs(value) <= 1e18) return value;
        }
    }
    double positive() { return std::max(std::abs(any()), 1e-12); }
    double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
    int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }

    template <class Make>
    auto track(const Make& make, bool may_be_cubic = true) -> Track<decltype(make())> {
        Track<decltype(make())> track;
        const int keys = 1 + below(4);
        track.interpolation = static_cast<Interpolation>(below(may_be_cubic ? 4 : 3));
        track.values.resize(static_cast<std::size_t>(track.interpolation == Interpolation::cubic ? 3 * keys : keys));
        for (auto& value : track.values) value = make();
        track.sampling.kind = static_cast<TimeSampling::Kind>(below(3));
        if (track.sampling.kind == TimeSampling::Kind::uniform) track.sampling.start = below(2) ? unit() : 0.0;
        if (track.sampling.kind != TimeSampling::Kind::acyclic) track.sampling.period = below(2) ? 2.0 + unit() : 1.0;
        if (track.sampling.kind != TimeSampling::Kind::uniform) {
            const int times = track.sampling.kind == TimeSampling::Kind::cyclic ? 2 : keys;
            for (int i = 0; i < times; ++i)
                track.sampling.times.push_back(below(2) ? i * 0.5 : i * 0.5 + 0.25 * unit());
        }
        return track;
    }

  private:
    std::mt19937_64 random_{7};
};

Scene make_full_scene(Numbers& n) {
    const auto vector = [&] { return glm::dvec3(n.any(), n.any(), n.any()); };
    const auto color = [&] { return glm::dvec3(n.unit(), n.unit(), n.unit()); };
    const auto positive = [&] { return n.positive(); };
    const auto unit = [&] { return n.unit(); };
    const auto quaternion = [&] { return glm::dquat(n.positive(), n.any(), n.any(), n.any()); };
    Scene scene;
    scene.source.name = "everything \"quoted\" \\ \n / ~ ü";
    scene.film.frame_rate = {24000, 1001};
    scene.film.viewing = {n.positive(), n.positive(), n.unit()};
    scene.film.range = FrameRange{-5, 1000000};
    scene.film.cuts = {-1, 3, 77};
    scene.film.exposure = n.positive();
    scene.environment.radiance = n.track(color);
    scene.environment.image = n.below(3);
    if (n.below(2) == 0) {
        scene.environment.rotation = n.track(quaternion);
    } else {
        scene.environment.axis_rotation = AxisRotation{glm::normalize(glm::dvec3(n.unit(), n.unit(), 1.0)),
                                                       n.track([&] { return 100.0 * n.unit(); })};
    }
    if (n.below(2) == 0) {
        scene.film.camera = "camera 1";
    } else {
        scene.film.camera_keys = {{-1000000000, "camera 1"}, {7, "camera 0"}};
    }
    scene.source.settings = {
        {"accuracy", n.unit()}, {"spp", 4.0}, {"neutral_opponent", false}, {"guide", std::string("none")}};
    for (const char* name : {"z", "a/b~c", "3"}) {
        scene.images.push_back({.name = name, .path = std::string(name) + ".png"});
    }
    for (int i = 0; i < 6; ++i) {
        Material material;
        material.name = fmt::format("material {}", 9 - i);
        if (i > 0) {
            for (const auto& field : material_numbers) field.in(material) = n.track(unit);
            material.gloss.ior = n.track([&] { return 1.0 + n.unit(); });
            for (const auto& field : material_colors) field.in(material) = n.track(color);
            for (const auto& field : material_angles) field.in(material) = n.track([&] { return 10.0 * n.unit(); });
            for (const auto& field : material_scales) field.in(material) = n.any();
            for (const auto& field : material_textures) {
                material.textures[field.slot] = {
                    n.below(3),      n.below(2),         static_cast<Wrap>(n.below(3)), static_cast<Wrap>(n.below(3)),
                    n.below(2) == 1, {n.any(), n.any()}, {n.any(), n.unit()},           10.0 * n.unit()};
            }
            material.opacity.mode = static_cast<Opacity::Mode>(i % 3);
            if (material.opacity.mode == Opacity::Mode::mask) material.opacity.cutoff = n.unit();
            material.unlit = i == 2;
            material.double_sided = true;
        }
        scene.materials.push_back(material);
        Light light;
        light.name = fmt::format("light {}", i);
        light.kind = static_cast<Light::Kind>(i % 3);
        light.color = n.track(color);
        light.intensity = n.track(positive);
        if (light.kind != Light::Kind::directional) light.range = n.track(positive);
        if (light.kind == Light::Kind::spot) {
            light.inner_cone = n.track([&] { return 0.5 * n.unit(); });
            light.outer_cone = n.track([&] { return 0.6 + 0.5 * n.unit(); });
        }
        scene.lights.push_back(light);
        Camera camera;
        camera.name = fmt::format("camera {}", i);
        camera.orthographic = i == 2;
        camera.fov = n.track([&] { return 0.001 + 3.0 * n.unit(); });
        camera.half_height = n.track(positive);
        camera.shift_x = n.track(unit);
        camera.shift_y = n.track(unit);
        camera.near_plane = n.positive();
        camera.shutter = {-n.unit(), n.unit()};
        camera.aperture = n.track(unit);
        camera.focus_distance = n.track(positive);
        scene.cameras.push_back(camera);
        Shape shape{.kind = static_cast<Shape::Kind>(i)};
        if (i == 0) shape.size = {n.positive(), n.positive(), 1.0};
        if (i == 1) shape.size = {n.positive(), n.positive(), n.positive()};
        if (i >= 2) shape.radius = n.positive();
        if (i == 3) shape.height = n.positive();
        if (i >= 2) shape.segments = 3 + n.below(20);
        if (i == 4) shape.tube_radius = shape.radius * (0.1 + 0.8 * n.unit());
        if (i == 5) {
            shape.radius = Shape{}.radius;
            for (int p = 0; p < 5; ++p) shape.profile.emplace_back(n.unit(), n.unit());
            shape.smooth = n.below(2) == 1;
        }
        shape.uv_scale = {n.unit(), n.any()};
        scene.meshes.push_back(make_shape_mesh(shape, i - 1, fmt::format("mesh {}", i)));
    }
    for (int i = 0; i < 40; ++i) {
        Node node;
        node.name = i % 7 == 6 ? "" : fmt::format("node {}", 50 - i);
        if (i > 0 && i % 7 != 0) node.parent = i - 1;
        if (node.parent >= 0 && scene.nodes[node.parent].name.empty()) node.parent = no_index;
        if (i % 6 == 3) {
            OperationStack& stack = node.transform.operations.emplace();
            for (int o = n.below(5); o > 0; --o)
                stack.operations.push_back(static_cast<OperationStack::Kind>(n.below(7)));
            const Track<double> times = n.track(unit, false);  // for its sampling
            for (std::size_t key = 0; key < times.values.size() && !stack.operations.empty(); ++key) {
                stack.sampling = times.sampling;
                for (const OperationStack::Kind kind : stack.operations) {
                    std::vector<double> channels(channel_count(kind));
                    for (double& channel : channels) channel = i == 9 ? 0.5 : n.unit();  // 9: keys that change nothing
                    if (channels.size() == 16) channels[3] = channels[7] = channels[11] = 0.0, channels[15] = 1.0;
                    stack.channels.insert(stack.channels.end(), channels.begin(), channels.end());
                }
            }
        } else if (i % 3 == 0) {
            node.transform.matrix = n.track(
                [&] {
                    glm::dmat4 m(1.0);
                    for (int c = 0; c < 4; ++c) m[c] = glm::dvec4(vector(), c == 3 ? 1.0 : 0.0);
                    return m;
                },
                false);
        } else {
            node.transform.translation = n.track(vector);
            node.transform.scale = n.track([&] { return n.below(2) ? glm::dvec3(n.any()) : vector(); });
            if (i % 3 == 1) {
                node.transform.rotation = n.track(quaternion);
            } else {
                node.transform.axis_rotation = AxisRotation{glm::normalize(glm::dvec3(n.unit(), n.unit(), 1.0)),
                                                            n.track([&] { return 100.0 * n.unit(); })};
            }
        }
        node.visible = n.track([&] { return static_cast<double>(n.below(3)); }, false);
        node.visible.interpolation = n.below(2) == 0 ? Interpolation::step : Interpolation::nearest;
        node.inherits = n.track([&] { return static_cast<double>(n.below(2)); }, false);
        node.inherits.interpolation = Interpolation::step;
        for (int mesh = 0; mesh < i % 4; ++mesh) node.meshes.push_back((i + mesh) % 6);
        if (i % 5 == 0) node.camera = n.below(4);
        if (i % 6 == 0) node.light = n.below(4);
        scene.nodes.push_back(node);
    }
    scene.source.includes = {{"x/a.glb", 3}, {"../b.gltf", 3}, {"c.glb", 17}, {"d.glb", no_index}};
    scene.source.includes[1].animations = {"walk", "animation 2"};
    scene.source.includes[1].up = Include::Up::z;
    scene.source.includes[2].animations.emplace();
    scene.source.includes[2].materials = {{"wood", "material 0"}, {"", "material 1"}};
    scene.source.includes[2].scale = n.positive();
    return scene;
}

/// The tracks of a material that differ between two, and how many there are.
std::pair<int, int> count_differences(const Material& a, const Material& b) {
    std::vector<const void*> tracks_of_b;
    visit_tracks(b, [&](const auto& track) { tracks_of_b.push_back(&track); });
    std::size_t at = 0;
    int different = 0;
    visit_tracks(a, [&](const auto& track) {
        using T = std::remove_cvref_t<decltype(track)>;
        if (!(track == *static_cast<const T*>(tracks_of_b[at++]))) ++different;
    });
    return {different, static_cast<int>(at)};
}

TEST(SceneJsonWrite, TheFullSceneSetsEveryTrackAndTextureOfItsMaterials) {
    Numbers numbers;
    const Material material = make_full_scene(numbers).materials[1], absent;
    const auto [different, all] = count_differences(material, absent);
    EXPECT_EQ(different, all);
    EXPECT_EQ(all, 19);
    for (const auto& field : material_textures) EXPECT_NE(material.textures[field.slot].image, no_index) << field.key;
    EXPECT_NE(material.textures.normal_scale, absent.textures.normal_scale);
    EXPECT_NE(material.textures.clearcoat_normal_scale, absent.textures.clearcoat_normal_scale);
}

TEST(SceneJsonWrite, LoadOfSaveIsTheSameScene) {
    Numbers numbers;
    for (int i = 0; i < 20; ++i) {
        const Scene scene = make_full_scene(numbers);
        const std::string text = write_scene_text(scene, "test.json");
        const Scene loaded = read_scene_text(text, "test.json").scene;
        EXPECT_TRUE(loaded == scene);
        EXPECT_EQ(write_scene_text(loaded, "test.json"), text);
    }
}

TEST(SceneJsonWrite, DT09_CommaLocaleChangesNothing) {
    Numbers numbers;
    const Scene scene = make_full_scene(numbers);
    const std::string text = write_scene_text(scene, "test.json");
    const GermanLocale locale;
    if (!locale.available()) GTEST_SKIP() << "no locale with a decimal comma can be made";
    EXPECT_EQ(write_scene_text(scene, "test.json"), text);
    EXPECT_TRUE(read_scene_text(text, "test.json").scene == scene);
    EXPECT_EQ(std::string(std::localeconv()->decimal_point), ",") << "the caller's locale has to stay";
}

}  // namespace
}  // namespace aleph
