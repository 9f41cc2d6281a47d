#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "engine/base/errors.h"
#include "engine/gltf/reader.h"

namespace aleph {

namespace {

/// (node, mesh) pairs in one file: a small file can multiply many nodes by many primitives.
constexpr std::size_t max_instances = 10'000'000;

/// The default scene's roots; without scenes, every node that has no parent.
std::vector<int> find_roots(const tinygltf::Model& model) {
    if (!model.scenes.empty()) return model.scenes[std::max(model.defaultScene, 0)].nodes;
    std::vector<bool> is_child(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes) {
        for (const int child : node.children) is_child[child] = true;
    }
    std::vector<int> roots;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (!is_child[i]) roots.push_back(static_cast<int>(i));
    }
    return roots;
}

void read_transform(GltfReader& reader, const tinygltf::Node& source, const std::string& place, Node& node) {
    if (!source.matrix.empty()) {
        node.transform.matrix = Track<glm::dmat4>(glm::make_mat4(source.matrix.data()));
        return;
    }
    if (!source.translation.empty()) node.transform.translation = glm::make_vec3(source.translation.data());
    if (!source.rotation.empty()) {
        const UnitRotation unit = read_rotation(reader, source.rotation.data(), place + "/rotation");
        if (unit.was_far_from_unit()) {
            reader.warn(place, fmt::format("the rotation quaternion has length {:.6g} and is normalized", unit.length));
        }
        node.transform.rotation = unit.rotation;
    }
    if (!source.scale.empty()) node.transform.scale = glm::make_vec3(source.scale.data());
}

/// Values of an instance attribute in double; empty where it is absent.
std::vector<double> read_attribute(GltfReader& reader, const nlohmann::json& attributes, const char* name) {
    const auto found = attributes.find(name);
    if (found == attributes.end()) return {};
    return reader.accessors.read<double>(found->get<int>());
}

/// Child nodes for EXT_mesh_gpu_instancing in place of the node's own meshes.
/// @param node_index  of the file; @param parent  its scene node
/// @return (node, mesh) pairs made
std::size_t read_instances(GltfReader& reader, const nlohmann::json& instancing, std::size_t node_index, int parent) {
    const std::string place = fmt::format("/nodes/{}/extensions/EXT_mesh_gpu_instancing", node_index);
    const nlohmann::json& attributes = instancing["attributes"];
    const std::size_t count = reader.accessors.count(attributes.begin()->get<int>());
    // A node takes far more room than its attributes; twice while the list of nodes grows.
    reader.accessors.charge(count * 2 * sizeof(Node), place);
    const std::vector<double> translations = read_attribute(reader, attributes, "TRANSLATION");
    const std::vector<double> rotations = read_attribute(reader, attributes, "ROTATION");
    const std::vector<double> scales = read_attribute(reader, attributes, "SCALE");
    const bool is_float = rotations.empty() || reader.accessors.is_float(attributes["ROTATION"].get<int>());
    const std::string name = reader.part.nodes[parent].name;
    std::size_t far_from_unit = 0, made = 0;
    for (std::size_t i = 0; i < count; ++i) {
        Node node{.name = fmt::format("{}.{}", name, i), .parent = parent};
        if (!translations.empty()) node.transform.translation = glm::make_vec3(&translations[3 * i]);
        if (!scales.empty()) node.transform.scale = glm::make_vec3(&scales[3 * i]);
        if (!rotations.empty()) {
            const UnitRotation unit =
                read_rotation(reader, &rotations[4 * i], fmt::format("{}/attributes/ROTATION: instance {}", place, i));
            if (unit.was_far_from_unit(is_float)) ++far_from_unit;
            node.transform.rotation = unit.rotation;
        }
        node.meshes = take_meshes(reader, node_index);
        made += node.meshes.size();
        reader.part.nodes.push_back(std::move(node));
    }
    if (far_from_unit > 0) {
        reader.warn(place, fmt::format("{} rotations are not of length 1 and are normalized", far_from_unit));
    }
    return made;
}

}  // namespace

UnitRotation read_rotation(const GltfReader& reader, const double* values, const std::string& place) {
    // Scaled by the largest component first: squares of tiny or huge ones would under- or overflow.
    const double largest =
        std::max({std::abs(values[0]), std::abs(values[1]), std::abs(values[2]), std::abs(values[3])});
    if (largest == 0.0) throw InputError(reader.source.file, place, "the rotation quaternion is zero");
    const glm::dquat scaled(values[3] / largest, values[0] / largest, values[1] / largest, values[2] / largest);
    const double length = std::sqrt(glm::dot(scaled, scaled));
    return {scaled / length, length * largest};
}

void read_nodes(GltfReader& reader) {
    const tinygltf::Model& model = reader.source.model;
    reader.node_of.assign(model.nodes.size(), no_index);
    reader.morphs_of.resize(model.nodes.size());
    const nlohmann::json& document = reader.source.document;
    reader.skin_of.assign(reader.source.count("skins"), no_index);
    struct Entry {
        int source;
        int parent;
    };
    std::vector<Entry> open;  // depth first, in the file's order, without recursion
    const auto push = [&](const std::vector<int>& nodes, int parent) {
        for (auto it = nodes.rbegin(); it != nodes.rend(); ++it) open.push_back({*it, parent});
    };
    push(find_roots(model), no_index);
    std::size_t instances = 0;
    while (!open.empty()) {
        const Entry entry = open.back();
        open.pop_back();
        const auto source_index = static_cast<std::size_t>(entry.source);
        const tinygltf::Node& source = model.nodes[source_index];
        const std::string place = fmt::format("/nodes/{}", entry.source);
        Node node;
        node.name = source.name.empty() ? fmt::format("node{}", entry.source) : source.name;
        node.parent = entry.parent;
        read_transform(reader, source, place, node);
        const nlohmann::json& raw = document["nodes"][source_index];
        const nlohmann::json* const instancing = find_extension(raw, "EXT_mesh_gpu_instancing");
        if (source.mesh >= 0 && instancing == nullptr) node.meshes = take_meshes(reader, source_index);
        node.camera = source.camera;
        // tinygltf reads the file's lights, but not which node holds which.
        if (const auto* light = find_extension(raw, "KHR_lights_punctual")) node.light = light->at("light").get<int>();
        const auto* visibility = find_extension(raw, "KHR_node_visibility");
        if (visibility != nullptr && !visibility->value("visible", true)) node.visible = Track<double>(0.0);
        instances += node.meshes.size();
        const int index = append(reader.part.nodes, std::move(node));
        reader.node_of[source_index] = index;
        if (instancing != nullptr) instances += read_instances(reader, *instancing, source_index, index);
        if (instances > max_instances) {
            throw InputError(reader.source.file, place, fmt::format("more than {} instances of meshes", max_instances));
        }
        push(source.children, index);
    }
}

}  // namespace aleph
