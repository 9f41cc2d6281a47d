#include "engine/load/mesh_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/base/errors.h"
#include "engine/load/source_file.h"
#include "engine/scene/texture_limits.h"

namespace aleph {

namespace {

/// The first of the meshes that a warning is about, and how many there are.
struct Found {
    int first = no_index;
    std::size_t count = 0;

    void add(int mesh) {
        if (count++ == 0) first = mesh;
    }
};

/// `mesh "ball" and 2 more`, after the path of the file that brought it where that is an include.
std::string name_meshes(const Scene& scene, const Found& found) {
    const Mesh& mesh = scene.meshes[found.first];
    std::string text = fmt::format("mesh \"{}\"", printable(mesh.name));
    if (mesh.include != no_index) text = source_file(scene, mesh.include) + ": " + text;
    if (found.count > 1) text += fmt::format(" and {} more", found.count - 1);
    return text;
}

bool has_area(const Mesh& mesh, const glm::uvec3& triangle) {
    const glm::dvec3 corner = mesh.positions[triangle.x];
    const glm::dvec3 a = glm::dvec3(mesh.positions[triangle.y]) - corner;
    const glm::dvec3 b = glm::dvec3(mesh.positions[triangle.z]) - corner;
    return glm::length(glm::cross(a, b)) > 1e-14 * std::max(glm::dot(a, a), glm::dot(b, b));
}

/// True for a rigid mesh with vertices of which nothing can be drawn.
bool is_degenerate(const Scene& scene, const Mesh& mesh) {
    const bool moves = mesh.points != no_index && scene.point_caches[mesh.points].positions.size() > 1;
    if (mesh.positions.empty() || moves || !mesh.targets.empty() || mesh.skin != no_index || mesh.cage != no_index)
        return false;
    return std::ranges::none_of(mesh.triangles, [&](const glm::uvec3& triangle) { return has_area(mesh, triangle); });
}

bool has_huge_coordinates(const Mesh& mesh) {
    return std::ranges::any_of(mesh.uv, [](const std::vector<glm::vec2>& set) {
        return std::ranges::any_of(set, [](const glm::vec2& uv) {
            return !(std::max(std::abs(uv.x), std::abs(uv.y)) < max_texture_coordinate);
        });
    });
}

/// The first texture of the material whose set of coordinates the mesh does not have; nothing where it has them all.
const MaterialTexture* find_texture_without_uv(const Material& material, const Mesh& mesh) {
    const auto found = std::ranges::find_if(material_textures, [&](const MaterialTexture& texture) {
        const TextureRef& reference = material.*texture.member;
        return reference.image != no_index && mesh.uv[reference.uv_set].empty();
    });
    return found == material_textures.end() ? nullptr : &*found;
}

void warn_of_missing_uv(Scene& scene, std::size_t material_index, const Found& found) {
    const Material& material = scene.materials[material_index];
    const MaterialTexture* texture = find_texture_without_uv(material, scene.meshes[found.first]);
    scene.warnings.push_back(fmt::format(
        "{}: no texture coordinates {} for the {} of material \"{}\"; one texel of "
        "the picture colours all of it",
        name_meshes(scene, found), (material.*texture->member).uv_set, texture->key, printable(material.name)));
}

}  // namespace

void add_mesh_warnings(Scene& scene) {
    std::vector<bool> used(scene.meshes.size(), false);
    for (const Node& node : scene.nodes)
        for (const int mesh : node.meshes) used[mesh] = true;
    Found degenerate, huge;
    std::vector<Found> without_uv(scene.materials.size());
    for (int i = 0; i < std::ssize(scene.meshes); ++i) {
        if (!used[i]) continue;
        const Mesh& mesh = scene.meshes[i];
        if (is_degenerate(scene, mesh)) degenerate.add(i);
        if (has_huge_coordinates(mesh)) huge.add(i);
        if (mesh.material != no_index && find_texture_without_uv(scene.materials[mesh.material], mesh) != nullptr)
            without_uv[mesh.material].add(i);
    }
    if (degenerate.count > 0) {
        scene.warnings.push_back(name_meshes(scene, degenerate) +
                                 ": no triangle has an area, so nothing of it can be seen");
    }
    for (std::size_t i = 0; i < without_uv.size(); ++i)
        if (without_uv[i].count > 0) warn_of_missing_uv(scene, i, without_uv[i]);
    if (huge.count > 0) {
        scene.warnings.push_back(
            fmt::format("{}: texture coordinates go beyond {:g}, where single precision holds no "
                        "place within a texture; they count as 0",
                        name_meshes(scene, huge), max_texture_coordinate));
    }
}

}  // namespace aleph
