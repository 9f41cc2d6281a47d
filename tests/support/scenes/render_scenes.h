#pragma once
// Small scenes made in code for the tests of rendering.

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <utility>

#include "engine/surface/shapes.h"
#include "render/shade/frame.h"
#include "tests/support/quick_settings.h"
#include "tests/support/trial.h"

namespace aleph {

inline constexpr glm::vec3 up(0.0f, 1.0f, 0.0f);

/// A surface without glossy reflection, whose albedo is exactly `albedo`.
inline int add_lambert(Scene& scene, const glm::dvec3& albedo, const glm::dvec3& emission = glm::dvec3(0.0),
                       bool double_sided = false) {
    scene.materials.push_back({.base_color = albedo,
                               .glow = {.color = emission},
                               .gloss = {.metallic = 0.0, .specular = 0.0},
                               .double_sided = double_sided});
    return static_cast<int>(scene.materials.size()) - 1;
}

inline Mesh make_quad(double width, double height, int material) {
    return make_shape_mesh({.kind = Shape::Kind::quad, .size = {width, height, 1.0}}, material);
}

inline Mesh make_box(const glm::dvec3& size, int material) {
    return make_shape_mesh({.kind = Shape::Kind::box, .size = size}, material);
}

/// With flat facets: a polyhedron, for closed forms.
inline Mesh make_faceted_sphere(double radius, int segments, int material) {
    Mesh mesh = make_shape_mesh({.kind = Shape::Kind::sphere, .radius = radius, .segments = segments}, material);
    mesh.normals.clear();
    return mesh;
}

/// A disc in the xz plane facing down.
inline Mesh make_disc_facing_down(float radius, unsigned segments, int material) {
    Mesh mesh;
    mesh.material = material;
    mesh.positions.emplace_back(0.0f);
    for (unsigned i = 0; i < segments; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / segments;
        mesh.positions.emplace_back(radius * std::cos(angle), 0.0, radius * std::sin(angle));
        mesh.triangles.emplace_back(0, 1 + i, 1 + (i + 1) % segments);
    }
    return mesh;
}

/// The same triangles with the opposite winding.
inline Mesh flip_winding(Mesh mesh) {
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    for (glm::vec3& n : mesh.normals) n = -n;
    return mesh;
}

inline const glm::dquat no_turn{1.0, 0.0, 0.0, 0.0};
/// Rotations of a quad that faces +z, or of a light that shines along -z.
inline const glm::dquat z_to_up = glm::angleAxis(-std::numbers::pi / 2, glm::dvec3(1.0, 0.0, 0.0));
inline const glm::dquat z_to_down = glm::angleAxis(std::numbers::pi / 2, glm::dvec3(1.0, 0.0, 0.0));
/// @param angle  radians; a quarter turns +z to +x
inline glm::dquat turn_about_y(double angle) {
    return glm::angleAxis(angle, glm::dvec3(0.0, 1.0, 0.0));
}

inline int add_node(Scene& scene, const glm::dvec3& translation, const glm::dquat& rotation, int parent = no_index) {
    scene.nodes.push_back({.parent = parent, .transform = {.translation = translation, .rotation = rotation}});
    return static_cast<int>(scene.nodes.size()) - 1;
}

/// A node that carries the mesh.
inline int add_mesh(Scene& scene, Mesh mesh, const glm::dvec3& translation = glm::dvec3(0.0),
                    const glm::dquat& rotation = no_turn, int parent = no_index) {
    scene.meshes.push_back(std::move(mesh));
    const int node = add_node(scene, translation, rotation, parent);
    scene.nodes.back().meshes = {static_cast<int>(scene.meshes.size()) - 1};
    return node;
}

/// A square lamp that shines along its +z, by default down.
inline int add_lamp(Scene& scene, double side, const glm::dvec3& radiance, const glm::dvec3& translation,
                    const glm::dquat& rotation = z_to_down) {
    const int shining = add_lambert(scene, glm::dvec3(0.0), radiance);
    return add_mesh(scene, make_quad(side, side, shining), translation, rotation);
}

inline int add_light(Scene& scene, Light::Kind kind, const glm::dvec3& intensity, const glm::dvec3& position,
                     const glm::dquat& rotation = no_turn, int parent = no_index) {
    Light light{.kind = kind, .color = intensity};
    scene.lights.push_back(light);
    const int node = add_node(scene, position, rotation, parent);
    scene.nodes.back().light = static_cast<int>(scene.lights.size()) - 1;
    return node;
}

inline int add_camera(Scene& scene, const glm::dvec3& eye, const glm::dvec3& target, double fov = 0.9,
                      int parent = no_index) {
    Camera camera{.fov = fov};
    scene.cameras.push_back(camera);
    const glm::dvec3 forward = glm::normalize(target - eye);
    const glm::dvec3 above = std::abs(forward.y) > 0.99 ? glm::dvec3(0.0, 0.0, -1.0) : glm::dvec3(0.0, 1.0, 0.0);
    const int node = add_node(scene, eye, glm::quatLookAt(forward, above), parent);
    scene.nodes.back().camera = static_cast<int>(scene.cameras.size()) - 1;
    return node;
}

/// A room of 2 x 2 x 2 m about the origin, open towards a camera at +z, with a square lamp below its ceiling.
inline void add_small_room(Scene& scene, int walls, int left, const glm::dvec3& light, double lamp_size) {
    const Mesh wall = make_quad(2.0, 2.0, walls);
    add_mesh(scene, wall, {0.0, -1.0, 0.0}, z_to_up);
    add_mesh(scene, wall, {0.0, 1.0, 0.0}, z_to_down);
    add_mesh(scene, wall, {0.0, 0.0, -1.0});
    add_mesh(scene, make_quad(2.0, 2.0, left), {-1.0, 0.0, 0.0}, turn_about_y(std::numbers::pi / 2));
    add_mesh(scene, wall, {1.0, 0.0, 0.0}, turn_about_y(-std::numbers::pi / 2));
    add_lamp(scene, lamp_size, light, {0.0, 0.98, 0.0});
}

/// Surrounds the scene with a picture.
inline void add_surroundings(Scene& scene, const Image<Rgb>& picture) {
    SceneImage image{.floats = Image<glm::vec4>(picture.width, picture.height)};
    for (std::size_t i = 0; i < picture.size(); ++i) image.floats.pixels[i] = glm::vec4(picture.pixels[i], 1.0f);
    scene.images.push_back(std::move(image));
    scene.environment.image = static_cast<int>(scene.images.size()) - 1;
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(1.0));
}

