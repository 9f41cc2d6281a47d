#pragma once

#include <gtest/gtest.h>

#include <glm/vec3.hpp>

namespace aleph {

inline void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance);
}

}  // namespace aleph
