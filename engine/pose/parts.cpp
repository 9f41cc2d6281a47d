#include "engine/pose/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/errors.h"
#include "engine/scene/operations.h"
#include "engine/scene/transforms.h"

namespace aleph {
namespace {

/// Cubic keys overshoot: values are clamped to the range of their quantity.
float unit_range(const Track<double>& track, double seconds) {
    return static_cast<float>(std::clamp(evaluate(track, seconds), 0.0, 1.0));
}
double cone_angle(const Track<double>& track, double seconds) {
    return std::clamp(evaluate(track, seconds), 0.0, std::numbers::pi / 2.0);
}
double not_negative(const Track<double>& track, double seconds) {
    return std::max(evaluate(track, seconds), 0.0);
}
glm::dvec3 not_negative(const Track<glm::dvec3>& track, double seconds) {
    return glm::max(evaluate(track, seconds), glm::dvec3(0.0));
}

/// @param about_axis  stands in place of `rotation` where it is set
glm::dquat rotation_at(const Track<glm::dquat>& rotation, const std::optional<AxisRotation>& about_axis,
                       double seconds) {
    return about_axis ? rotation_at(*about_axis, seconds) : evaluate(rotation, seconds);
}

glm::dmat4 matrix_at(const LocalTransform& local, double seconds) {
    if (local.operations) return evaluate(*local.operations, seconds);
    if (local.matrix) return evaluate(*local.matrix, seconds);
    const glm::dmat3 rotation = glm::mat3_cast(rotation_at(local.rotation, local.axis_rotation, seconds));
    const glm::dvec3 scale = evaluate(local.scale, seconds);
    return {glm::dvec4(rotation[0] * scale.x, 0.0), glm::dvec4(rotation[1] * scale.y, 0.0),
            glm::dvec4(rotation[2] * scale.z, 0.0), glm::dvec4(evaluate(local.translation, seconds), 1.0)};
}

/// The value of a key, without interpolation: for visibility, which does not fade.
double evaluate_whole(const Track<double>& track, double seconds) {
    const std::size_t key = track.interpolation == Interpolation::nearest
                                ? nearest_sample(track.sampling, track.key_count(), seconds)
                                : find_samples(track.sampling, track.key_count(), seconds).floor;
    return key_value(track, key);
}

}  // namespace

glm::dquat rotation_at(const AxisRotation& turn, double seconds) {
    const glm::dvec3 axis = safe_normalize(turn.axis);
    const double half = 0.5 * evaluate(turn.angle, seconds);
    return safe_normalize(glm::dquat(std::cos(half), axis * std::sin(half)));
}

void place_node(const Scene& scene, int index, double seconds, ScenePose& posed) {
    const Node& node = scene.nodes[index];
    ALEPH_CHECK(node.parent < index, fmt::format("node {} has parent {}", index, node.parent));
    const glm::dmat4 local = matrix_at(node.transform, seconds);
    const double visible = evaluate_whole(node.visible, seconds);
    const int space = space_of(scene, node);
    const int above = evaluate_whole(node.inherits, seconds) == 0.0 ? space : node.parent;
    posed.world[index] = above == no_index ? local : posed.world[above] * local;
    const int shown_by = visible >= 2.0 ? space : node.parent;
    posed.visible[index] = visible != 0.0 && (shown_by == no_index || posed.visible[shown_by] != 0);
}

ScenePose place_nodes(const Scene& scene, double seconds) {
    ScenePose posed;
    posed.seconds = seconds;
    posed.world.resize(scene.nodes.size());
    posed.visible.resize(scene.nodes.size());
    for (int node = 0; node < std::ssize(scene.nodes); ++node) place_node(scene, node, seconds, posed);
    return posed;
}

int find_camera_node(const Scene& scene, int camera) {
    for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
        if (scene.nodes[node].camera != no_index && camera-- == 0) return static_cast<int>(node);
    }
    return no_index;
}

