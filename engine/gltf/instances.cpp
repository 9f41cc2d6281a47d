// glTF reader: EXT_mesh_gpu_instancing becomes nodes of their own.
#include <fmt/format.h>

#include "engine/base/errors.h"
#include "engine/gltf/reader.h"

namespace aleph {

namespace {

/// Values of an instance attribute in double; empty where it is absent.
std::vector<double> read_attribute(GltfReader& reader, const nlohmann::json& attributes, const char* name) {
    const auto found = attributes.find(name);
    if (found == attributes.end()) return {};
    return reader.accessors.read<double>(found->get<int>());
}

}  // namespace

std::size_t read_instances(GltfReader& reader, std::size_t node_index, int parent) {
    const std::string place = fmt::format("/nodes/{}/extensions/EXT_mesh_gpu_instancing", node_index);
    const nlohmann::json& attributes =
        reader.source.document["nodes"][node_index]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
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
        const auto vector = [&](const std::vector<double>& v) {
            return glm::dvec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
        };
        if (!translations.empty()) node.transform.translation = vector(translations);
        if (!scales.empty()) node.transform.scale = vector(scales);
        if (!rotations.empty()) {
            const UnitRotation unit =
                read_rotation(reader, &rotations[4 * i], fmt::format("{}/attributes/ROTATION: instance {}", place, i));
            if (unit.was_far_from_unit(rotation_tolerance(is_float))) ++far_from_unit;
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

}  // namespace aleph
