#pragma once
// Shapes that several tests use, and the volume that triangles enclose.

#include <array>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/surface/shapes.h"

namespace aleph {

inline Shape make_shape(Shape::Kind kind, int segments = 48) {
    return {.kind = kind, .size = {1.5, 0.75, 3.0}, .radius = 0.8, .height = 2.5, .segments = segments};
}

inline Shape make_torus(int segments = 48) {
    Shape shape = make_shape(Shape::Kind::torus, segments);
    shape.tube_radius = 0.3;
    return shape;
}

inline Shape make_lathe(const std::vector<glm::dvec2>& profile, bool smooth, int segments = 48) {
    Shape shape = make_shape(Shape::Kind::lathe, segments);
    shape.profile = profile;
    shape.smooth = smooth;
    return shape;
}

inline const std::vector<glm::dvec2> cone = {{0.0, 1.0}, {0.5, 0.0}, {0.0, 0.0}};
inline const std::vector<glm::dvec2> ring = {{0.5, 0.0}, {0.75, 0.25}, {0.5, 0.5}, {0.25, 0.25}, {0.5, 0.0}};
inline const std::vector<glm::dvec2> vase = {{0.0, 0.0}, {0.3, 0.0},  {0.3, 0.0},  {0.5, 0.4}, {0.2, 0.9}, {0.3, 1.0},
                                             {0.3, 1.0}, {0.27, 1.0}, {0.17, 0.9}, {0.4, 0.4}, {0.0, 0.05}};

inline std::vector<Shape> all_lathes() {
    std::vector<Shape> shapes;
    for (const int segments : {3, 5, 48}) {
        for (const bool smooth : {false, true}) {
            for (const auto& profile : {cone, ring, vase}) shapes.push_back(make_lathe(profile, smooth, segments));
        }
    }
    return shapes;
}

inline std::vector<Shape> all_shapes() {
    std::vector<Shape> shapes = {make_shape(Shape::Kind::quad), make_shape(Shape::Kind::box)};
    for (const int segments : {3, 4, 5, 7, 48}) {
        shapes.push_back(make_shape(Shape::Kind::sphere, segments));
        shapes.push_back(make_shape(Shape::Kind::cylinder, segments));
        shapes.push_back(make_torus(segments));
    }
    const std::vector<Shape> lathes = all_lathes();
    shapes.insert(shapes.end(), lathes.begin(), lathes.end());
    return shapes;
}

struct Corners {
    std::array<glm::dvec3, 3> position, normal;
    std::array<glm::dvec2, 3> uv;
};

inline Corners corners(const Mesh& mesh, const glm::uvec3& triangle) {
    Corners out;
    for (int i = 0; i < 3; ++i) {
        out.position[i] = mesh.positions.at(triangle[i]);
        out.normal[i] = mesh.normals.at(triangle[i]);
        out.uv[i] = mesh.uv[0].at(triangle[i]);
    }
    return out;
}

inline glm::dvec3 area_vector(const Corners& c) {
    return 0.5 * glm::cross(c.position[1] - c.position[0], c.position[2] - c.position[0]);
}

inline double volume(const Mesh& mesh) {
    double sum = 0.0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        const Corners c = corners(mesh, triangle);
        sum += glm::dot(c.position[0], glm::cross(c.position[1], c.position[2])) / 6.0;
    }
    return sum;
}

}  // namespace aleph
