#pragma once
// Cages that the tests of subdivision share.

#include <cmath>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/surface/cage_checks.h"
#include "tests/support/all_pixels.h"
#include "tests/support/subdivision_reference.h"

namespace aleph {

struct TestCage {
    Cage cage;
    std::vector<glm::dvec3> points;
};

inline void add_face(Cage& cage, const std::vector<int>& points) {
    cage.faces.sizes.push_back(static_cast<int>(points.size()));
    cage.faces.points.insert(cage.faces.points.end(), points.begin(), points.end());
}

inline TestCage make_cage(const std::vector<glm::dvec3>& points, const std::vector<std::vector<int>>& faces,
                          Cage::Scheme scheme = Cage::Scheme::catmull_clark) {
    TestCage result;
    result.cage.name = "test";
    result.cage.scheme = scheme;
    result.points = points;
    for (const auto& face : faces) add_face(result.cage, face);
    return result;
}

inline void add_crease(Cage& cage, const std::vector<int>& chain, float sharpness) {
    cage.creases.lengths.push_back(static_cast<int>(chain.size()));
    cage.creases.points.insert(cage.creases.points.end(), chain.begin(), chain.end());
    cage.creases.sharpness.push_back(sharpness);
}

inline void add_corner(Cage& cage, int point, float sharpness) {
    cage.corners.points.push_back(point);
    cage.corners.sharpness.push_back(sharpness);
}

/// Edge 2, about the origin. Points by bits: x 1, y 2, z 4. Faces -x, +x, -y, +y, -z, +z.
inline TestCage make_cube_cage() {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 8; ++i) {
        points.emplace_back(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0);
    }
    return make_cage(points, {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
}

/// columns x rows points at (x, y, height(x, y)); quads seen counter-clockwise from +z.
inline TestCage make_grid_cage(int columns, int rows) {
    std::vector<glm::dvec3> points;
    for (const auto [x, y] : all_pixels(columns, rows)) {
        points.emplace_back(x + 0.1 * std::sin(1.7 * y), y + 0.2 * std::cos(2.3 * x),
                            0.4 * std::sin(1.3 * x + 0.7 * y * y));
    }
    std::vector<std::vector<int>> faces;
    for (int y = 0; y + 1 < rows; ++y) {
        for (int x = 0; x + 1 < columns; ++x) {
            const int p = y * columns + x;
            faces.push_back({p, p + 1, p + 1 + columns, p + columns});
        }
    }
    return make_cage(points, faces);
}

/// A tube of 2 x 5 triangles with caps of 5: the icosahedron, points of 5 neighbours.
inline TestCage make_icosahedron_cage(Cage::Scheme scheme) {
    const double g = (1.0 + std::sqrt(5.0)) / 2.0;
    return make_cage({{-1, g, 0},
                      {1, g, 0},
                      {-1, -g, 0},
                      {1, -g, 0},
                      {0, -1, g},
                      {0, 1, g},
                      {0, -1, -g},
                      {0, 1, -g},
                      {g, 0, -1},
                      {g, 0, 1},
                      {-g, 0, -1},
                      {-g, 0, 1}},
                     {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}},
                     scheme);
}

/// Prism over a pentagon: n-gons among quads.
inline TestCage make_prism_cage() {
    std::vector<glm::dvec3> points;
    for (int z = 0; z < 2; ++z) {
        for (int i = 0; i < 5; ++i) {
            const double a = 2.0 * std::numbers::pi * i / 5.0;
            points.emplace_back(std::cos(a), 0.8 * std::sin(a), 1.5 * z);
        }
    }
    std::vector<std::vector<int>> faces = {{4, 3, 2, 1, 0}, {5, 6, 7, 8, 9}};
    for (int i = 0; i < 5; ++i) faces.push_back({i, (i + 1) % 5, 5 + (i + 1) % 5, 5 + i});
    return make_cage(points, faces);
}

inline ReferenceMesh make_reference(const TestCage& from) {
    ReferenceMesh mesh;
    mesh.points = from.points;
    std::size_t begin = 0;
    for (const int size : from.cage.faces.sizes) {
        const auto first = from.cage.faces.points.begin() + static_cast<std::ptrdiff_t>(begin);
        mesh.faces.emplace_back(first, first + size);
        begin += static_cast<std::size_t>(size);
    }
    for_each_crease_edge(from.cage, [&](int a, int b, float sharpness) {
        mesh.creases[ReferenceMesh::edge(a, b)] = static_cast<double>(sharpness);
    });
    for (std::size_t c = 0; c < from.cage.corners.points.size(); ++c) {
        mesh.corners[from.cage.corners.points[c]] = static_cast<double>(from.cage.corners.sharpness[c]);
    }
    if (from.cage.boundary == Cage::Boundary::edge_and_corner) {
        const auto points = reference_points(mesh);
        for (std::size_t p = 0; p < points.size(); ++p) {
            if (points[p].faces.size() == 1) mesh.corners[static_cast<int>(p)] = reference_infinite;
        }
    }
    return mesh;
}

/// Weights of a uniform cubic B-spline.
inline std::array<double, 4> bspline(double t) {
    const double r = 1.0 - t;
    return {r * r * r / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
            (-3.0 * t * t * t + 3.0 * t * t + 3.0 * t + 1.0) / 6.0, t * t * t / 6.0};
}

/// Tensor product over 4 x 4 points.
inline glm::dvec3 tensor(const std::vector<glm::dvec3>& points, const std::array<double, 4>& wx,
                         const std::array<double, 4>& wy) {
    glm::dvec3 sum(0.0);
    for (std::size_t y = 0; y < 4; ++y) {
        for (std::size_t x = 0; x < 4; ++x) sum += wx[x] * wy[y] * points[y * 4 + x];
    }
    return sum;
}

}  // namespace aleph
