#include "render/surface/convex_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>
#include <vector>

#include "engine/base/bounds.h"

namespace aleph {

namespace {

constexpr std::size_t most_triangles = 200000;
constexpr double tolerance = 1e-6;  // of the mesh's size

/// For each vertex, the first of those at its place.
std::vector<std::uint32_t> join_vertices(const std::vector<glm::vec3>& positions) {
    std::vector<std::uint32_t> order(positions.size()), joined(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) {
        const glm::vec3& p = positions[i];
        return std::tuple(p.x, p.y, p.z, i);
    };
    std::ranges::sort(order, {}, key);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
        joined[order[i]] = same ? joined[order[i - 1]] : order[i];
    }
    return joined;
}

/// One side of a triangle, in its winding.
struct HalfEdge {
    std::uint32_t low, high;  ///< ends
    bool forward;             ///< from low to high
    std::uint32_t opposite;   ///< the triangle's third corner
    std::uint32_t triangle;
};

std::vector<HalfEdge> list_edges(const Mesh& mesh, const std::vector<std::uint32_t>& joined) {
    std::vector<HalfEdge> edges;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3& t = mesh.triangles[i];
        const std::uint32_t v[3] = {joined[t.x], joined[t.y], joined[t.z]};
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;  // at a pole
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = v[k], b = v[(k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), a < b, v[(k + 2) % 3], i});
        }
    }
    std::ranges::sort(edges, {}, [](const HalfEdge& e) { return std::tuple(e.low, e.high, e.forward, e.triangle); });
    return edges;
}

glm::dvec3 unit_normal(const Mesh& mesh, const glm::uvec3& t) {
    const glm::dvec3 a(mesh.positions[t.x]);
    const glm::dvec3 normal = glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a);
    const double length = glm::length(normal);
    return length > 0.0 ? normal / length : glm::dvec3(0.0);
}

/// Closed, in one piece, wound alike, and bent to one side along every edge: such a surface is convex (van Heijenoort
/// 1952, "On locally convex manifolds").
bool is_locally_convex(const Mesh& mesh, double slack) {
    const std::vector<std::uint32_t> joined = join_vertices(mesh.positions);
    const std::vector<HalfEdge> edges = list_edges(mesh, joined);
    if (edges.empty() || edges.size() % 2 != 0) return false;
    std::vector<std::uint32_t> parents(mesh.triangles.size());  // of sets of triangles that are joined by edges
    std::iota(parents.begin(), parents.end(), 0u);
    const auto find_set = [&](std::uint32_t i) {
        while (parents[i] != i) i = parents[i] = parents[parents[i]];
        return i;
    };
    bool inwards = false, outwards = false;
    for (std::size_t i = 0; i < edges.size(); i += 2) {
        const HalfEdge &one = edges[i], &two = edges[i + 1];
        const bool pair = one.low == two.low && one.high == two.high && one.forward != two.forward;
        const bool third = i + 2 < edges.size() && edges[i + 2].low == one.low && edges[i + 2].high == one.high;
        if (!pair || third) return false;
        const glm::dvec3 from(mesh.positions[one.low]);
        const glm::dvec3 normal = unit_normal(mesh, mesh.triangles[one.triangle]);
        const double side = glm::dot(normal, glm::dvec3(mesh.positions[two.opposite]) - from);
        inwards = inwards || side > slack;
        outwards = outwards || side < -slack;
        if (inwards && outwards) return false;
        parents[find_set(one.triangle)] = find_set(two.triangle);
    }
    const std::uint32_t piece = find_set(edges.front().triangle);
    return std::ranges::all_of(edges, [&](const HalfEdge& e) { return find_set(e.triangle) == piece; });
}

}  // namespace

ConvexMesh find_convex(const Mesh& mesh) {
    ConvexMesh shape;
    if (mesh.triangles.empty() || mesh.triangles.size() > most_triangles) return shape;
    Bounds box;
    for (const glm::vec3& p : mesh.positions) box.add(p);
    const double slack = tolerance * glm::length(box.high - box.low);
    for (const glm::uvec3& t : mesh.triangles) {
        shape.point = glm::dvec3(mesh.positions[t.x]);
        shape.normal = unit_normal(mesh, t);
        if (shape.normal != glm::dvec3(0.0)) break;
    }
    shape.flat = shape.normal != glm::dvec3(0.0) && std::ranges::all_of(mesh.positions, [&](const glm::vec3& p) {
                     return std::abs(glm::dot(shape.normal, glm::dvec3(p) - shape.point)) <= slack;
                 });
    shape.convex = shape.flat || is_locally_convex(mesh, slack);
    return shape;
}

}  // namespace aleph
