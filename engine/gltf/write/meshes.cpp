#include "engine/gltf/write/meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "engine/base/errors.h"
#include "engine/scene/transforms.h"

namespace aleph {

namespace {

/// Sets of texture coordinates that the material looks up.
int used_uv_sets(const Scene& scene, const Mesh& mesh) {
    int sets = 0;
    if (mesh.material == no_index) return sets;
    for (const TextureRef& texture : scene.materials[mesh.material].textures.all)
        if (texture.image != no_index) sets = std::max(sets, texture.uv_set + 1);
    return sets;
}

/// A name for primitives whose names the reader makes of the mesh's: "ball" of "ball.0", "ball.1".
std::string common_name(const Scene& scene, const std::vector<int>& meshes, const std::string& node) {
    const std::string& first = scene.meshes[meshes[0]].name;
    if (meshes.size() == 1) return first;
    const std::string stem = first.ends_with(".0") ? first.substr(0, first.size() - 2) : node;
    for (std::size_t i = 0; i < meshes.size(); ++i)
        if (scene.meshes[meshes[i]].name != fmt::format("{}.{}", stem, i)) return node;
    return stem;
}

/// The direction that the triangles around each vertex face.
std::vector<glm::vec3> face_normals(const Mesh& mesh) {
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        const glm::dvec3 across = glm::cross(b - a, c - a);
        for (int i = 0; i < 3; ++i) sums[t[i]] += across;
    }
    std::vector<glm::vec3> normals;
    for (const glm::dvec3& sum : sums) {
        const glm::dvec3 normal = safe_normalize(sum);
        normals.push_back(normal == glm::dvec3(0.0) ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(normal));
    }
    return normals;
}

}  // namespace

MeshWriter::MeshWriter(GltfWriter& writer)
    : writer_(writer),
      deformers_(find_deformers(writer.scene, std::vector<std::uint8_t>(writer.scene.nodes.size(), 1))),
      sampled_by_(writer.scene.meshes.size(), no_index),
      written_(writer.scene.meshes.size()) {
    for (std::size_t d = 0; d < deformers_.size(); ++d) {
        const Mesh& mesh = writer.scene.meshes[deformers_[d].mesh];
        const bool by_points = mesh.deformation.points != no_index || mesh.subdivision.cage != no_index;
        if (by_points && mesh.deformation.skin == no_index) sampled_by_[deformers_[d].mesh] = static_cast<int>(d);
    }
}

bool MeshWriter::can_join(const Mesh& a, const Mesh& b) const {
    const auto is_sampled = [&](const Mesh& mesh) {
        return sampled_by_[&mesh - writer_.scene.meshes.data()] != no_index;
    };
    return !is_sampled(a) && !is_sampled(b) && a.present == b.present && a.deformation.skin == b.deformation.skin &&
           a.deformation.target_weights == b.deformation.target_weights &&
           a.deformation.targets.size() == b.deformation.targets.size();
}

std::vector<std::vector<int>> MeshWriter::group(const std::vector<int>& meshes) const {
    std::vector<std::vector<int>> groups;
    for (const int mesh : meshes) {
        const Mesh& each = writer_.scene.meshes[mesh];
        if (each.triangles.empty()) continue;
        const auto found = std::ranges::find_if(
            groups, [&](const std::vector<int>& group) { return can_join(each, writer_.scene.meshes[group[0]]); });
        if (found == groups.end()) {
            groups.push_back({mesh});
        } else {
            found->push_back(mesh);
        }
    }
    return groups;
}

int MeshWriter::write(const std::vector<int>& meshes, const std::string& name) {
    const auto [known, is_new] = groups_.emplace(meshes, 0);
    if (!is_new) return known->second;
    OrderedJson mesh;
    if (const std::string common = common_name(writer_.scene, meshes, name); !common.empty()) mesh["name"] = common;
    mesh["primitives"] = OrderedJson::array();
    for (const int each : meshes) {
        const Written& written = written_[each];
        if (written.primitive.is_null()) write_primitive(each);
        mesh["primitives"].push_back(written.primitive);
        if (!written.first_weights.empty()) mesh["weights"] = written.first_weights;
    }
    return known->second = writer_.add("meshes", std::move(mesh));
}

void MeshWriter::write_primitive(int index) {
    const Mesh& mesh = writer_.scene.meshes[index];
    Written& written = written_[index];
    OrderedJson& primitive = written.primitive;
    if (sampled_by_[index] != no_index) {
        write_samples(index, written);
    } else {
        primitive["attributes"] = write_attributes(mesh, mesh.positions, mesh.normals);
        if (is_skinned(mesh)) write_joint_weights(writer_, mesh, primitive["attributes"]);
        write_targets(mesh, written);
    }
    const std::span<const std::uint32_t> indices(&mesh.triangles[0].x, 3 * mesh.triangles.size());
    primitive["indices"] = writer_.buffer.add_indices(indices, mesh.positions.size());
    primitive["material"] = material_of(writer_, mesh.material);
}

OrderedJson MeshWriter::write_attributes(const Mesh& mesh, const std::vector<glm::vec3>& positions,
                                         const std::vector<glm::vec3>& normals) {
    GlbBuffer& buffer = writer_.buffer;
    OrderedJson attributes;
    attributes["POSITION"] = buffer.add_floats(floats_of(positions), "VEC3", GlbBuffer::Target::vertices, true);
    if (!normals.empty())
        attributes["NORMAL"] =
            buffer.add_floats(floats_of(unit_normals(mesh, normals)), "VEC3", GlbBuffer::Target::vertices);
    // A set that the material looks up has to be there, and so have those before it.
    const int sets = std::max(used_uv_sets(writer_.scene, mesh), mesh.uv[1].empty() ? 0 : 2);
    for (int set = 0; set < 2; ++set) {
        const std::string key = fmt::format("TEXCOORD_{}", set);
        if (!mesh.uv[set].empty()) {
            attributes[key] = buffer.add_floats(floats_of(mesh.uv[set]), "VEC2", GlbBuffer::Target::vertices);
        } else if (set < sets) {
            attributes[key] = buffer.add_zeros(positions.size(), "VEC2");
        }
    }
    if (!mesh.colors.empty())
        attributes["COLOR_0"] = buffer.add_floats(floats_of(mesh.colors), "VEC4", GlbBuffer::Target::vertices);
    return attributes;
}

std::vector<glm::vec3> MeshWriter::unit_normals(const Mesh& mesh, std::vector<glm::vec3> normals) {
    std::vector<glm::vec3> faces;
    for (std::size_t v = 0; v < normals.size(); ++v) {
        glm::vec3 unit = safe_normalize(normals[v]);
        if (unit == glm::vec3(0.0f)) {
            if (faces.empty()) faces = face_normals(mesh);
            unit = faces[v];
            if (zero_normals_++ == 0) first_zero_normal_ = mesh.name;
        }
        normals[v] = unit;
    }
    return normals;
}

void MeshWriter::finish() {
    if (zero_normals_ == 0) return;
    writer_.warnings.push_back(
        fmt::format("{} normals have no direction, the first in mesh \"{}\": those of the faces are written",
                    zero_normals_, printable(first_zero_normal_)));
}

}  // namespace aleph
