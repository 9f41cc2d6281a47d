#pragma once
// Control meshes of subdivision surfaces that furniture, mouldings and sculptures are made of. Metres.

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// A cage with its points at rest.
struct CageShape {
    Cage cage;
    std::vector<glm::dvec3> points;
};

/// Adds cage and points to the scene, and a mesh of its limit surface. Points are rounded to a tenth of a millimetre,
/// texture coordinates to a thousandth.
/// @return the mesh
int add_cage(Scene& scene, const std::string& name, const CageShape& shape, int material);

/// A node that shows a mesh; several nodes may show the same.
int add_mesh_node(Scene& scene, const std::string& name, int parent, int mesh, const glm::dvec3& translation,
                  const glm::dquat& rotation = glm::dquat(1.0, 0.0, 0.0, 0.0));

/// A profile swept along a path in the plane z = 0, with mitred corners: picture frames, skirtings, cornices.
/// Profile: x away from the path to its left, y along z; a repeated point is a sharp edge. Seen along the path, the
/// outside lies to the right of the profile's own direction turned from left to up: up on the right side, across the
/// top to the left, down on the left. Texture: u along the path, v along the profile, in metres.
CageShape make_moulding(const std::vector<glm::dvec2>& path, bool closed, const std::vector<glm::dvec2>& profile,
                        int level = 2);

/// A box with rounded edges whose faces swell, as cushions do. Centred. Texture: metres over each face.
/// @param rounding  about the radius of the edges
/// @param swell  how far the middles of the faces stand out, along x, y and z
CageShape make_cushion(const glm::dvec3& size, double rounding, const glm::dvec3& swell, int level = 1);

/// A closed band along a curve: sections are ellipses of two radii that turn with it.
/// @param curve  point at a parameter in [0, 1), closed
/// @param half_turns  of the section over the whole length, beyond what the curve itself does; whole
CageShape make_closed_tube(const std::function<glm::dvec3(double)>& curve, int steps, int sides,
                           const glm::dvec2& radii, int half_turns, int level = 2);

/// A leaf along +y, face up (+z), its tip bending down by `droop`.
CageShape make_leaf(double length, double width, double droop);

}  // namespace aleph
