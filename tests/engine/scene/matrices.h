#pragma once
// Matrices for the tests of hard transforms, and how far two of them are apart.

#include "engine/scene/transforms.h"
#include "tests/support/test.h"

namespace aleph {

inline constexpr double double_unit = 1.2e-16;  // rounding unit

inline glm::dmat4 scaling(double x, double y, double z) {
    return glm::scale(glm::dmat4(1.0), glm::dvec3(x, y, z));
}
inline glm::dmat4 turning(double degrees, const glm::dvec3& axis) {
    return glm::mat4_cast(glm::angleAxis(degrees * pi / 180.0, glm::normalize(axis)));
}

inline double distance(const glm::dmat4& a, const glm::dmat4& b) {
    return std::max(largest_element(glm::dmat3(a) - glm::dmat3(b)), glm::length(a[3] - b[3]));
}

/// Affine matrices of every kind: any turn, shear, scales of either sign.
inline std::vector<glm::dmat4> random_matrices(int count) {
    std::mt19937 random(21);
    std::uniform_real_distribution<double> number(-2.0, 2.0);
    std::vector<glm::dmat4> matrices(count, glm::dmat4(1.0));
    for (glm::dmat4& m : matrices)
        for (int c = 0; c < 3; ++c) m[c] = {number(random), number(random), number(random), 0.0};
    return matrices;
}

inline void expect_orthonormal(const glm::dmat3& m, double tolerance = 4.0 * 6e-8) {
    EXPECT_LT(largest_element(glm::transpose(m) * m - glm::dmat3(1.0)), tolerance);
    EXPECT_GT(glm::determinant(m), 0.5);
}

}  // namespace aleph
