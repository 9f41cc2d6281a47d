// Random numbers and sampling functions against known values.

#include "engine/base/sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace aleph {
namespace {

TEST(Sampling, MC05_UnitFloatIsNeverOne) {
    EXPECT_LT(unit_float(0xffffffffu), 1.0f);
    EXPECT_EQ(unit_float(0), 0.0f);
}

TEST(Sampling, StreamsDependOnTheKeyAndTheDimensionOnly) {
    const RandomKey key{1, 2, 3, 4};
    RandomStream walked(key);
    for (int i = 0; i < 5; ++i) walked.next();
    EXPECT_EQ(walked.next(), RandomStream(key).at(5));
    EXPECT_NE(RandomStream({1, 2, 3, 5}).at(0), RandomStream(key).at(0));
    EXPECT_NE(RandomStream({1, 2, 4, 4}).at(0), RandomStream(key).at(0));
    EXPECT_NE(RandomStream({1, 3, 3, 4}).at(0), RandomStream(key).at(0));
    EXPECT_NE(RandomStream({2, 2, 3, 4}).at(0), RandomStream(key).at(0));
}

TEST(Sampling, StreamsAreUniformAcrossNeighbouringPixels) {
    constexpr int cells = 16, count = 160000;
    int histogram[cells] = {};
    for (int i = 0; i < count; ++i) {
        ++histogram[static_cast<int>(RandomStream({0, 0, static_cast<std::uint32_t>(i), 0}).at(0) * cells)];
    }
    double chi2 = 0.0;
    for (const int n : histogram) chi2 += (n - count / cells) * (n - count / cells) / double(count / cells);
    EXPECT_LT(chi2, 37.7);  // 15 degrees of freedom, p = .001
}

TEST(Sampling, MC06_CosineHemisphereHasMeanTwoThirds) {
    double sum = 0.0, squares = 0.0;
    constexpr int count = 100000;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 d = sample_cosine_hemisphere(RandomStream({7, 0, static_cast<std::uint32_t>(i), 0}).next_2d());
        ASSERT_GE(d.z, 0.0f);
        ASSERT_NEAR(glm::length(d), 1.0f, 1e-6f);
        sum += d.z;
        squares += double(d.z) * d.z;
    }
    const double mean = sum / count, sigma = std::sqrt((squares / count - mean * mean) / count);
    EXPECT_NEAR(mean, 2.0 / 3.0, 3.0 * sigma);
}

TEST(Sampling, RC13_BasisIsOrthonormalAlsoAtThePoles) {
    RandomStream random({3, 0, 0, 0});
    const auto check = [](const glm::vec3& n) {
        const Basis b = make_basis(n);
        EXPECT_LT(std::abs(glm::dot(b.tangent, n)), 2e-7f);
        EXPECT_LT(std::abs(glm::dot(b.bitangent, n)), 2e-7f);
        EXPECT_LT(std::abs(glm::dot(b.tangent, b.bitangent)), 2e-7f);
        EXPECT_LT(std::abs(glm::length(b.tangent) - 1.0f), 2e-7f);
        EXPECT_LT(std::abs(glm::length(b.bitangent) - 1.0f), 2e-7f);
    };
    check({0, 0, 1});
    check({0, 0, -1});
    check(glm::normalize(glm::vec3(1e-8f, -1e-8f, -1.0f)));
    for (int i = 0; i < 100000; ++i) {
        const glm::vec3 v(random.next() - .5f, random.next() - .5f, random.next() - .5f);
        if (glm::length(v) > .01f) check(glm::vec3(glm::normalize(glm::dvec3(v))));
    }
}

TEST(Sampling, MC12_PowerHeuristicAtItsEdges) {
    const float inf = std::numeric_limits<float>::infinity();
    EXPECT_EQ(power_heuristic(0, 0), 0.0f);
    EXPECT_EQ(power_heuristic(1e20f, 1e20f), 0.5f);
    EXPECT_EQ(power_heuristic(1e-25f, 1e-25f), 0.5f);
    EXPECT_EQ(power_heuristic(inf, 1), 1.0f);
    EXPECT_EQ(power_heuristic(1, inf), 0.0f);
    EXPECT_EQ(power_heuristic(inf, inf), 0.5f);
    for (const float a : {1e-10f, .3f, 1.f, 1e10f})
        EXPECT_NEAR(power_heuristic(a, 1) + power_heuristic(1, a), 1, 2e-7f);
}

}  // namespace
}  // namespace aleph
