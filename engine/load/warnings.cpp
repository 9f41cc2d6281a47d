#include "engine/load/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"

namespace aleph {

namespace {

/// @param name  of what turns, for messages
void add_rotation_warnings(const Track<glm::dquat>& track, const std::string& name,
                           std::vector<std::string>& warnings) {
    for (std::size_t key = 0; key < track.key_count(); ++key) {
        const double length = glm::length(key_value(track, key));
        if (std::abs(length - 1.0) <= 1e-3) continue;
        warnings.push_back(
            fmt::format("{}: rotation key {} has length {:.6g}; it counts at length 1", name, key, length));
        break;
    }
    if (track.interpolation == Interpolation::step) return;
    const double turn = largest_turn_degrees(track);
    if (!(turn > 170.0)) return;
    warnings.push_back(fmt::format(
        "{}: neighbouring rotation keys are {:.4g} degrees apart, and the rotation takes the short way; for a "
        "longer turn give an axis and degrees",
        name, turn));
}

template <class T>
bool is_positive_somewhere(const Track<T>& track) {
    return std::any_of(track.values.begin(), track.values.end(), [](const T& value) {
        if constexpr (std::is_same_v<T, double>) {
            return value > 0.0;
        } else {
            return value.x > 0.0 || value.y > 0.0 || value.z > 0.0;
        }
    });
}

}  // namespace

void add_rotation_warnings(Scene& scene) {
    for (const Node& node : scene.nodes) {
        // Other readers warn of their own nodes, with the place in the file.
        if (node.include == no_index && !node.transform.matrix && !node.transform.axis_rotation)
            add_rotation_warnings(node.transform.rotation, fmt::format("node \"{}\"", printable(node.name)),
                                  scene.source.warnings);
    }
    if (!scene.environment.axis_rotation)
        add_rotation_warnings(scene.environment.rotation, "environment_rotation", scene.source.warnings);
}

bool gives_light(const Material& material) {
    return !material.unlit && is_positive_somewhere(material.glow.color) &&
           is_positive_somewhere(material.glow.strength);
}

bool has_light(const Scene& scene) {
    if (scene.environment.radiance && is_positive_somewhere(*scene.environment.radiance)) return true;
    return std::any_of(scene.nodes.begin(), scene.nodes.end(), [&](const Node& node) {
        if (node.light != no_index) return true;
        return std::any_of(node.meshes.begin(), node.meshes.end(), [&](int mesh) {
            const int material = scene.meshes[mesh].material;
            if (material == no_index) return false;
            return gives_light(scene.materials[material]);
        });
    });
}

void add_missing_light(Scene& scene) {
    if (has_light(scene) || scene.environment.radiance) return;  // a black environment is a choice
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(1.0));
    scene.source.warnings.emplace_back("there is no light: a constant white environment was added");
}

}  // namespace aleph
