#pragma once
// Parts of the environment's picture, for rays that are aimed at the brightest.

#include <algorithm>
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "render/surface/environment_map.h"

namespace aleph {

/// Columns and rows of cells, the last ones included. Columns may lie beyond the seam.
struct CellRange {
    glm::ivec2 first{0}, last{-1};
};

/// A cell lies between the centres of four texels, where look-ups interpolate them. A part has `step` cells along each
/// axis, fewer at the last column and row. Every direction is in one part.
class EnvironmentCells {
  public:
    /// @param step  at least 1
    EnvironmentCells(const EnvironmentMap& map, int step)
        : map_(&map), step_(step), columns_((map.texels.width + step - 1) / step) {}

    int step() const { return step_; }
    int count() const { return columns_ * (map_->texels.height / step_ + 1); }

    /// The part of a direction, unit, in the picture's frame.
    int find(const glm::vec3& direction) const {
        const BetweenTexels at = place_between_texels(*map_, direction);
        return (at.row + 1) / step_ * columns_ + at.column / step_;
    }

    /// Luminance of the texels that look-ups in a part read.
    LuminanceRange find_range(int part) const;

    /// Directions, not unit, to the corners of a quadrilateral of great circles that surrounds a part. Parts of less
    /// than a quarter of the columns have one, and it is hardly larger than they are.
    std::array<glm::dvec3, 4> surround(int part) const;

    /// Cells that a cone meets, and perhaps some around.
    /// @param axis   unit, in the picture's frame
    /// @param angle  radians, from the axis to its side
    CellRange find_in_cone(const glm::dvec3& axis, double angle) const;

    /// Calls visit(part) once for each part that has one of the cells.
    template <class Visit>
    void visit_parts(const CellRange& cells, const Visit& visit) const {
        const int width = map_->texels.width;
        for (int row = cells.first.y / step_; row <= cells.last.y / step_; ++row) {
            for (int x = cells.first.x; x <= cells.last.x;) {
                const int cell = (x % width + width) % width, column = cell / step_;
                visit(row * columns_ + column);
                x += std::min((column + 1) * step_, width) - cell;
            }
        }
    }

  private:
    CellRange cells_of(int part) const;

    const EnvironmentMap* map_;
    int step_, columns_;
};

}  // namespace aleph
