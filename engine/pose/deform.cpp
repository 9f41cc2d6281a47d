#include "engine/pose/deform.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <tuple>

#include "engine/scene/points.h"
#include "engine/scene/transforms.h"
#include "engine/surface/limit_surface.h"

namespace aleph {
namespace {

const PointCache& cache_of(const Scene& scene, const Mesh& mesh) {
    return scene.point_caches[mesh.deformation.points];
}

bool is_cage_animated(const Scene& scene, const Mesh& mesh) {
    if (mesh.subdivision.cage == no_index || mesh.subdivision.limit.surface == nullptr) return false;
    const int points = scene.cages[mesh.subdivision.cage].points;
    return points != no_index && is_animated(scene.point_caches[points]);
}

bool are_weights_on(const Deformation& deformation) {
    return std::ranges::any_of(deformation.target_weights, [](const Track<double>& weight) {
        return is_animated(weight) || key_value(weight, 0) != 0.0;
    });
}

/// Compares vectors rounded to multiples of a unit. Generators compute both ends of a seam, which differ by rounding.
std::partial_ordering compare_rounded(const glm::vec3& a, const glm::vec3& b, float unit) {
    const glm::vec3 m = glm::round(a / unit), n = glm::round(b / unit);
    return std::tie(m.x, m.y, m.z) <=> std::tie(n.x, n.y, n.z);
}

float find_largest(const std::vector<glm::vec3>& points) {
    float largest = 1e-30f;
    for (const glm::vec3& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return largest;
}

bool are_weights_animated(const Deformation& deformation) {
    return std::ranges::any_of(deformation.target_weights, [](const auto& weight) { return is_animated(weight); });
}

/// Vertices of one point and one rest normal get one number. Where vertices are listed as points of their own, as along
/// a seam of the texture, those are one point that are together at every sample.
std::vector<std::uint32_t> group_normals(const PointCache& cache, const Mesh& mesh) {
    const std::vector<std::uint32_t>& points = mesh.deformation.vertex_points;
    const float unit = 1e-6f * find_largest(mesh.positions);
    constexpr float normal_unit = 1e-4f;
    const auto compare_points = [&](std::uint32_t a, std::uint32_t b) -> std::partial_ordering {
        if (!points.empty()) return points[a] <=> points[b];
        for (const std::vector<glm::vec3>& sample : cache.positions) {
            const std::partial_ordering order = compare_rounded(sample[a], sample[b], unit);
            if (order != 0) return order;
        }
        return std::partial_ordering::equivalent;
    };
    const auto comes_before = [&](std::uint32_t a, std::uint32_t b) {
        const std::partial_ordering order = compare_rounded(mesh.normals[a], mesh.normals[b], normal_unit);
        return (order == 0 ? compare_points(a, b) : order) < 0;
    };
    std::map<std::uint32_t, std::uint32_t, decltype(comes_before)> known(comes_before);
    std::vector<std::uint32_t> groups(mesh.positions.size());
    for (std::uint32_t v = 0; v < groups.size(); ++v)
        groups[v] = known.try_emplace(v, static_cast<std::uint32_t>(known.size())).first->second;
    return groups;
}

/// Sums of the triangles' normals in each group, weighted by the angle at the vertex, so that the way a face was cut
/// into triangles does not matter (Thuermer and Wuethrich 1998, Journal of Graphics Tools 3(1)).
std::vector<glm::vec3> find_normals(const Mesh& mesh, const std::vector<glm::dvec3>& positions,
                                    const std::vector<std::uint32_t>& groups) {
    std::vector<glm::dvec3> sums(positions.size(), glm::dvec3(0.0));
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 corners[3] = {positions[t.x], positions[t.y], positions[t.z]};
        const glm::dvec3 product = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double twice_area = glm::length(product);
        if (!(twice_area > 0.0)) continue;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 to_next = corners[(i + 1) % 3] - corners[i], to_last = corners[(i + 2) % 3] - corners[i];
            const double angle = std::atan2(twice_area, glm::dot(to_next, to_last));
            sums[groups[t[i]]] += product * (angle / twice_area);
        }
    }
    std::vector<glm::vec3> normals(positions.size());
    for (std::size_t v = 0; v < normals.size(); ++v) normals[v] = glm::vec3(safe_normalize(sums[groups[v]]));
    return normals;
}

std::vector<glm::vec3> sample_normals(const Deformation& deformation, double seconds) {
    const auto& samples = deformation.normal_samples;
    const SampleSpan span = find_samples(deformation.normal_sampling, samples.size(), seconds);
    std::vector<glm::vec3> normals = samples[span.floor];
    if (span.floor == span.ceil) return normals;
    const std::vector<glm::vec3>& next = samples[span.ceil];
    const auto fraction = static_cast<float>(span.fraction);
    for (std::size_t v = 0; v < normals.size(); ++v) normals[v] += (next[v] - normals[v]) * fraction;
    return normals;
}

void deform_points(const Scene& scene, const Deformer& deformer, double seconds, PosedMesh& posed) {
    const Mesh& mesh = scene.meshes[deformer.mesh];
    std::vector<glm::dvec3> points = sample_points(cache_of(scene, mesh), seconds);
    const std::vector<std::uint32_t>& vertex_points = mesh.deformation.vertex_points;
    if (vertex_points.empty()) {
        posed.positions = std::move(points);
    } else {
        posed.positions.resize(vertex_points.size());
        for (std::size_t v = 0; v < posed.positions.size(); ++v) posed.positions[v] = points[vertex_points[v]];
    }
    if (!deformer.normal_groups.empty()) {
        posed.normals = find_normals(mesh, posed.positions, deformer.normal_groups);
    } else if (!mesh.deformation.normal_samples.empty()) {
        posed.normals = sample_normals(mesh.deformation, seconds);
    } else {
        posed.normals = mesh.normals;
    }
}

/// The mesh with its targets on; unit normals where targets move them.
void morph(const Mesh& mesh, double seconds, PosedMesh& posed) {
    posed.positions.assign(mesh.positions.begin(), mesh.positions.end());
    std::vector<glm::dvec3> normals(mesh.normals.begin(), mesh.normals.end());
    bool moves_normals = false;
    const Deformation& deformation = mesh.deformation;
    for (std::size_t i = 0; i < std::min(deformation.targets.size(), deformation.target_weights.size()); ++i) {
        const double weight = evaluate(deformation.target_weights[i], seconds);
        if (weight == 0.0) continue;
        const MorphTarget& target = deformation.targets[i];
        for (std::size_t v = 0; v < target.positions.size(); ++v)
            posed.positions[v] += weight * glm::dvec3(target.positions[v]);
        if (normals.empty() || target.normals.empty()) continue;
        moves_normals = true;
        for (std::size_t v = 0; v < normals.size(); ++v) normals[v] += weight * glm::dvec3(target.normals[v]);
    }
    posed.normals = mesh.normals;
    if (!moves_normals) return;
    for (std::size_t v = 0; v < normals.size(); ++v) posed.normals[v] = glm::vec3(safe_normalize(normals[v]));
}

/// glTF 2.0, 3.7.3.3: the node's own transform is to be ignored, so its inverse is applied. A node without volume has
/// no inverse: its mesh stays as it is, and no ray can hit it. A node or joints that mirror turn triangles inside out.
void apply_skin(const Scene& scene, const Mesh& mesh, int node, std::span<const glm::dmat4> world, PosedMesh& posed) {
    const glm::dmat4& placed = world[node];
    posed.mirrored = false;
    if (!has_full_rank(placed)) return;
    const glm::dmat4 undo = glm::inverse(placed);
    const Skin& skin = scene.skins[mesh.deformation.skin];
    std::vector<glm::dmat4> joints;
    joints.reserve(skin.joints.size());
    for (std::size_t j = 0; j < skin.joints.size(); ++j)
        joints.push_back(undo * world[skin.joints[j]] * skin.inverse_binds[j]);

    const auto per_vertex = static_cast<std::size_t>(mesh.deformation.joints_per_vertex);
    double upright = 0.0;  // vertices, less those that are mirrored
    for (std::size_t v = 0; v < posed.positions.size(); ++v) {
        glm::dmat4 blend(0.0);
        double sum = 0.0;
        for (std::size_t k = 0; k < per_vertex; ++k) {
            const JointWeight& influence = mesh.deformation.joint_weights[v * per_vertex + k];
            if (influence.weight == 0.0f) continue;
            blend += joints[influence.joint] * static_cast<double>(influence.weight);
            sum += static_cast<double>(influence.weight);
        }
        if (!(sum > 0.0)) continue;
        posed.positions[v] = glm::dvec3(blend * glm::dvec4(posed.positions[v], 1.0)) / sum;
        upright += orientation_sign(blend);
        if (posed.normals.empty()) continue;
        const glm::dvec3 normal = safe_normalize(normal_matrix(blend) * glm::dvec3(posed.normals[v]));
        if (normal != glm::dvec3(0.0)) posed.normals[v] = glm::vec3(normal);
    }
    posed.mirrored = upright < 0.0;
    if (!posed.mirrored) return;
    for (glm::vec3& normal : posed.normals) normal = -normal;
}

/// Control points of the last cage: its meshes usually follow each other.
struct LastCage {
    int cage = no_index;
    const LimitSurface* surface = nullptr;
    std::vector<glm::dvec3> control;
};

void deform_cage(const Scene& scene, const Mesh& mesh, double seconds, LastCage& last, PosedMesh& posed) {
    const LimitSurface& surface = *mesh.subdivision.limit.surface;
    if (last.cage != mesh.subdivision.cage || last.surface != &surface) {
        last.cage = mesh.subdivision.cage;
        last.surface = &surface;
        last.control = surface.make_control_points(
            sample_points(scene.point_caches[scene.cages[mesh.subdivision.cage].points], seconds));
    }
    posed.control = last.control;
    surface.evaluate_vertices(mesh.subdivision.part, posed.control, posed.positions, posed.normals);
}

}  // namespace

