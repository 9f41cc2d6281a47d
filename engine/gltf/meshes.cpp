#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "engine/base/errors.h"
#include "engine/gltf/reader.h"

namespace aleph {

namespace {

template <class V>
std::vector<V> to_vectors(GltfReader& reader, int accessor, double max_value = max_json_number) {
    const std::vector<float> values = reader.accessors.read<float>(accessor, max_value);
    const std::size_t components = reader.accessors.components(accessor);
    const std::size_t used = std::min<std::size_t>(components, V::length());
    std::vector<V> vectors(values.size() / components, V(1.0f));  // a colour without alpha has alpha 1
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        for (std::size_t k = 0; k < used; ++k) vectors[i][static_cast<int>(k)] = values[i * components + k];
    }
    return vectors;
}

template <class V>
std::vector<V> read_vectors(GltfReader& reader, const tinygltf::Primitive& primitive, const std::string& attribute,
                            double max_value = max_json_number) {
    const auto found = primitive.attributes.find(attribute);
    if (found == primitive.attributes.end()) return {};
    return to_vectors<V>(reader, found->second, max_value);
}

int triangle_mode(const tinygltf::Primitive& primitive) {
    return primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
}

bool has_triangles(const tinygltf::Primitive& primitive) {
    return triangle_mode(primitive) >= TINYGLTF_MODE_TRIANGLES;
}

/// Triangles, strips and fans as glTF 2.0, 3.7.2.1 orders their corners, so that all face the same way.
void read_triangles(GltfReader& reader, const GltfMeshUse& use, int mode, const std::string& place, Mesh& mesh) {
    const std::size_t vertices = mesh.positions.size();
    const nlohmann::json& raw = reader.source.document["meshes"][use.mesh]["primitives"][use.primitive];
    std::vector<std::uint32_t> indices;
    if (const auto accessor = raw.find("indices"); accessor != raw.end()) {
        indices = reader.accessors.read_indices(accessor->get<int>(), vertices);
    } else {
        reader.accessors.charge(vertices * sizeof(std::uint32_t), place);
        indices.resize(vertices);
        std::iota(indices.begin(), indices.end(), 0u);
    }
    const std::size_t count = mode == TINYGLTF_MODE_TRIANGLES ? indices.size() / 3 : indices.size() - 2;
    reader.accessors.charge(count * sizeof(glm::uvec3), place);
    mesh.triangles.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLES) {
            mesh.triangles.emplace_back(indices[3 * i], indices[3 * i + 1], indices[3 * i + 2]);
            continue;
        }
        const bool is_fan = mode == TINYGLTF_MODE_TRIANGLE_FAN;
        const std::size_t odd = is_fan ? 0 : i % 2;
        const glm::uvec3 corners = is_fan ? glm::uvec3(indices[i + 1], indices[i + 2], indices[0])
                                          : glm::uvec3(indices[i], indices[i + 1 + odd], indices[i + 2 - odd]);
        // Strips repeat vertices to start anew: such triangles have no area.
        if (corners.x == corners.y || corners.y == corners.z || corners.z == corners.x) continue;
        mesh.triangles.push_back(corners);
    }
}

/// Morph targets of a primitive, without weights.
void read_targets(GltfReader& reader, const tinygltf::Primitive& primitive, const std::string& place, Mesh& mesh) {
    bool dropped_normals = false, dropped_others = false;
    for (const std::map<std::string, int>& source : primitive.targets) {
        MorphTarget target;
        for (const auto& [name, accessor] : source)
            if (name.starts_with("COLOR_") || name.starts_with("TEXCOORD_")) dropped_others = true;
        if (const auto found = source.find("POSITION"); found != source.end()) {
            target.positions = to_vectors<glm::vec3>(reader, found->second);
        }
        if (const auto found = source.find("NORMAL"); found != source.end()) {
            if (mesh.normals.empty()) {
                dropped_normals = true;
            } else {
                target.normals = to_vectors<glm::vec3>(reader, found->second);
            }
        }
        mesh.deformation.targets.push_back(std::move(target));
    }
    mesh.deformation.target_weights.assign(mesh.deformation.targets.size(), Track<double>(0.0));
    if (dropped_normals) reader.warn(place, "the mesh is shaded flat, so its morph targets' normals are not used");
    if (dropped_others) reader.warn(place, "morph targets of colours and texture coordinates are not used");
}

