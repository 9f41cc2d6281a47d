#include "engine/load/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/base/errors.h"
#include "engine/pose/parts.h"
#include "engine/scene/transforms.h"

namespace aleph {

namespace {

/// True where what the node shows is flat, or a metre of it is less than an atom.
bool is_flat(const glm::dmat4& world) {
    return !has_full_rank(world) || largest_element(glm::dmat3(world)) < 1e-12;
}

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

std::string source_file(const Scene& scene, int include) {
    if (include == no_index) return scene.source.file;
    return (std::filesystem::path(scene.source.file).parent_path() / scene.source.includes[include].path).string();
}

void check_scales(Scene& scene) {
    std::vector<std::uint8_t> blind, flat;  // at every frame so far
    for (const Node& node : scene.nodes) {
        blind.push_back(node.camera != no_index);
        flat.push_back(!node.meshes.empty());
    }
    const FrameRange range = frame_range(scene);
    for (const std::int64_t frame : {range.first, range.first + (range.last - range.first) / 2, range.last}) {
        const ScenePose posed = place_nodes(scene, scene.film.frame_rate.seconds_of(frame));
        for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
            const glm::dmat4& world = posed.world[n];
            blind[n] = blind[n] != 0 && normal_matrix(world) == glm::dmat3(0.0);
            flat[n] = flat[n] != 0 && is_flat(world);
        }
    }
    if (const auto found = std::ranges::find(blind, 1); found != blind.end()) {
        const Node& node = scene.nodes[found - blind.begin()];
        throw InputError(source_file(scene, node.include), fmt::format("node \"{}\"", printable(node.name)),
                         "its camera looks in no direction: the node or one above it has a scale of 0");
    }
    const auto count = std::ranges::count(flat, 1);
    if (count == 0) return;
    const Node& first = scene.nodes[std::ranges::find(flat, 1) - flat.begin()];
    scene.source.warnings.push_back(
        fmt::format("{}node \"{}\"{}: the scale is 0, or next to it, along an axis, so nothing of it can be seen",
                    first.include == no_index ? "" : source_file(scene, first.include) + ": ", printable(first.name),
                    count > 1 ? fmt::format(" and {} more", count - 1) : ""));
}

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
