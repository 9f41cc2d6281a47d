#include "scenes/studies/radius_rules.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace aleph {

double triangle_irradiance(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& from) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 a = corners[i] - from, b = corners[(i + 1) % 3] - from;
        const glm::dvec3 across = glm::cross(a, b);
        const double length = glm::length(across);
        if (!(length > 0.0)) continue;
        sum += std::atan2(length, glm::dot(a, b)) * across.z / length;
    }
    return 0.5 * sum;
}

double mesh_irradiance(const HemisphereMesh& mesh, const glm::dvec3& from) {
    double sum = 0.0;
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        std::size_t farthest = a;
        for (const std::size_t i : {b, c}) {
            if (glm::dot(mesh.points[i], mesh.points[i]) > glm::dot(mesh.points[farthest], mesh.points[farthest])) {
                farthest = i;
            }
        }
        sum += mesh.radiance[farthest] * triangle_irradiance({mesh.points[a], mesh.points[b], mesh.points[c]}, from);
    };
    for (int column = 2; column < mesh.columns; ++column) {  // around the normal
        add(mesh.index(0, 0), mesh.index(0, column - 1), mesh.index(0, column));
    }
    for (int row = 1; row < mesh.rows; ++row) {
        for (int column = 0; column < mesh.columns; ++column) {
            const std::size_t inner = mesh.index(row - 1, column), outer = mesh.index(row, column);
            const std::size_t inner_next = mesh.index(row - 1, column + 1), outer_next = mesh.index(row, column + 1);
            add(inner, outer, outer_next);
            add(inner, outer_next, inner_next);
        }
    }
    return sum;
}

glm::dmat2 mesh_hessian(const HemisphereMesh& mesh, double step) {
    const auto at = [&](double x, double y) { return mesh_irradiance(mesh, step * glm::dvec3(x, y, 0.0)); };
    const double here = at(0, 0), right = at(1, 0), left = at(-1, 0), up = at(0, 1), down = at(0, -1);
    const double mixed = 0.25 * (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1));
    const double xx = right - 2.0 * here + left, yy = up - 2.0 * here + down;
    return glm::dmat2(xx, mixed, mixed, yy) / (step * step);
}

double hessian_radius(const glm::dmat2& hessian, double allowed) {
    const double middle = 0.5 * (hessian[0][0] + hessian[1][1]);
    const double spread = std::hypot(0.5 * (hessian[0][0] - hessian[1][1]), hessian[0][1]);
    const double sum = std::abs(middle + spread) + std::abs(middle - spread);
    if (!(sum > 0.0)) return std::numeric_limits<double>::infinity();
    return std::pow(4.0 * allowed / (std::numbers::pi * sum), 0.25);
}

}  // namespace aleph
