// Meshes: the sizes, indices and numbers of their arrays.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/color.h"
#include "engine/load/checked_element.h"
#include "engine/load/validate_scene.h"
#include "engine/scene/visit.h"
#include "engine/surface/shapes.h"

namespace aleph {

namespace {

void validate_points(const CheckedElement& at, const Scene& scene, const Mesh& mesh) {
    const Deformation& deformation = mesh.deformation;
    if (deformation.points != no_index) {
        const std::size_t points = scene.point_caches[deformation.points].point_count();
        at.require(!deformation.vertex_points.empty() || mesh.positions.size() <= points,
                   "has more vertices than its point cache has points");
        for (const std::uint32_t point : deformation.vertex_points) {
            if (point >= points) at.refuse(fmt::format("a vertex uses point {}, but the cache has {}", point, points));
        }
    }
    for (const auto& normals : deformation.normal_samples) {
        at.require(normals.size() == mesh.positions.size(),
                   "a sample of its normals has another number of them than of positions");
    }
    if (!deformation.normal_samples.empty())
        at.check_sampling(deformation.normal_sampling, deformation.normal_samples.size());
}

void validate_skin(const CheckedElement& at, const Scene& scene, const Mesh& mesh) {
    const Deformation& deformation = mesh.deformation;
    if (deformation.skin == no_index) return;
    at.require(deformation.joints_per_vertex > 0 &&
                   deformation.joint_weights.size() ==
                       mesh.positions.size() * static_cast<std::size_t>(deformation.joints_per_vertex),
               "needs joints_per_vertex weights for each vertex");
    const std::size_t joints = scene.skins[deformation.skin].joints.size();
    for (const JointWeight& weight : deformation.joint_weights) {
        at.check_index(static_cast<int>(weight.joint), joints, "joint", false);
        at.require(std::isfinite(weight.weight), "a weight of a joint is not finite");
    }
}

}  // namespace

void validate_mesh(const Scene& scene, int index) {
    const Mesh& mesh = scene.meshes[index];
    const Deformation& deformation = mesh.deformation;
    const CheckedElement at(scene, "mesh", static_cast<std::size_t>(index), mesh.name);
    const std::size_t count = mesh.positions.size();
    const auto fits = [&](std::size_t size) { return size == 0 || size == count; };
    at.require(fits(mesh.normals.size()), "needs as many normals as positions, or none");
    at.require(fits(mesh.uv[0].size()) && fits(mesh.uv[1].size()),
               "needs as many texture coordinates as positions, or none");
    at.require(fits(mesh.colors.size()), "needs as many colours as positions, or none");
    at.require(fits(deformation.vertex_points.size()), "needs as many vertex_points as positions, or none");
    at.require(std::ranges::all_of(mesh.positions, is_finite), "a position is not finite");
    for (const glm::uvec3& triangle : mesh.triangles) {
        const std::uint32_t highest = std::max({triangle.x, triangle.y, triangle.z});
        if (highest >= count) at.refuse(fmt::format("a triangle has vertex {}, but there are {}", highest, count));
    }
    if (mesh.shape) at.check_shape(*mesh.shape);
    at.check_index(mesh.material, scene.materials.size(), "material");
    at.check_index(deformation.points, scene.point_caches.size(), "point cache");
    at.check_index(mesh.subdivision.cage, scene.cages.size(), "cage");
    at.check_index(deformation.skin, scene.skins.size(), "skin");
    visit_tracks(mesh, [&](const Track<double>& track) { at.check_track(track); });
    at.check_words("present", mesh.present, 1);
    at.require(deformation.target_weights.size() == deformation.targets.size(),
               "needs one weight track for each morph target");
    for (const MorphTarget& target : deformation.targets) {
        at.require(fits(target.positions.size()) && fits(target.normals.size()),
                   "a morph target needs as many displacements as the mesh has positions, or none");
        at.require(std::ranges::all_of(target.positions, is_finite), "a displacement of a morph target is not finite");
    }
    validate_points(at, scene, mesh);
    validate_skin(at, scene, mesh);
}

}  // namespace aleph
