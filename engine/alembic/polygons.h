#pragma once
// Polygons to triangles.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace aleph {

/// Twice the area times the normal, counter-clockwise seen from its tip (Newell's method).
glm::dvec3 polygon_normal(std::span<const glm::vec3> points);

/// Triangles of a polygon as positions in its list of points, in its own orientation. A convex one is a fan about its
/// first point; a concave one is cut along ears in the plane of its normal, so that no triangle covers what the polygon
/// does not. There are points - 2 of them for every polygon of 3 points and more.
/// @param effort  point-in-triangle tests that may still be made; counted down. At 0 the polygon becomes a fan
/// @return false where it ran out of effort or found no ear (the outline crosses itself) and made a fan
bool triangulate_polygon(std::span<const glm::vec3> points, std::uint64_t& effort,
                         std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace aleph
