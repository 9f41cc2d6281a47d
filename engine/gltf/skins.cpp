// glTF reader: skins and their joints.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "engine/base/errors.h"
#include "engine/gltf/reader.h"
#include "engine/scene/transforms.h"

namespace aleph {

namespace {

constexpr int joints_per_set = 4;

/// Files round weights: a sum within this of 1 needs no warning.
constexpr double weight_sum_tolerance = 1e-2;

/// One vertex's weights to a sum of 1. @return whether they were near it before
bool normalize_weights(JointWeight* weights, int count) {
    double sum = 0.0;
    for (int i = 0; i < count; ++i) sum += static_cast<double>(weights[i].weight);
    if (sum > 0.0) {
        for (int i = 0; i < count; ++i) {
            weights[i].weight = static_cast<float>(static_cast<double>(weights[i].weight) / sum);
        }
    } else {
        weights[0].weight = 1.0f;  // without a joint the vertex would move to the origin
    }
    return std::abs(sum - 1.0) <= weight_sum_tolerance;
}

/// The top node above each node, itself for a root: parents stand first.
std::vector<int> find_tops(const std::vector<Node>& nodes) {
    std::vector<int> tops;
    for (const Node& node : nodes) {
        tops.push_back(node.parent == no_index ? static_cast<int>(tops.size()) : tops[node.parent]);
    }
    return tops;
}

std::vector<glm::dmat4> read_inverse_binds(GltfReader& reader, const nlohmann::json& raw, std::size_t joints,
                                           const std::string& place) {
    std::vector<glm::dmat4> matrices(joints, glm::dmat4(1.0));
    const auto accessor = raw.find("inverseBindMatrices");
    if (accessor == raw.end()) return matrices;
    const std::vector<double> values = reader.accessors.read<double>(accessor->get<int>());
    for (std::size_t i = 0; i < joints; ++i) {
        matrices[i] = glm::make_mat4(&values[16 * i]);
        if (glm::row(matrices[i], 3) != glm::dvec4(0.0, 0.0, 0.0, 1.0)) {
            throw InputError(reader.source.file, place + "/inverseBindMatrices",
                             fmt::format("matrix {} is not affine: its last row must be 0 0 0 1", i));
        }
    }
    return matrices;
}

/// The scene skin of a glTF skin; its joints follow once all nodes are read (read_skins).
int use_skin(GltfReader& reader, std::size_t skin) {
    int& index = reader.skin_of[skin];
    if (index == no_index) index = append(reader.part.skins, {});
    return index;
}

/// Returns whether a node's own transform is flat at a key, or mirrors from one key to the next.
bool can_flatten(const LocalTransform& transform) {
    const Track<glm::dvec3>& scale = transform.scale;
    const glm::dvec3 first = key_value(scale, 0);
    for (std::size_t i = 0; i < scale.key_count(); ++i) {
        const glm::dvec3& key = key_value(scale, i);
        if (!has_full_rank(glm::scale(glm::dmat4(1.0), key)) || glm::sign(key) != glm::sign(first)) return true;
    }
    return transform.matrix && !has_full_rank(key_value(*transform.matrix, 0));  // glTF does not animate it
}

}  // namespace

void read_joint_weights(GltfReader& reader, const GltfMeshUse& use, std::size_t skin, Mesh& mesh) {
    const std::string place = fmt::format("/meshes/{}/primitives/{}", use.mesh, use.primitive);
    const std::size_t joint_count = reader.source.document["skins"][skin]["joints"].size();
    const nlohmann::json& attributes =
        reader.source.document["meshes"][use.mesh]["primitives"][use.primitive]["attributes"];
    const int sets = attributes.contains("JOINTS_1") ? 2 : 1;
    const std::size_t per_vertex = static_cast<std::size_t>(sets * joints_per_set);
    reader.accessors.charge(mesh.positions.size() * per_vertex * sizeof(JointWeight), place);
    mesh.deformation.skin = use_skin(reader, skin);
    mesh.deformation.joints_per_vertex = static_cast<int>(per_vertex);
    mesh.deformation.joint_weights.assign(mesh.positions.size() * per_vertex, {});
    for (int set = 0; set < sets; ++set) {
        const int joints_accessor = attributes[fmt::format("JOINTS_{}", set)].get<int>();
        const int weights_accessor = attributes[fmt::format("WEIGHTS_{}", set)].get<int>();
        const std::vector<std::uint32_t> joints = reader.accessors.read_indices(joints_accessor, joint_count, "joint");
        const std::vector<float> weights = reader.accessors.read<float>(weights_accessor);
        for (std::size_t i = 0; i < joints.size(); ++i) {
            if (weights[i] < 0.0f) {
                throw InputError(reader.source.file, fmt::format("/accessors/{}", weights_accessor),
                                 fmt::format("vertex {} has the weight {}: it must not be negative", i / joints_per_set,
                                             weights[i]));
            }
            const std::size_t vertex = i / joints_per_set, k = i % joints_per_set;
            JointWeight& slot =
                mesh.deformation
                    .joint_weights[vertex * per_vertex + static_cast<std::size_t>(set * joints_per_set) + k];
            slot = {joints[i], weights[i]};
        }
    }
    std::size_t far_from_one = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (!normalize_weights(&mesh.deformation.joint_weights[i * per_vertex], mesh.deformation.joints_per_vertex))
            ++far_from_one;
    }
    if (far_from_one > 0) {
        reader.warn(place,
                    fmt::format("the joint weights of {} vertices do not sum to 1 and are scaled", far_from_one));
    }
    if (attributes.contains("JOINTS_2")) reader.warn(place, "only eight joints per vertex are read");
}

