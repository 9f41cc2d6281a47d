#include "engine/alembic/polygons.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numeric>

namespace aleph {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The points in the plane of the normal, so that the polygon turns counter-clockwise: the coordinate along the
/// normal's largest part is dropped.
std::vector<glm::dvec2> flatten(std::span<const glm::vec3> points, const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    const int drop = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int u = (drop + 1) % 3, v = (drop + 2) % 3;
    const double mirror = normal[drop] < 0.0 ? -1.0 : 1.0;
    std::vector<glm::dvec2> flat;
    flat.reserve(points.size());
    for (const glm::vec3& p : points) flat.emplace_back(mirror * p[u], p[v]);
    return flat;
}

bool is_convex(const std::vector<glm::dvec2>& flat) {
    const std::size_t n = flat.size();
    for (std::size_t i = 0; i < n; ++i)
        if (cross(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) < 0.0) return false;
    return true;
}

void append_fan(std::uint32_t count, Triangles& triangles) {
    for (std::uint32_t i = 1; i + 1 < count; ++i) triangles.push_back({0, i, i + 1});
}

/// Cuts ears until a triangle is left; false where none can be found or the effort is spent.
bool append_ears(const std::vector<glm::dvec2>& flat, std::uint64_t& effort, Triangles& triangles) {
    std::vector<std::uint32_t> left(flat.size());
    std::iota(left.begin(), left.end(), 0u);
    std::size_t start = 0;  // searching goes on where the last ear was: neighbours change, the rest does not
    while (left.size() > 3) {
        const std::size_t n = left.size();
        std::size_t ear = n;
        for (std::size_t k = 0; k < n && ear == n; ++k) {
            const std::size_t i = (start + k) % n;
            const std::uint32_t before = left[(i + n - 1) % n], tip = left[i], after = left[(i + 1) % n];
            const glm::dvec2 &a = flat[before], &b = flat[tip], &c = flat[after];
            if (!(cross(a, b, c) > 0.0)) continue;
            if (effort < n) return false;
            effort -= n;
            const bool clear = std::ranges::none_of(left, [&](std::uint32_t other) {
                const glm::dvec2& p = flat[other];
                if (other == before || other == tip || other == after || p == a || p == b || p == c) return false;
                return cross(a, b, p) >= 0.0 && cross(b, c, p) >= 0.0 && cross(c, a, p) >= 0.0;
            });
            if (clear) ear = i;
        }
        if (ear == n) {  // only flat corners are left of it: any of them may go
            for (std::size_t i = 0; i < n && ear == n; ++i)
                if (cross(flat[left[(i + n - 1) % n]], flat[left[i]], flat[left[(i + 1) % n]]) == 0.0) ear = i;
        }
        if (ear == n) return false;
        triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
        start = ear == 0 ? 0 : ear - 1;
    }
    triangles.push_back({left[0], left[1], left[2]});
    return true;
}

}  // namespace

glm::dvec3 polygon_normal(std::span<const glm::vec3> points) {
    glm::dvec3 normal(0.0);
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
        normal += glm::cross(glm::dvec3(points[i]) - glm::dvec3(points[0]),
                             glm::dvec3(points[i + 1]) - glm::dvec3(points[0]));
    return normal;
}

bool triangulate_polygon(std::span<const glm::vec3> points, std::uint64_t& effort, Triangles& triangles) {
    const auto count = static_cast<std::uint32_t>(points.size());
    if (count == 3) {
        append_fan(count, triangles);
        return true;
    }
    const std::vector<glm::dvec2> flat = flatten(points, polygon_normal(points));
    if (is_convex(flat)) {
        append_fan(count, triangles);
        return true;
    }
    const std::size_t before = triangles.size();
    if (append_ears(flat, effort, triangles)) return true;
    triangles.resize(before);
    append_fan(count, triangles);
    return false;
}

}  // namespace aleph
