#pragma once
// Points of limit surfaces, for the tests of subdivision.

#include <vector>

#include "engine/surface/limit_surface.h"

namespace aleph {

struct Vertices {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
};

inline Vertices vertices_of(const LimitSurface& surface, const std::vector<glm::dvec3>& points, int part = 0) {
    Vertices vertices;
    surface.evaluate_vertices(part, surface.make_control_points(points), vertices.positions, vertices.normals);
    return vertices;
}

/// The limit point at (s, t) of drawn face f of a cage of quads, through a surface of level 0.
inline glm::dvec3 limit_at(const LimitSurface& surface, const std::vector<glm::dvec3>& control, int f, double s,
                           double t) {
    return s >= t ? surface.evaluate(0, control, 2 * f, s - t, t) : surface.evaluate(0, control, 2 * f + 1, s, t - s);
}

}  // namespace aleph
