#include "scenes/common/build.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/base/color.h"
#include "engine/base/errors.h"
#include "scenes/common/keys.h"

namespace aleph {

namespace {

/// @param roughness  of the highlight; 0: none
Material make_lambert(const std::string& name, double roughness = 0.0) {
    Material material{.name = name, .gloss = {.metallic = 0.0, .specular = 0.0}};
    if (roughness > 0.0) material.gloss.specular = 1.0, material.gloss.roughness = roughness;
    return material;
}

TextureRef find_texture(const Scene& scene, const std::string& image) {
    const auto found = std::ranges::find(scene.images, image, &SceneImage::name);
    ALEPH_CHECK(found != scene.images.end(), image);
    return {.image = static_cast<int>(found - scene.images.begin())};
}

int add_material(Scene& scene, const Material& material) {
    return append(scene.materials, material);
}

}  // namespace

glm::dquat turn(const glm::dvec3& axis, double degrees) {
    return to_millionth(glm::angleAxis(glm::radians(degrees), axis));
}

glm::dquat y_towards(const glm::dvec3& direction) {
    const glm::dvec3 to = glm::normalize(direction), up(0.0, 1.0, 0.0);
    if (to.y < -0.999999) return {0.0, 1.0, 0.0, 0.0};
    return glm::normalize(glm::dquat(1.0 + glm::dot(up, to), glm::cross(up, to)));
}

int Group::add_mesh(const std::string& name, int mesh, const glm::dvec3& translation,
                    const glm::dquat& rotation) const {
    const int added = add_node(scene, name, node, translation, rotation);
    scene.nodes.back().meshes = {mesh};
    return added;
}

int Group::add_shape(const std::string& name, const Shape& shape, int material, const glm::dvec3& translation,
                     const glm::dquat& rotation) const {
    return add_mesh(name, append(scene.meshes, make_shape_mesh(shape, material, name)), translation, rotation);
}

int Group::add_rod(const std::string& name, const glm::dvec3& from, const glm::dvec3& to, double radius, int material,
                   int segments) const {
    return add_shape(name, cylinder(radius, to_millionth(glm::distance(from, to)), segments), material,
                     to_millionth(0.5 * (from + to)), to_millionth(y_towards(to - from)));
}

int add_lambert(Scene& scene, const std::string& name, const glm::dvec3& srgb, double roughness) {
    Material material = make_lambert(name, roughness);
    glm::dvec3 linear;
    // Four decimals are more precise than eight bits of sRGB, and short in a file.
    for (int i = 0; i < 3; ++i)
        linear[i] = std::round(1e4 * srgb_to_linear(static_cast<float>(srgb[i]) / 255.0f)) / 1e4;
    material.base_color = linear;
    return add_material(scene, material);
}

int add_textured(Scene& scene, const std::string& name, const std::string& image, double roughness) {
    Material material = make_lambert(name, roughness);
    material.textures[TextureSlot::base_color] = find_texture(scene, image);
    return add_material(scene, material);
}

int add_emitter(Scene& scene, const std::string& name, const glm::dvec3& color, double radiance,
                const std::string& image) {
    Material material = make_lambert(name);
    // Black: reflected light would be invisible beside the emission, and the cache would spend records on it.
    material.base_color = glm::dvec3(0.0);
    material.glow.color = color;
    material.glow.strength = radiance;
    if (!image.empty()) material.textures[TextureSlot::emission] = find_texture(scene, image);
    return add_material(scene, material);
}

void hang_camera(Scene& scene, double fov_degrees) {
    Camera camera;
    camera.name = "camera";
    camera.fov = glm::radians(fov_degrees);
    scene.nodes.back().camera = append(scene.cameras, camera);
}

void add_walking_camera(Scene& scene, const std::vector<CameraStop>& stops, double fov_degrees) {
    std::vector<double> times, yaws, pitches;
    std::vector<glm::dvec3> eyes;
    for (const CameraStop& stop : stops) {
        const glm::dvec3 look = glm::normalize(stop.target - stop.eye);
        times.push_back(stop.frame / 30.0);
        eyes.push_back(stop.eye);
        yaws.push_back(std::atan2(-look.x, -look.z));
        pitches.push_back(std::asin(look.y));
    }
    const int rig = add_node(scene, "camera_rig");
    scene.nodes[rig].transform.translation = eased_track(times, eyes);
    turn_about(scene, rig, y_axis, eased_track(times, yaws));
    turn_about(scene, add_node(scene, "camera", rig), x_axis, eased_track(times, pitches));
    hang_camera(scene, fov_degrees);
}

}  // namespace aleph
