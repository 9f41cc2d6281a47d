#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "engine/gltf_reader.h"

namespace aleph {

namespace {

template <class V>
std::vector<V> read_vectors(GltfReader& reader, const tinygltf::Primitive& primitive, const std::string& attribute) {
    const auto found = primitive.attributes.find(attribute);
    if (found == primitive.attributes.end()) return {};
    const std::vector<float> values = reader.accessors.read<float>(found->second);
    const auto components = static_cast<std::size_t>(reader.accessors.components(found->second));
    const std::size_t used = std::min<std::size_t>(components, V::length());
    std::vector<V> vectors(values.size() / components, V(1.0f));  // a colour without alpha has alpha 1
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        for (std::size_t k = 0; k < used; ++k) vectors[i][static_cast<int>(k)] = values[i * components + k];
    }
    return vectors;
}

Mesh read_primitive(GltfReader& reader, const tinygltf::Primitive& primitive, const std::string& place) {
    Mesh mesh;
    mesh.material = primitive.material;
    mesh.positions = read_vectors<glm::vec3>(reader, primitive, "POSITION");
    mesh.normals = read_vectors<glm::vec3>(reader, primitive, "NORMAL");
    mesh.uv[0] = read_vectors<glm::vec2>(reader, primitive, "TEXCOORD_0");
    mesh.uv[1] = read_vectors<glm::vec2>(reader, primitive, "TEXCOORD_1");
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

    const std::vector<std::uint32_t> indices = reader.accessors.read_indices(primitive.indices, mesh.positions.size());
    mesh.triangles.reserve(indices.size() / 3);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        mesh.triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
    }
    return mesh;
}

}  // namespace

void read_meshes(GltfReader& reader) {
    for (std::size_t i = 0; i < reader.source.model.meshes.size(); ++i) {
        const tinygltf::Mesh& mesh = reader.source.model.meshes[i];
        const std::string name = mesh.name.empty() ? fmt::format("mesh{}", i) : mesh.name;
        std::vector<int>& indices = reader.meshes_of.emplace_back();
        for (std::size_t k = 0; k < mesh.primitives.size(); ++k) {
            indices.push_back(static_cast<int>(reader.part.meshes.size()));
            Mesh read = read_primitive(reader, mesh.primitives[k], fmt::format("/meshes/{}/primitives/{}", i, k));
            read.name = mesh.primitives.size() == 1 ? name : fmt::format("{}.{}", name, k);
            reader.part.meshes.push_back(std::move(read));
        }
    }
}

}  // namespace aleph
