#pragma once
// The test of a ray against four triangles at a time. Embree's trees only find the blocks that a ray can meet; which
// triangle is met, and where, is decided here, in double precision and with operations that every processor rounds
// alike. So a picture does not depend on Embree's kernels, nor on the order of its traversal.
// Method: S. Woop, C. Benthin, I. Wald: "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013. An edge that two
// triangles share gets the same number with opposite signs, so that no ray passes between them.

#include <cmath>
#include <cstdint>
#include <experimental/simd>
#include <glm/vec3.hpp>

namespace aleph {

/// Up to four triangles.
struct alignas(32) TriangleBlock {
    static constexpr int size = 4;
    float corners[3][3][size];      ///< by corner, axis, triangle; NaN where the block is not full
    std::uint32_t primitive[size];  ///< number within the part
    std::uint32_t part[size];       ///< into TriangleTree::parts

    glm::dvec3 corner(int triangle, int which) const {
        return {corners[which][0][triangle], corners[which][1][triangle], corners[which][2][triangle]};
    }
};

/// A ray prepared for tests: its longest component is the third axis, along which the triangles are sheared.
struct ShearedRay {
    int axis[3];
    double origin[3];  ///< in the order of `axis`
    double shear_x, shear_y, inverse_z;

    /// @param direction  not 0
    void set(const glm::dvec3& from, const glm::dvec3& direction) {
        const double o[3] = {from.x, from.y, from.z}, d[3] = {direction.x, direction.y, direction.z};
        int z = std::abs(d[1]) > std::abs(d[0]) ? 1 : 0;
        if (std::abs(d[2]) > std::abs(d[z])) z = 2;
        axis[0] = z == 2 ? 0 : z + 1;
        axis[1] = z == 0 ? 2 : z - 1;
        axis[2] = z;
        for (int i = 0; i < 3; ++i) origin[i] = o[axis[i]];
        inverse_z = 1.0 / d[z];
        shear_x = d[axis[0]] * inverse_z;
        shear_y = d[axis[1]] * inverse_z;
    }
};

/// Four numbers, one per triangle of a block.
using Lanes = std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, TriangleBlock::size>>;

struct BlockHits {
    Lanes::mask_type found;
    Lanes::mask_type bordering;  ///< exactly on an edge, so that a neighbour is met as well
    Lanes distance, u, v;  ///< of those found: in lengths of the direction; weights of the second and third corner
};

/// The triangles of a block that a ray meets between two distances, both included. Borders belong to a triangle.
/// @return whether there are any
inline bool intersect_block(const TriangleBlock& block, const ShearedRay& ray, double near, double far,
                            BlockHits& hits) {
    Lanes x[3], y[3], z[3];
    for (int k = 0; k < 3; ++k) {
        const auto load = [&](int i) {
            return Lanes(block.corners[k][ray.axis[i]], std::experimental::vector_aligned) - ray.origin[i];
        };
        z[k] = load(2);
        x[k] = load(0) - ray.shear_x * z[k];
        y[k] = load(1) - ray.shear_y * z[k];
    }
    const auto edge = [&](int a, int b) { return x[a] * y[b] - y[a] * x[b]; };
    const Lanes first = edge(2, 1), second = edge(0, 2), third = edge(1, 0);
    const Lanes low = std::experimental::min(first, std::experimental::min(second, third));
    const Lanes high = std::experimental::max(first, std::experimental::max(second, third));
    const Lanes::mask_type inside = low >= 0.0 || high <= 0.0;
    if (std::experimental::none_of(inside)) return false;
    const Lanes sum = first + second + third;
    hits.distance = ray.inverse_z * (first * z[0] + second * z[1] + third * z[2]) / sum;
    hits.found = inside && hits.distance >= near && hits.distance <= far;  // not where the sum is 0: seen edge-on
    if (std::experimental::none_of(hits.found)) return false;
    hits.bordering = low == 0.0 || high == 0.0;
    hits.u = second / sum;
    hits.v = third / sum;
    return true;
}

}  // namespace aleph