void read_skins(GltfReader& reader) {
    const std::vector<int> tops = find_tops(reader.part.nodes);
    for (std::size_t i = 0; i < reader.skin_of.size(); ++i) {
        if (reader.skin_of[i] == no_index) continue;
        const nlohmann::json& raw = reader.source.document["skins"][i];
        const std::string place = fmt::format("/skins/{}", i);
        Skin skin;
        skin.name = raw.value("name", fmt::format("skin{}", i));
        for (const nlohmann::json& joint : raw["joints"]) {
            const std::string joint_place = fmt::format("{}/joints/{}", place, skin.joints.size());
            const int node = reader.node_of[joint.get<std::size_t>()];
            if (node == no_index) {
                throw InputError(reader.source.file, joint_place,
                                 fmt::format("node {} is not in the scene", joint.get<std::size_t>()));
            }
            skin.joints.push_back(node);
            // glTF 2.0, 3.7.3.2.
            if (tops[node] != tops[skin.joints[0]]) {
                throw InputError(reader.source.file, joint_place,
                                 "the joints of a skin must stand below one root node");
            }
        }
        skin.inverse_binds = read_inverse_binds(reader, raw, skin.joints.size(), place);
        reader.part.skins[reader.skin_of[i]] = std::move(skin);
    }
}

void free_skinned_meshes(GltfReader& reader) {
    std::vector<Node>& nodes = reader.part.nodes;
    const auto is_skinned = [&](int mesh) { return reader.part.meshes[mesh].deformation.skin != no_index; };
    std::vector<bool> can_be_flat;
    for (const Node& node : nodes)
        can_be_flat.push_back(can_flatten(node.transform) || (node.parent != no_index && can_be_flat[node.parent]));
    for (std::size_t i = 0; i < can_be_flat.size(); ++i) {
        if (!can_be_flat[i] || std::ranges::none_of(nodes[i].meshes, is_skinned)) continue;
        Node own{.name = nodes[i].name + ".skin", .parent = static_cast<int>(i)};
        own.inherits = Track<double>(0.0);
        own.meshes = std::move(nodes[i].meshes);  // a mesh of glTF is skinned as a whole
        nodes[i].meshes.clear();
        nodes.push_back(std::move(own));
    }
}

}  // namespace aleph
