#include "engine/surface/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/base/errors.h"
#include "engine/surface/revolved.h"

namespace aleph {

namespace {

constexpr double largest_size = 1e18;
// Squares of smaller sizes leave the range of float.
constexpr double smallest_size = 1e-18;

void check_size(double value, const char* name, const std::string& file, const std::string& place) {
    if (!(value >= smallest_size && value <= largest_size)) {
        throw InputError(
            file, place,
            fmt::format("{} has to lie within {} and {}, found {}", name, smallest_size, largest_size, value));
    }
}

void check_profile(const Shape& shape, const std::string& file, const std::string& place) {
    double widest = 0.0, longest = 0.0;
    for (std::size_t i = 0; i < shape.profile.size(); ++i) {
        const glm::dvec2 point = shape.profile[i];
        if (!(point.x >= 0.0 && point.x <= largest_size && std::abs(point.y) <= largest_size)) {
            throw InputError(file, place,
                             fmt::format("point {} of the profile, [{}, {}], has to be a distance from the axis of at "
                                         "least 0 and a y, both within {}",
                                         i, point.x, point.y, largest_size));
        }
        widest = std::max(widest, point.x);
        longest = std::max(longest, glm::distance(shape.profile.front(), point));
    }
    if (!(longest >= smallest_size)) {
        throw InputError(file, place, "the profile of a lathe needs at least two different points [radius, y]");
    }
    if (!(widest >= smallest_size)) throw InputError(file, place, "the profile lies on the axis: nothing to turn");
}

void add_vertex(Mesh& mesh, const Shape& shape, const glm::dvec3& position, const glm::dvec3& normal,
                const glm::dvec2& uv) {
    mesh.positions.emplace_back(position);
    mesh.normals.emplace_back(normal);
    mesh.uv[0].emplace_back(uv * shape.uv_scale);
}

std::uint32_t vertex_count(const Mesh& mesh) {
    return static_cast<std::uint32_t>(mesh.positions.size());
}

/// A rectangle seen from the side it faces: `right` and `up` are half its edges.
void add_rectangle(Mesh& mesh, const Shape& shape, const glm::dvec3& center, const glm::dvec3& right,
                   const glm::dvec3& up, const glm::dvec3& normal) {
    const std::uint32_t first = vertex_count(mesh);
    add_vertex(mesh, shape, center - right + up, normal, {0.0, 0.0});
    add_vertex(mesh, shape, center - right - up, normal, {0.0, 1.0});
    add_vertex(mesh, shape, center + right - up, normal, {1.0, 1.0});
    add_vertex(mesh, shape, center + right + up, normal, {1.0, 0.0});
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
}

void add_box(Mesh& mesh, const Shape& shape) {
    const glm::dvec3 half = shape.size * 0.5;
    const glm::dvec3 x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0);
    struct Face {
        glm::dvec3 normal, right, up;
    };
    for (const Face& face :
         {Face{x, -z, y}, Face{-x, z, y}, Face{y, x, -z}, Face{-y, x, z}, Face{z, x, y}, Face{-z, -x, y}}) {
        add_rectangle(mesh, shape, face.normal * half, face.right * half, face.up * half, face.normal);
    }
}

/// @param side  +1: the upper cap, -1: the lower
void add_cap(Mesh& mesh, const Shape& shape, double side) {
    const glm::dvec3 normal(0.0, side, 0.0), center = normal * (0.5 * shape.height);
    const auto columns = static_cast<std::uint32_t>(shape.segments);
    const std::uint32_t first = vertex_count(mesh);
    add_vertex(mesh, shape, center, normal, {0.5, 0.5});
    for (int i = 0; i < shape.segments; ++i) {
        const glm::dvec3 rim = around(i, shape.segments);
        add_vertex(mesh, shape, center + rim * shape.radius, normal, {0.5 + 0.5 * rim.x, 0.5 + 0.5 * side * rim.z});
    }
    for (std::uint32_t i = 0; i < columns; ++i) {
        const std::uint32_t here = first + 1 + i, next = first + 1 + (i + 1) % columns;
        mesh.triangles.emplace_back(first, side > 0.0 ? here : next, side > 0.0 ? next : here);
    }
}

}  // namespace

Mesh make_shape_mesh(const Shape& shape, int material, const std::string& name) {
    validate(shape, {}, name);
    Mesh mesh;
    mesh.name = name;
    mesh.material = material;
    mesh.shape = shape;
    switch (shape.kind) {
        case Shape::Kind::quad:
            add_rectangle(mesh, shape, glm::dvec3(0.0), {0.5 * shape.size.x, 0.0, 0.0}, {0.0, 0.5 * shape.size.y, 0.0},
                          {0.0, 0.0, 1.0});
            break;
        case Shape::Kind::box:
            add_box(mesh, shape);
            break;
        case Shape::Kind::cylinder:
            add_revolved(mesh, shape, make_outline(shape));
            add_cap(mesh, shape, 1.0);
            add_cap(mesh, shape, -1.0);
            break;
        case Shape::Kind::sphere:
        case Shape::Kind::torus:
        case Shape::Kind::lathe:
            add_revolved(mesh, shape, make_outline(shape));
            break;
    }
    return mesh;
}

std::size_t shape_triangle_count(const Shape& shape) {
    const auto segments = static_cast<std::size_t>(shape.segments);
    switch (shape.kind) {
        case Shape::Kind::quad:
            return 2;
        case Shape::Kind::box:
            return 12;
        case Shape::Kind::cylinder:
            return 4 * segments;
        case Shape::Kind::sphere:
        case Shape::Kind::torus:
            return count_revolved_triangles(make_outline(shape), shape.segments);
        case Shape::Kind::lathe: {
            const std::size_t most = 2 * segments * count_outline_pieces(shape);
            return most > max_shape_triangles ? most : count_revolved_triangles(make_outline(shape), shape.segments);
        }
    }
    return 0;
}

void validate(const Shape& shape, const std::string& file, const std::string& place) {
    const auto check = [&](double value, const char* name) { check_size(value, name, file, place); };
    switch (shape.kind) {
        case Shape::Kind::quad:
        case Shape::Kind::box:
            check(shape.size.x, "size x");
            check(shape.size.y, "size y");
            if (shape.kind == Shape::Kind::box) check(shape.size.z, "size z");
            break;
        case Shape::Kind::sphere:
            check(shape.radius, "radius");
            break;
        case Shape::Kind::cylinder:
            check(shape.radius, "radius");
            check(shape.height, "height");
            break;
        case Shape::Kind::torus:
            check(shape.radius, "radius");
            check(shape.tube_radius, "tube_radius");
            if (!(shape.tube_radius < shape.radius)) {
                throw InputError(file, place,
                                 fmt::format("tube_radius ({}) has to be smaller than radius ({}), that of the circle "
                                             "which the tube follows",
                                             shape.tube_radius, shape.radius));
            }
            break;
        case Shape::Kind::lathe:
            check_profile(shape, file, place);
            break;
    }
    const bool turned = shape.kind != Shape::Kind::quad && shape.kind != Shape::Kind::box;
    if (turned && (shape.segments < min_shape_segments || shape.segments > max_shape_segments)) {
        throw InputError(file, place,
                         fmt::format("segments have to lie within {} and {}, found {}", min_shape_segments,
                                     max_shape_segments, shape.segments));
    }
    for (const double scale : {shape.uv_scale.x, shape.uv_scale.y}) {
        if (!(std::abs(scale) <= largest_size)) {
            throw InputError(file, place,
                             fmt::format("uv_scale has to lie within +-{}, found {}", largest_size, scale));
        }
    }
}

}  // namespace aleph
