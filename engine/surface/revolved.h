#pragma once
// Surfaces of revolution about the y axis: outlines of round shapes, and the triangles between their rows.

#include <cstddef>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// A point of an outline that runs so that the outside lies on its left: down the outer side of a solid.
struct OutlinePoint {
    glm::dvec2 position;  ///< distance from the axis (at least 0) and y, m
    glm::dvec2 normal;    ///< unit, outwards
    double v = 0.0;       ///< share of the outline's length so far
};

/// Smooth along its points; the next one begins at a sharp edge.
using OutlineStrip = std::vector<OutlinePoint>;

/// Outline of a shape that is neither quad nor box, without a cylinder's caps. Call validate (shapes.h) first.
std::vector<OutlineStrip> make_outline(const Shape& shape);

/// Pieces that make_outline cuts a lathe's profile into at most, without making them.
std::size_t count_outline_pieces(const Shape& shape);

/// Triangles between two rows; where one lies on the axis there is one for each segment, where both do there is none.
std::size_t count_revolved_triangles(const std::vector<OutlineStrip>& outline, int segments);

/// Appends the surface to the mesh's positions, normals, uv and triangles.
void add_revolved(Mesh& mesh, const Shape& shape, const std::vector<OutlineStrip>& outline);

/// Unit vector in the plane y = 0 at `column` of `segments`; column 0 and the last give the same bits. The middle is
/// +z; the next column lies counter-clockwise seen from above.
glm::dvec3 around(double column, int segments);

}  // namespace aleph
