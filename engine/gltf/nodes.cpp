#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
        glm::dmat4 matrix;
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = source.matrix[i];
        node.transform.matrix = Track<glm::dmat4>(matrix);
        return;
    }
    const auto vector = [](const std::vector<double>& v) { return glm::dvec3(v[0], v[1], v[2]); };
    if (!source.translation.empty()) node.transform.translation = vector(source.translation);
    if (!source.rotation.empty()) {
        const UnitRotation unit = read_rotation(reader, source.rotation.data(), place + "/rotation");
        if (unit.was_far_from_unit()) {
            reader.warn(place, fmt::format("the rotation quaternion has length {:.6g} and is normalized", unit.length));
        }
        node.transform.rotation = unit.rotation;
    }
    if (!source.scale.empty()) node.transform.scale = vector(source.scale);
}

/// tinygltf reads the file's lights, but not which node holds which.
int find_light(const nlohmann::json& node) {
    const auto extensions = node.find("extensions");
    if (extensions == node.end()) return no_index;
    const auto extension = extensions->find("KHR_lights_punctual");
    return extension == extensions->end() ? no_index : extension->at("light").get<int>();
}

bool has_extension(const nlohmann::json& node, const char* name) {
    const auto extensions = node.find("extensions");
    return extensions != node.end() && extensions->contains(name);
}

/// KHR_node_visibility.
bool is_visible(const nlohmann::json& node) {
    return !has_extension(node, "KHR_node_visibility") ||
           node["extensions"]["KHR_node_visibility"].value("visible", true);
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
    reader.skin_of.assign(document.contains("skins") ? document["skins"].size() : 0, no_index);
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
        const bool is_instanced = has_extension(raw, "EXT_mesh_gpu_instancing");
        if (source.mesh >= 0 && !is_instanced) node.meshes = take_meshes(reader, source_index);
        node.camera = source.camera;
        node.light = find_light(raw);
        if (!is_visible(raw)) node.visible = Track<double>(0.0);
        instances += node.meshes.size();
        const int index = static_cast<int>(reader.part.nodes.size());
        reader.node_of[source_index] = index;
        reader.part.nodes.push_back(std::move(node));
        if (is_instanced) instances += read_instances(reader, source_index, index);
        if (instances > max_instances) {
            throw InputError(reader.source.file, place, fmt::format("more than {} instances of meshes", max_instances));
        }
        push(source.children, index);
    }
}

}  // namespace aleph
