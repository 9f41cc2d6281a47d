// Random numbers and sampling functions against known values.

#include "engine/base/sampling.h"
#include "tests/support/trial.h"

namespace aleph {
namespace {

TEST(Sampling, MC05_UnitFloatIsNeverOne) {
    EXPECT_LT(unit_float(0xffffffffu), 1.0f);
    EXPECT_EQ(unit_float(0), 0.0f);
    RandomStream stream({1, 2, 3, 4});
    float largest = 0.0f;
    for (int i = 0; i < 1'000'000; ++i) {
        const glm::vec2 pair = stream.next_2d();
        largest = std::max({largest, stream.next(), pair.x, pair.y});
    }
    EXPECT_LT(largest, 1.0f);
    EXPECT_GT(largest, 1.0f - 1e-5f);
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
    EXPECT_TRUE(holds([](Trial& trial) {
        Mean height;
        for (std::uint32_t i = 0; i < trial.times(100'000u); ++i) {
            const glm::vec3 d = sample_cosine_hemisphere(RandomStream({7 + trial.seed, 0, i, 0}).next_2d());
            ASSERT_GE(d.z, 0.0f);
            ASSERT_NEAR(glm::length(d), 1.0f, 1e-6f);
            height.add(d.z);
        }
        trial.near(height, 2.0 / 3.0);
    }));
    for (const float u : {0.0f, 0.5f, 1.0f - 0x1p-24f}) {  // the rim, where x^2 + y^2 exceeds 1 by rounding
        for (int i = 0; i < 1000; ++i) {
            const glm::vec3 d = sample_cosine_hemisphere({u, static_cast<float>(i) / 1000.0f});
            ASSERT_NEAR(d.z, std::sqrt(1.0 - u), 1e-7);
        }
    }
}

TEST(Sampling, RC13_BasisIsOrthonormalAlsoAtThePoles) {
    RandomStream random({3, 0, 0, 0});
    double worst = 0.0;
    // In double: the products and sums of the check itself would add roundings.
    const auto error_of = [](const glm::vec3& n) {
        const Basis b = make_basis(n);
        const glm::dvec3 t(b.tangent), s(b.bitangent), up(n);
        return std::max({std::abs(glm::dot(t, up)), std::abs(glm::dot(s, up)), std::abs(glm::dot(t, s)),
                         std::abs(glm::length(t) - 1.0), std::abs(glm::length(s) - 1.0)});
    };
    const auto check = [&](const glm::vec3& n) { EXPECT_LT(error_of(n), 2e-7) << n.x << " " << n.y << " " << n.z; };
    check({0, 0, 1});
    check({0, 0, -1});
    for (const float z : {1.0f, -1.0f, 0.0f, -0.0f}) {  // around the poles, and where the sign of z changes
        for (const float x : {0.0f, 1e-8f, -1e-8f, 1e-4f, 1.0f, -1.0f}) {
            for (const float y : {0.0f, 1e-8f, -1e-8f, 1e-30f, -1.0f}) {
                const glm::dvec3 v(x, y, z);
                if (glm::length(v) > 0.0) check(glm::vec3(glm::normalize(v)));
            }
        }
    }
    int count = 0;
    while (count < 1'000'000) {
        const glm::dvec3 v(random.next() - .5f, random.next() - .5f, random.next() - .5f);
        if (glm::dot(v, v) < 1e-4) continue;
        worst = std::max(worst, error_of(glm::vec3(glm::normalize(v))));
        ++count;
    }
    EXPECT_LT(worst, 2e-7);
}

TEST(Sampling, MC12_PowerHeuristicAtItsEdges) {
    EXPECT_EQ(power_heuristic(0, 0), 0.0f);
    EXPECT_EQ(power_heuristic(1e20f, 1e20f), 0.5f);
    EXPECT_EQ(power_heuristic(1e-25f, 1e-25f), 0.5f);
    EXPECT_EQ(power_heuristic(float_infinity, 1), 1.0f);
    EXPECT_EQ(power_heuristic(1, float_infinity), 0.0f);
    EXPECT_EQ(power_heuristic(float_infinity, float_infinity), 0.5f);
    EXPECT_EQ(power_heuristic(1e-25f, 1e25f), 0.0f);
    EXPECT_EQ(power_heuristic(1e25f, 1e-25f), 1.0f);
    for (const float a : {1e-25f, 1e-10f, .3f, 1.f, 7.f, 1e10f, 1e20f, float_infinity}) {
        for (const float b : {1e-25f, 1e-3f, 1.f, 3.f, 1e20f, float_infinity})
            EXPECT_NEAR(double{power_heuristic(a, b)} + power_heuristic(b, a), 1.0, 0x1p-23) << a << " " << b;
    }
}

}  // namespace
}  // namespace aleph