/// A scene at one time, seen by its first camera (or by one at the origin), with everything that shading needs.
struct Stage {
    explicit Stage(Scene s, int width = 32, int height = 24, double seconds = 0.0)
        : scene(std::move(s)),
          frame((ensure_camera(scene), pose(scene, seconds))),
          view(make_camera_view(frame.cameras[0], width, height)),
          textures(make_texture_set(scene)),
          rays(scene),
          shading((rays.update(frame, compute_anchor(view)), make_shading_scene(scene, frame, rays, textures))),
          lights(make_light_set(shading)) {}
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    LightingContext lighting() const { return {shading, lights, rays}; }

    static void ensure_camera(Scene& s) {
        if (s.cameras.empty()) add_camera(s, glm::dvec3(0.0), glm::dvec3(0.0, 0.0, -1.0));
    }

    Scene scene;
    ScenePose frame;
    CameraView view;
    TextureSet textures;
    RayScene rays;
    ShadingScene shading;
    LightSet lights;
};

/// A surface point that need not be on a surface of the scene.
inline SurfacePoint make_point(const glm::vec3& position, const glm::vec3& normal, float offset = 1e-6f) {
    SurfacePoint point;
    point.position = position;
    point.geometric = point.normal = normal;
    point.offset = offset;
    return point;
}

inline SurfaceMaterial make_lambert(float albedo) {
    return {.diffuse = Rgb(albedo)};
}

/// A white metal.
inline SurfaceMaterial make_metal(float alpha) {
    return {.gloss = {.f0 = Rgb(1.0f), .f90 = 1.0f, .alpha = alpha}};
}

