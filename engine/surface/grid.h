#pragma once
// Triangles over a cage's faces at a level: which faces share which vertices, and where every vertex and triangle lies
// on the limit surface. Internal to limit_surface.cpp and its parts.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/surface/patches.h"
#include "engine/surface/topology.h"

namespace aleph {

/// A vertex of the triangles. Faces that meet at it name the same location for its position, so that there are no
/// cracks; they have vertices of their own where the surface is infinitely sharp, and at seams of the texture.
struct GridVertex {
    LimitLocation position, normal, uv;
};

/// Half of a cell of a face's grid (Loop face: every second triangle is upside down).
struct GridTriangle {
    int face = 0;                ///< of the parametrisation, as in LimitLocation
    std::uint16_t i = 0, j = 0;  ///< cell
    std::uint8_t half = 0;
};

/// The triangles of one part.
struct PartGrid {
    std::vector<GridVertex> vertices;
    std::vector<GridTriangle> triangles;
    std::vector<glm::uvec3> corners;  ///< as triangles, into vertices
};

/// The grid cells of a face of the parametrisation.
struct FaceGrid {
    std::vector<std::uint16_t> cells;  ///< along an edge, by face
    bool triangular = false;

    /// A triangle's corners in cells.
    void find_corners(const GridTriangle& triangle, glm::ivec2 (&corners)[3]) const;
};

struct SurfaceGrid {
    int level = 0;  ///< at least 1 where some face is no quad (triangle for Loop)
    FaceGrid faces;
    std::vector<PartGrid> parts;
};

/// The grid of every face that is drawn (no hole), in the cage's order; every edge of the cage has 2^level segments.
/// @throws InputError where the triangles would be too many
SurfaceGrid make_surface_grid(const Cage& cage, const Far::TopologyRefiner& refiner, int level);

}  // namespace aleph