bool is_shown(const Scene& scene, const ScenePose& posed, std::size_t instance) {
    const Instance& of = posed.instances[instance];
    return posed.visible[of.node] != 0 && evaluate_whole(scene.meshes[of.mesh].present, posed.seconds) != 0.0;
}

bool is_always_present(const Mesh& mesh) {
    return !is_animated(mesh.present) && evaluate_whole(mesh.present, 0.0) != 0.0;
}

MaterialValues pose_material(const Material& material, double seconds) {
    const auto unit = [&](const Track<double>& track) { return unit_range(track, seconds); };
    const auto positive = [&](const Track<double>& track) { return static_cast<float>(not_negative(track, seconds)); };
    const auto color = [&](const Track<glm::dvec3>& track) {
        return Rgb(glm::min(not_negative(track, seconds), glm::dvec3(1.0)));
    };
    const Gloss& gloss = material.gloss;
    const Glass& glass = material.glass;
    const Layers& layers = material.layers;
    return {.base_color = color(material.base_color),
            .alpha = unit(material.opacity.alpha),
            .emission = Rgb(not_negative(material.glow.color, seconds) * not_negative(material.glow.strength, seconds)),
            .gloss = {.metallic = unit(gloss.metallic),
                      .roughness = unit(gloss.roughness),
                      .specular = unit(gloss.specular),
                      .specular_color = Rgb(not_negative(gloss.specular_color, seconds)),
                      .ior = positive(gloss.ior)},
            .glass = {.transmission = unit(glass.transmission),
                      .thickness = positive(glass.thickness),
                      .attenuation_distance = positive(glass.attenuation_distance),
                      .attenuation_color = color(glass.attenuation_color)},
            .layers = {.clearcoat = unit(layers.clearcoat),
                       .clearcoat_roughness = unit(layers.clearcoat_roughness),
                       .sheen_color = color(layers.sheen_color),
                       .sheen_roughness = unit(layers.sheen_roughness),
                       .anisotropy = unit(layers.anisotropy),
                       .anisotropy_rotation = static_cast<float>(evaluate(layers.anisotropy_rotation, seconds))}};
}

LightValues pose_light(const Scene& scene, int node, const glm::dmat4& world, double seconds) {
    const Light& light = scene.lights[scene.nodes[node].light];
    LightValues values;
    values.kind = light.kind;
    values.node = node;
    values.position = glm::dvec3(world[3]);
    const glm::dvec3 direction = safe_normalize(-glm::dvec3(world[2]));
    if (direction != glm::dvec3(0.0)) values.direction = direction;
    values.intensity = Rgb(not_negative(light.color, seconds) * not_negative(light.intensity, seconds));
    values.range = not_negative(light.range, seconds);
    values.inner_cone = cone_angle(light.inner_cone, seconds);
    values.outer_cone = cone_angle(light.outer_cone, seconds);
    return values;
}

CameraValues pose_camera(const Scene& scene, int node, const glm::dmat4& world, double seconds) {
    const Camera& camera = scene.cameras[scene.nodes[node].camera];
    return {.node = node,
            .orthographic = camera.orthographic,
            .position = glm::dvec3(world[3]),
            .axes = orthonormal_axes(world),
            .fov = evaluate(camera.fov, seconds),
            .half_height = evaluate(camera.half_height, seconds),
            .shift_x = evaluate(camera.shift_x, seconds),
            .shift_y = evaluate(camera.shift_y, seconds),
            .near_plane = camera.near_plane,
            .aperture = not_negative(camera.aperture, seconds),
            .focus_distance = not_negative(camera.focus_distance, seconds)};
}

void pose_environment(const Environment& environment, double seconds, ScenePose& posed) {
    posed.environment = environment.radiance ? Rgb(not_negative(*environment.radiance, seconds)) : Rgb(0.0f);
    posed.environment_rotation = glm::mat3_cast(rotation_at(environment.rotation, environment.axis_rotation, seconds));
}

}  // namespace aleph
