#pragma once
// Sampling a triangle by solid angle. For a light nearby this has much less noise than sampling by area (Arvo 1995,
// "Stratified Sampling of Spherical Triangles").

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace aleph {

/// Solid angle of a triangle with corners at these offsets from the eye, sr (Van Oosterom and Strackee 1983). Accurate
/// for small triangles; 0 if the triangle is seen edge-on or a corner lies at the eye.
float solid_angle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// A unit direction into the triangle of this solid angle, uniform in solid angle; u in [0,1)^2. It must be at least
/// about 1e-3 sr: for smaller ones, float angles are too coarse.
glm::vec3 sample_spherical_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, float solid_angle,
                                    const glm::vec2& u);

}  // namespace aleph
