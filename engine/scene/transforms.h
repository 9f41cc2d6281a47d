#pragma once
// Vectors, rotations and affine matrices, where GLM's functions are not robust: nothing here divides by a length of
// zero, underflows for tiny scales or overflows for huge ones.

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace aleph {

/// The largest absolute value of an element.
inline double largest_element(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}
inline double largest_element(const glm::dmat3& m) {
    return std::max({largest_element(m[0]), largest_element(m[1]), largest_element(m[2])});
}

/// v at length 1, whatever its length; the zero vector where v is zero or not finite.
glm::dvec3 safe_normalize(const glm::dvec3& v);
inline glm::vec3 safe_normalize(const glm::vec3& v) {
    return glm::vec3(safe_normalize(glm::dvec3(v)));
}

/// q at length 1; unit already (within rounding): the same bits. Identity where q is zero or not finite.
glm::dquat safe_normalize(const glm::dquat& q);

/// The angle between two rotations, the short way, radians: 0 to pi. Quaternions of length 1.
double turn_between(const glm::dquat& a, const glm::dquat& b);

/// -1 where the matrix mirrors, so that a triangle's geometric orientation must be flipped; else 1.
double orientation_sign(const glm::dmat4& world);

/// Takes object-space normals to world-space ones (normalise the result): the cofactor matrix with the sign of the
/// determinant, largest element 1. An outward normal stays outward in a mirror, where cross(edge, edge) must be turned
/// by orientation_sign. Finite for singular matrices too, and zero where their rank is below 2.
glm::dmat3 normal_matrix(const glm::dmat4& world);

/// M = U diag(sigma) V^T. U and V are orthogonal (either may mirror), sigma >= 0 in no particular order. Where a sigma
/// is zero its column of U is zero too.
struct SingularValues {
    glm::dmat3 u{1.0};
    glm::dvec3 sigma{1.0};
    glm::dmat3 v{1.0};
};

/// By one-sided Jacobi rotations, which keep small singular values accurate: Demmel and Veselic 1992,
/// SIAM J. Matrix Anal. Appl. 13(4). The matrix must be finite.
SingularValues decompose_singular(const glm::dmat3& m);

/// False where the matrix flattens: its smallest singular value is at most 1e-6 of the largest, or it is not finite.
/// Judges scales from 1e-30 to 1e30 alike.
bool has_full_rank(const glm::dmat4& world);

/// Right, up and back of a camera or light with this matrix, orthonormal and right-handed: what it looks along
/// (-z) is kept, then up; scale, shear and mirroring are taken out. Identity where the matrix gives no direction.
glm::dmat3 orthonormal_axes(const glm::dmat4& world);

/// World from camera, looking from eye to target. Where up is zero or parallel to the view another axis replaces
/// it; where eye and target coincide the camera looks along -z.
glm::dmat4 look_at(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up);

}  // namespace aleph
