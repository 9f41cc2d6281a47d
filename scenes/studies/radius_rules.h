#pragma once
// Rules for how far an irradiance value may be used, apart from the cache of the program: the split sphere of Ward,
// Rubinstein and Clear 1988, and the Hessian of Schwarzhaupt, Jensen and Jarosz 2012 ("Practical Hessian-Based Error
// Control for Irradiance Caching").

#include <array>
#include <glm/mat2x2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace aleph {

/// What the rays of a gather met, row by row from the normal (HemisphereStrata), in the tangent frame of the point: z
/// is the normal.
struct HemisphereMesh {
    int rows = 0, columns = 0;
    std::vector<glm::dvec3> points;  ///< m; misses lie far away
    std::vector<double> radiance;    ///< luminance

    std::size_t index(int row, int column) const {
        return static_cast<std::size_t>(row * columns + (column + columns) % columns);
    }
};

/// Irradiance that a triangle of constant radiance 1 sends to a surface at `from` with the normal +z (Lambert's formula
/// for polygons). Not clipped at the horizon. Positive if its corners are in counterclockwise order seen from `from`.
double triangle_irradiance(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& from);

/// Irradiance of all triangles between neighbouring points, each with the radiance of its farthest corner, as seen from
/// a point of the tangent plane: where the point moves, near surfaces hide more or less of far ones.
double mesh_irradiance(const HemisphereMesh& mesh, const glm::dvec3& from);

/// Second derivatives of mesh_irradiance by x and y, by central differences; per m2.
/// @param step  m
glm::dmat2 mesh_hessian(const HemisphereMesh& mesh, double step);

/// m: the largest circle over which the error of a linear extrapolation, integrated, is `allowed` (irradiance m2):
/// (4 allowed / (pi (|l1| + |l2|)))^(1/4), l the eigenvalues of the Hessian. Infinite where they are 0.
double hessian_radius(const glm::dmat2& hessian, double allowed);

}  // namespace aleph
