#pragma once
// Control meshes of subdivision surfaces for furniture, mouldings and sculptures. Metres.

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scenes/common/build.h"

namespace aleph {

/// A cage and its points.
struct CageShape {
    Cage cage;
    std::vector<glm::dvec3> points;
};

/// Adds cage and points to the scene, and a mesh of its limit surface, which is returned. Points are rounded to a tenth
/// of a millimetre, texture coordinates to a thousandth.
int add_cage(Scene& scene, const std::string& name, const CageShape& shape, int material);

/// Adds a cage, and a node of its name that shows it.
/// @return the node
int add_cage_node(const Group& group, const std::string& name, const CageShape& shape, int material,
                  const glm::dvec3& translation = glm::dvec3(0.0), const glm::dquat& rotation = no_turn);

/// A profile swept along a path in the plane z = 0, with mitred corners: picture frames, skirtings, cornices.
/// Profile: x is the distance from the path to its left, y is along z; a repeated point is a sharp edge. List the
/// profile, seen along the path, up on the right side, across the top to the left, and down on the left: then the
/// outside is outside. Texture: u along the path, v along the profile, in metres.
CageShape make_moulding(const std::vector<glm::dvec2>& path, bool closed, const std::vector<glm::dvec2>& profile);

/// A closed moulding around a centred rectangle.
/// @param outwards  the profile extends away from the rectangle, as in a picture frame; else into it
CageShape make_rectangle_moulding(const glm::dvec2& size, const std::vector<glm::dvec2>& profile, bool outwards);

/// A box with rounded edges and convex faces, like a cushion. Centred. Texture: metres on each face.
/// @param rounding  approximate radius of the edges, m
/// @param swell  height of the middle of the faces above their edges, along x, y and z, m
CageShape make_cushion(const glm::dvec3& size, double rounding, const glm::dvec3& swell, int level = 1);

/// A closed band along a curve, with elliptical sections.
/// @param curve  point at a parameter in [0, 1]; closed
/// @param half_turns  twist of the section over the whole length, in half turns
CageShape make_closed_tube(const std::function<glm::dvec3(double)>& curve, int steps, int sides,
                           const glm::dvec2& radii, int half_turns);

/// A leaf along +y, face up (+z), its tip bending down by `droop`.
CageShape make_leaf(double length, double width, double droop);

}  // namespace aleph