std::vector<Deformer> find_deformers(const Scene& scene, std::span<const std::uint8_t> moving_nodes) {
    std::vector<int> node_of(scene.meshes.size(), no_index);
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
        for (const int mesh : scene.nodes[n].meshes) node_of[mesh] = static_cast<int>(n);

    std::vector<Deformer> deformers;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        if (node_of[m] == no_index) continue;
        Deformer deformer{static_cast<int>(m), node_of[m], false, {}};
        if (is_skinned(mesh)) {
            const auto moves = [&](int node) { return moving_nodes[node] != 0; };
            deformer.changes = moves(deformer.node) ||
                               std::ranges::any_of(scene.skins[mesh.deformation.skin].joints, moves) ||
                               are_weights_animated(mesh.deformation);
        } else if (mesh.deformation.points != no_index &&
                   (is_animated(cache_of(scene, mesh)) || do_samples_differ(mesh.deformation.normal_samples))) {
            deformer.changes = true;
            if (mesh.deformation.normal_samples.empty() && !mesh.normals.empty())
                deformer.normal_groups = group_normals(cache_of(scene, mesh), mesh);
        } else if (are_weights_on(mesh.deformation)) {
            deformer.changes = are_weights_animated(mesh.deformation);
        } else if (is_cage_animated(scene, mesh)) {
            deformer.changes = true;
        } else {
            continue;
        }
        deformers.push_back(std::move(deformer));
    }
    return deformers;
}

void deform(const Scene& scene, std::span<const Deformer> deformers, std::span<const std::uint8_t> shown, bool all,
            ScenePose& posed) {
    const double seconds = posed.seconds;
    LastCage last;
    for (std::size_t d = 0; d < deformers.size(); ++d) {
        const Deformer& deformer = deformers[d];
        const auto m = static_cast<std::size_t>(deformer.mesh);
        const Mesh& mesh = scene.meshes[m];
        PosedMesh& target = posed.meshes[m];
        if (shown[d] == 0) {
            target = {};
        } else if (!all && !deformer.changes && !target.positions.empty()) {
            continue;
        } else if (mesh.subdivision.cage != no_index && mesh.subdivision.limit.surface != nullptr) {
            deform_cage(scene, mesh, seconds, last, target);
        } else if (mesh.deformation.points != no_index) {
            deform_points(scene, deformer, seconds, target);
        } else {
            morph(mesh, seconds, target);
            if (is_skinned(mesh)) apply_skin(scene, mesh, deformer.node, posed.world, target);
        }
    }
}

}  // namespace aleph
