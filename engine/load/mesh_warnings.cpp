// Warnings of meshes that load and do not look as their file means it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "engine/base/errors.h"
#include "engine/load/warnings.h"

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

/// True for a mesh with vertices that always have their places.
bool is_rigid(const Scene& scene, const Mesh& mesh) {
    const bool moves =
        mesh.deformation.points != no_index && scene.point_caches[mesh.deformation.points].positions.size() > 1;
    return !mesh.positions.empty() && !moves && mesh.deformation.targets.empty() && mesh.deformation.skin == no_index &&
           mesh.subdivision.cage == no_index;
}

/// Rigid meshes whose triangles have no area: all of them, or some.
struct Degenerate {
    Found whole, partly;
    std::ptrdiff_t triangles = 0;  ///< without an area, of the meshes that have others too

    void add(const Scene& scene, int index) {
        const Mesh& mesh = scene.meshes[index];
        if (!is_rigid(scene, mesh)) return;
        const auto count = std::ranges::count_if(mesh.triangles,
                                                 [&](const glm::uvec3& triangle) { return !has_area(mesh, triangle); });
        if (count == std::ssize(mesh.triangles)) {
            whole.add(index);
        } else if (count > 0) {
            partly.add(index);
            triangles += count;
        }
    }
};

void warn_of_degenerate(Scene& scene, const Degenerate& found) {
    if (found.whole.count > 0) {
        scene.source.warnings.push_back(name_meshes(scene, found.whole) +
                                        ": no triangle has an area, so nothing of it can be seen");
    }
    if (found.partly.count == 0) return;
    scene.source.warnings.push_back(fmt::format("{}: {} of the triangles have no area and are never seen",
                                                name_meshes(scene, found.partly), found.triangles));
}

bool has_huge_coordinates(const Mesh& mesh) {
    return std::ranges::any_of(mesh.uv, [](const std::vector<glm::vec2>& set) {
        return std::ranges::any_of(set, [](const glm::vec2& uv) {
            return !(std::max(std::abs(uv.x), std::abs(uv.y)) < max_texture_coordinate);
        });
    });
}

/// A property of a material, and the set of texture coordinates that it needs.
struct UvNeed {
    const char* key;
    int uv_set = 0;
};

/// True for a texture that gives directions: those are relative to the directions of u and v.
bool is_directional(TextureSlot slot) {
    return is_normal_map(slot) || slot == TextureSlot::anisotropy;
}

/// The first texture of the material whose set of coordinates the mesh does not have; nothing where it has them all.
std::optional<UvNeed> find_texture_without_uv(const Material& material, const Mesh& mesh, bool directional) {
    for (const MaterialTexture& texture : material_textures) {
        const TextureRef& reference = material.textures[texture.slot];
        if (is_directional(texture.slot) == directional && reference.image != no_index &&
            mesh.uv[reference.uv_set].empty())
            return UvNeed{texture.key, reference.uv_set};
    }
    return std::nullopt;
}

/// The same for what needs the directions of u and v: normal maps and anisotropy.
std::optional<UvNeed> find_direction_without_uv(const Material& material, const Mesh& mesh) {
    if (const auto texture = find_texture_without_uv(material, mesh, true)) return texture;
    const bool stretched = std::ranges::any_of(material.layers.anisotropy.values, [](double v) { return v > 0.0; });
    // A normal map gives the tangent space (KHR_materials_anisotropy).
    const TextureRef& normal = material.textures[TextureSlot::normal];
    const int set = (normal.image != no_index ? normal : material.textures[TextureSlot::anisotropy]).uv_set;
    if (stretched && mesh.uv[set].empty()) return UvNeed{"anisotropy", set};
    return std::nullopt;
}

void warn_of_missing_uv(Scene& scene, std::size_t material_index, const UvNeed& need, const Found& found,
                        const char* effect) {
    scene.source.warnings.push_back(fmt::format("{}: no texture coordinates {} for the {} of material \"{}\"; {}",
                                                name_meshes(scene, found), need.uv_set, need.key,
                                                printable(scene.materials[material_index].name), effect));
}

}  // namespace

void add_mesh_warnings(Scene& scene) {
    std::vector<bool> used(scene.meshes.size(), false);
    for (const Node& node : scene.nodes)
        for (const int mesh : node.meshes) used[mesh] = true;
    Degenerate degenerate;
    Found huge;
    std::vector<Found> without_uv(scene.materials.size()), without_directions(scene.materials.size());
    for (int i = 0; i < std::ssize(scene.meshes); ++i) {
        if (!used[i]) continue;
        const Mesh& mesh = scene.meshes[i];
        degenerate.add(scene, i);
        if (has_huge_coordinates(mesh)) huge.add(i);
        if (mesh.material == no_index) continue;
        const Material& material = scene.materials[mesh.material];
        if (find_texture_without_uv(material, mesh, false)) without_uv[mesh.material].add(i);
        if (find_direction_without_uv(material, mesh)) without_directions[mesh.material].add(i);
    }
    warn_of_degenerate(scene, degenerate);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const auto warn = [&](const Found& found, const auto& find, const char* effect) {
            if (found.count == 0) return;
            warn_of_missing_uv(scene, i, *find(scene.materials[i], scene.meshes[found.first]), found, effect);
        };
        warn(
            without_uv[i], [](const Material& m, const Mesh& mesh) { return find_texture_without_uv(m, mesh, false); },
            "one texel of the picture colours all of it");
        warn(without_directions[i], find_direction_without_uv, "it has no effect there");
    }
    if (huge.count > 0) {
        scene.source.warnings.push_back(
            fmt::format("{}: texture coordinates go beyond {:g}, where single precision holds no "
                        "place within a texture; they count as 0",
                        name_meshes(scene, huge), max_texture_coordinate));
    }
}

}  // namespace aleph
