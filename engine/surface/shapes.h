#pragma once
// Procedural meshes: triangles, analytic normals and texture coordinates of a Shape.

#include <cstddef>
#include <string>

#include "engine/scene/scene.h"

namespace aleph {

/// Limits of Shape::segments: fewer make no solid, more only take memory.
inline constexpr int min_shape_segments = 3;
inline constexpr int max_shape_segments = 4096;
/// In all shapes of a scene file together.
inline constexpr std::size_t max_shape_triangles = std::size_t{1} << 24;

/// The shape's triangles in object space, counter-clockwise seen from outside, v = 0 at the image's top.
/// A quad faces +z; a box has every face's image upright (on top up is -z, below +z); the middle of a sphere's or
/// cylinder's image faces +z and u grows counter-clockwise seen from above; a cylinder's caps have images of their own.
/// A torus lies about y; its image runs from the inner circle over the top, its middle on the outer circle faces +z.
/// A lathe turns its profile about y. Normals point away from what the profile encloses with the y axis, whichever way
/// it is listed; a flat one faces +y. An end on the axis closes the surface (round if smooth, a tip if that point is
/// repeated), a profile that ends where it began closes into a ring. v grows with the length of the outline, downwards
/// on the outer side. Each triangle at a pole has a pole vertex of its own; the seam has both u = 0 and u = 1.
/// @throws InputError (place `name`) as validate does
Mesh make_shape_mesh(const Shape& shape, int material = no_index, const std::string& name = {});

/// Triangles that make_shape_mesh gives, without making them; a lathe above max_shape_triangles is only estimated.
std::size_t shape_triangle_count(const Shape& shape);

/// @throws InputError unless the sizes that the shape's kind uses are finite, within 1e18, above 0 and not so small
/// that floats lose them; a torus's tube is thinner than its radius; a profile has an extent, nowhere left of the axis;
/// segments are within their limits; uv_scale is finite
void validate(const Shape& shape, const std::string& file, const std::string& place);

}  // namespace aleph