Mesh read_primitive(GltfReader& reader, const GltfMeshUse& use, const tinygltf::Primitive& primitive,
                    const std::string& place) {
    Mesh mesh;
    mesh.material = primitive.material < 0 ? default_material(reader) : primitive.material;
    mesh.positions = read_vectors<glm::vec3>(reader, primitive, "POSITION");
    mesh.normals = read_vectors<glm::vec3>(reader, primitive, "NORMAL");
    // Texture coordinates have no place in the world: any finite ones will do.
    constexpr double any = std::numeric_limits<float>::max();
    mesh.uv[0] = read_vectors<glm::vec2>(reader, primitive, "TEXCOORD_0", any);
    mesh.uv[1] = read_vectors<glm::vec2>(reader, primitive, "TEXCOORD_1", any);
    mesh.colors = read_vectors<glm::vec4>(reader, primitive, "COLOR_0");

    const auto is_zero = [](const glm::vec3& normal) {
        return glm::dot(glm::dvec3(normal), glm::dvec3(normal)) < 1e-12;
    };
    if (std::any_of(mesh.normals.begin(), mesh.normals.end(), is_zero)) {
        reader.warn(place, "a normal has length 0; the mesh is shaded flat");
        mesh.normals.clear();
    }
    bool clamped = false;
    for (glm::vec4& color : mesh.colors) {
        const glm::vec4 inside = glm::clamp(color, 0.0f, 1.0f);
        if (inside != color) clamped = true;
        color = inside;
    }
    if (clamped) reader.warn(place, "COLOR_0 leaves 0 to 1 and is clamped");

    read_triangles(reader, use, triangle_mode(primitive), place, mesh);
    read_targets(reader, primitive, place, mesh);
    return mesh;
}

/// Bytes of a mesh's arrays, without its names.
std::uint64_t byte_count(const Mesh& mesh) {
    const auto bytes = [](const auto& list) { return std::uint64_t{list.size()} * sizeof(list[0]); };
    std::uint64_t total = bytes(mesh.positions) + bytes(mesh.normals) + bytes(mesh.uv[0]) + bytes(mesh.uv[1]) +
                          bytes(mesh.colors) + bytes(mesh.triangles);
    for (const MorphTarget& target : mesh.deformation.targets) total += bytes(target.positions) + bytes(target.normals);
    return total;
}

/// A second scene mesh of the same primitive, rigid unless it has morph targets.
int add_copy(GltfReader& reader, int original) {
    const Mesh& source = reader.part.meshes[original];
    reader.accessors.charge(byte_count(source), fmt::format("mesh \"{}\"", printable(source.name)));
    Mesh copy = source;
    copy.deformation.target_weights.assign(copy.deformation.targets.size(), Track<double>(0.0));
    copy.deformation.skin = no_index;
    copy.deformation.joint_weights.clear();
    copy.deformation.joints_per_vertex = 0;
    return append(reader.part.meshes, std::move(copy));
}

int take_rigid(GltfReader& reader, int original) {
    GltfMeshUse& use = reader.uses[original];
    if (!use.owned) {
        use.shared = true;
        return original;
    }
    if (use.rigid_copy == no_index) use.rigid_copy = add_copy(reader, original);
    return use.rigid_copy;
}

int take_own(GltfReader& reader, int original) {
    GltfMeshUse& use = reader.uses[original];
    if (use.owned || use.shared) return add_copy(reader, original);
    use.owned = true;
    return original;
}

}  // namespace

void read_meshes(GltfReader& reader) {
    std::size_t skipped = 0;
    std::string first_skipped;
    for (std::size_t i = 0; i < reader.source.model.meshes.size(); ++i) {
        const tinygltf::Mesh& mesh = reader.source.model.meshes[i];
        const std::string name = mesh.name.empty() ? fmt::format("mesh{}", i) : mesh.name;
        std::vector<int>& indices = reader.meshes_of.emplace_back();
        for (std::size_t k = 0; k < mesh.primitives.size(); ++k) {
            const std::string place = fmt::format("/meshes/{}/primitives/{}", i, k);
            if (!has_triangles(mesh.primitives[k])) {
                if (skipped++ == 0) first_skipped = place;
                continue;
            }
            GltfMeshUse use;
            use.mesh = i;
            use.primitive = k;
            Mesh read = read_primitive(reader, use, mesh.primitives[k], place);
            read.name = mesh.primitives.size() == 1 ? name : fmt::format("{}.{}", name, k);
            indices.push_back(append(reader.part.meshes, std::move(read)));
            reader.uses.push_back(use);
        }
    }
    if (skipped > 0) {
        reader.warn(first_skipped, fmt::format("points and lines are not drawn ({} primitives left out)", skipped));
    }
}

std::vector<int> take_meshes(GltfReader& reader, std::size_t node_index) {
    const tinygltf::Node& node = reader.source.model.nodes[node_index];
    const nlohmann::json& raw = reader.source.document["nodes"][node_index];
    const auto skin = raw.find("skin");
    const tinygltf::Mesh& source = reader.source.model.meshes[node.mesh];
    const std::vector<double>& weights = node.weights.empty() ? source.weights : node.weights;
    std::vector<int> taken;
    for (const int original : reader.meshes_of[node.mesh]) {
        const GltfMeshUse use = reader.uses[original];
        const bool morphs = !reader.part.meshes[original].deformation.targets.empty();
        const bool deforms = morphs || skin != raw.end();
        const int index = deforms ? take_own(reader, original) : take_rigid(reader, original);
        taken.push_back(index);
        if (!deforms) continue;
        Mesh& mesh = reader.part.meshes[index];
        for (std::size_t k = 0; k < weights.size(); ++k) mesh.deformation.target_weights[k] = Track<double>(weights[k]);
        if (morphs) reader.morphs_of[node_index].push_back(index);
        if (skin != raw.end()) read_joint_weights(reader, use, skin->get<std::size_t>(), mesh);
    }
    return taken;
}

}  // namespace aleph
