#pragma once
// Triangles and parts of the sky as the picture shows them.

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "engine/pose/camera_view.h"

namespace aleph {

/// A convex polygon of the picture, pixels. A triangle has a corner more where the camera's plane cuts it, and up to
/// four more within a rectangle. An outline keeps its eight: four of its sides are along the rectangle's.
struct PicturePolygon {
    std::array<glm::dvec2, 8> corners;
    int count = 0;

    /// Corners beyond eight, which rounding can make, are left out.
    void add(const glm::dvec2& corner) {
        if (count < static_cast<int>(corners.size())) corners[count++] = corner;
    }
};

/// A triangle (world, m) as far as it lies before the camera, where rays start: its near plane hides nothing. Without
/// corners if it lies behind.
PicturePolygon project_triangle(const CameraView& view, const std::array<glm::dvec3, 3>& corners);

/// A convex quadrilateral infinitely far away, as a perspective view shows it. Without corners where one lies behind
/// the camera.
/// @param directions  to its corners, world
PicturePolygon project_directions(const CameraView& view, const std::array<glm::dvec3, 4>& directions);

/// The least octagon around polygons whose sides lie along x, y and the diagonals.
class PictureOutline {
  public:
    void add(const PicturePolygon& polygon);
    /// Without corners if nothing was added.
    PicturePolygon polygon() const;

  private:
    static constexpr double none = -std::numeric_limits<double>::infinity();
    std::array<double, 8> reach_{none, none, none, none, none, none, none, none};  ///< along each side's normal
};

/// The part of a polygon of up to four corners, or of an outline, within a rectangle (Sutherland and Hodgman 1974).
PicturePolygon clip_to_rectangle(const PicturePolygon& polygon, const glm::dvec2& low, const glm::dvec2& high);

/// Square pixels.
double area_of(const PicturePolygon& polygon);

/// A place that is uniform in the polygon. u in [0,1)^2.
glm::dvec2 sample_polygon(const PicturePolygon& polygon, const glm::dvec2& u);

}  // namespace aleph