/// One pixel sample, uniform accuracy, exposure 1.
inline RenderSettings plain_settings(double accuracy, int gather) {
    RenderSettings settings;
    settings.perception.guide = Guide::none;
    settings.sampling.spp = 1;
    settings.light.light_samples = 16;
    settings.picture.filter = PixelFilter::box;
    settings.cache.accuracy = accuracy;
    settings.cache.gather = gather;
    settings.cache.light_step = 0;
    return settings;
}

inline ShadedFrame shade(const Stage& stage, const RenderSettings& settings, const SampleOptions& options = {}) {
    const Image<float> accuracy(stage.view.width, stage.view.height, static_cast<float>(settings.cache.accuracy));
    const LightingContext lighting = stage.lighting();
    const IndirectContext context{lighting, stage.view, settings, accuracy, 0, scene_radius(stage.shading), {}};
    return shade_frame(context, cast_centers(stage.rays, stage.view, nullptr), 1.0, options);
}

/// Path tracing with so many turns at Lambert layers.
inline RenderSettings path_settings(int bounces, int spp, std::uint32_t seed = 0) {
    RenderSettings settings = plain_settings(0.0, 64);
    settings.light.integrator = Integrator::path;
    settings.light.bounces = bounces;
    settings.sampling.spp = spp;
    settings.seed = seed;
    return settings;
}

/// Grey light of the first instance, found by sampling the lights.
inline SampleLight grey_sample(float value) {
    SampleLight light;
    light[LightPart::direct] = Rgb(value);
    light.place.instance = 0;
    return light;
}

/// The mean of the red of all pixels, none of which may be invalid.
inline Mean mean_of_pixels(const ShadedFrame& frame) {
    EXPECT_EQ(frame.counts.invalid_samples, 0u);
    Mean mean;
    for (const Rgb& pixel : frame.color.pixels) mean.add(pixel.x);
    return mean;
}

/// Luminance over independent pictures: of every pixel, and the sum of all.
struct PictureMeans {
    void add(const Image<Rgb>& picture) {
        pixels.resize(picture.size());
        double sum = 0.0;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            pixels[i].add(luminance(picture.pixels[i]));
            sum += luminance(picture.pixels[i]);
        }
        all.add(sum);
    }

    std::vector<Mean> pixels;
    Mean all;
};

/// Adds a camera at z = 5 m that looks along -z, by parallel rays; and exposure and range are those of a simple shot.
inline void add_flat_view(Scene& scene, double half_height, const glm::dvec2& shutter = glm::dvec2(0.0)) {
    scene.film.exposure = 1.0;
    scene.film.range = FrameRange{0, 100};
    add_camera(scene, {0.0, 0.0, 5.0}, glm::dvec3(0.0));
    Camera& camera = scene.cameras.back();
    camera.orthographic = true;
    camera.half_height = half_height;
    camera.shutter = shutter;
}

/// 4 x 3 x 5 m about the origin; all surfaces are Lambert.
inline Scene make_cluttered_room() {
    Scene scene;
    const int grey = add_lambert(scene, glm::dvec3(0.5), glm::dvec3(0.0), true);
    const int dark = add_lambert(scene, glm::dvec3(0.05), glm::dvec3(0.0), true);
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(20.0));
    add_mesh(scene, make_box({4.0, 3.0, 5.0}, grey));
    for (int i = 0; i < 32; ++i) {
        const double turn = 2.4 * i, across = 0.6 + 0.035 * i;
        add_mesh(scene, make_box({0.15, 0.3 + 0.02 * i, 0.2}, i % 2 == 0 ? dark : grey),
                 {across * std::cos(turn), -1.2 + 0.08 * i, across * std::sin(turn)}, turn_about_y(turn));
    }
    for (const double x : {-1.2, 0.0, 1.2}) {
        for (const double z : {-1.5, 1.5}) add_mesh(scene, make_quad(0.2, 0.2, lamp), {x, 1.4, z}, z_to_down);
    }
    return scene;
}

}  // namespace aleph
