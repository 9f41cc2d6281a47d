// Hard transforms of one node: mirrored, flattened, tiny, sheared, without direction (KF-17 to KF-19, KF-26 to KF-28).

#include <glm/gtc/matrix_inverse.hpp>

#include "engine/pose/pose.h"
#include "engine/scene/transforms.h"
#include "tests/engine/scene/matrices.h"

namespace aleph {
namespace {

TEST(Transforms, KF17_MirrorsTurnTheOrientationAndKeepNormalsOutward) {
    EXPECT_EQ(orientation_sign(glm::dmat4(1.0)), 1.0);
    EXPECT_EQ(orientation_sign(scaling(-1, 1, 1)), -1.0);
    EXPECT_EQ(orientation_sign(scaling(-1, -1, 1)), 1.0);
    EXPECT_EQ(orientation_sign(scaling(-1e-30, 1e-30, 1e-30)), -1.0);   // whose determinant is 1e-90
    EXPECT_EQ(orientation_sign(scaling(-1e-200, 1e-200, 1e30)), -1.0);  // whose determinant is 0 in double
    for (const glm::dmat4& m : random_matrices(500)) {
        const glm::dvec3 e1(1.0, 0.2, 0.0), e2(-0.3, 1.0, 0.4);  // a triangle; its normal faces away from `inside`
        const glm::dvec3 normal = glm::cross(e1, e2), inside = -normal;
        const glm::dvec3 flipped = orientation_sign(m) * glm::cross(glm::dmat3(m) * e1, glm::dmat3(m) * e2);
        const glm::dvec3 mapped = safe_normalize(normal_matrix(m) * normal);
        EXPECT_LT(glm::length(mapped - safe_normalize(flipped)), 1e-10);
        EXPECT_LT(glm::dot(mapped, glm::dmat3(m) * inside), 0.0);
    }
}

TEST(Transforms, KF18_ZeroScaleStaysFiniteAndIsSeen) {
    const glm::dmat3 flat = normal_matrix(scaling(1, 0, 1));
    EXPECT_EQ(flat * glm::dvec3(0.3, 2.0, -0.4), glm::dvec3(0.0, 2.0, 0.0));
    for (const glm::dmat4& m : {scaling(0, 0, 0), scaling(1, 0, 0), scaling(0, 0, -3)}) {
        EXPECT_EQ(normal_matrix(m), glm::dmat3(0.0));
        EXPECT_EQ(safe_normalize(normal_matrix(m) * glm::dvec3(1.0)), glm::dvec3(0.0));
    }
    for (const glm::dmat4& m : {scaling(1, 0, 1), scaling(0, 0, 0), scaling(1, 1, 0), scaling(1, 1e-7, 1)}) {
        EXPECT_FALSE(has_full_rank(m));
        EXPECT_FALSE(has_full_rank(turning(33, {1, 2, 3}) * m * turning(71, {-1, 0, 1})));
    }
    for (const glm::dmat4& m : {scaling(1, 1e-5, 1), scaling(-1, 1, 1), glm::dmat4(1.0)}) {
        EXPECT_TRUE(has_full_rank(m));
        EXPECT_TRUE(has_full_rank(turning(33, {1, 2, 3}) * m * turning(71, {-1, 0, 1})));
    }
    glm::dmat4 broken(1.0);
    broken[1].y = not_a_number;
    EXPECT_FALSE(has_full_rank(broken));
    EXPECT_EQ(normal_matrix(broken), glm::dmat3(0.0));
    broken[1].y = infinity;
    EXPECT_FALSE(has_full_rank(broken));
    EXPECT_EQ(orthonormal_axes(broken), glm::dmat3(1.0));
}

TEST(Transforms, KF19_TinyAndHugeScalesAreJudgedAlike) {
    const glm::dmat4 turn = turning(40, {1, 1, -2});
    for (const double s : {1e-30, 1e-14, 1e-3, 1.0, 1e14, 1e30}) {
        const glm::dmat4 m = turn * scaling(s, s, s);
        EXPECT_TRUE(has_full_rank(m)) << s;
        EXPECT_FALSE(has_full_rank(m * scaling(1, 1e-7, 1))) << s;
        EXPECT_LT(largest_element(glm::dmat3(glm::affineInverse(m) * m) - glm::dmat3(1.0)), 1e-6) << s;
        EXPECT_LT(glm::length(safe_normalize(normal_matrix(m) * glm::dvec3(0, 1, 0)) - glm::dvec3(turn[1])), 1e-14);
        EXPECT_LT(largest_element(orthonormal_axes(m) - glm::dmat3(turn)), 1e-14);
        const glm::dmat4 next = turning(80, {1, 1, -2}) * scaling(s, s, s);
        const glm::dmat4 middle = turning(60, {1, 1, -2}) * scaling(s, s, s);
        EXPECT_LT(distance(interpolate_matrix(m, next, 0.5), middle), 1e-14 * s);
    }
}

TEST(Transforms, KF19_NormalsOfScalesBeyondTheSquareOfADouble) {
    for (const double s : {1e-300, 1e-200, 1e200, 1e300})
        EXPECT_LT(glm::length(safe_normalize(normal_matrix(scaling(s, 2 * s, s)) * glm::dvec3(0.6, 1.6, 0)) -
                              safe_normalize(glm::dvec3(0.6, 0.8, 0))),
                  4.0 * double_unit);
}

TEST(Transforms, SingularValuesAreThoseOfTheProduct) {
    for (const glm::dvec3 sigma : {glm::dvec3(3, 2, 1), glm::dvec3(1, 1, 1), glm::dvec3(1, 1e-9, 1e-12),
                                   glm::dvec3(2, 2, 0), glm::dvec3(5, 0, 0)}) {
        const glm::dmat3 m(turning(25, {3, 1, 2}) * scaling(sigma.x, sigma.y, sigma.z) * turning(100, {-1, 2, 0}));
        const SingularValues svd = decompose_singular(m);
        glm::dvec3 found = svd.sigma;
        if (found.x < found.y) std::swap(found.x, found.y);
        if (found.y < found.z) std::swap(found.y, found.z);
        if (found.x < found.y) std::swap(found.x, found.y);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], sigma[i], 1e-15 * sigma.x);
        expect_orthonormal(svd.v, 1e-14);
        glm::dmat3 product = svd.u;
        for (int i = 0; i < 3; ++i) product[i] *= svd.sigma[i];
        EXPECT_LT(largest_element(product * glm::transpose(svd.v) - m), 1e-15 * sigma.x * 4.0);
    }
}

TEST(Transforms, KF26_NormalsStayAtRightAnglesUnderShear) {
    std::vector<glm::dmat4> matrices = random_matrices(500);
    matrices.push_back(scaling(1, 3, 1) * turning(30, {1, 0, 1}));
    matrices.push_back(scaling(1e-12, 3e-12, 1e-12) * turning(30, {1, 0, 1}));
    const glm::dvec3 normal = glm::normalize(glm::dvec3(1.0, 2.0, 3.0));
    const glm::dvec3 tangent = glm::cross(normal, glm::dvec3(0.0, 1.0, 0.0));
    for (const glm::dmat4& m : matrices) {
        const glm::dvec3 mapped = safe_normalize(normal_matrix(m) * normal);
        EXPECT_NEAR(glm::length(mapped), 1.0, 4.0 * double_unit);
        EXPECT_LT(std::abs(glm::dot(mapped, safe_normalize(glm::dmat3(m) * tangent))), 1e-12);
    }
}

TEST(Transforms, KF27_LookAtStraightDownAndAtItself) {
    const glm::dvec3 y(0.0, 1.0, 0.0);
    for (const glm::dvec3 target : {glm::dvec3(0, -5, 0), glm::dvec3(0, 5, 0), glm::dvec3(1e-12, -5, 0),
                                    glm::dvec3(1e-8, -5, 1e-8), glm::dvec3(0), glm::dvec3(0, -1e-300, 0)})
        for (const glm::dvec3 up : {y, -y, glm::dvec3(0.0), y * 1e-30, y * 1e30, glm::dvec3(not_a_number)}) {
            const glm::dmat4 world = look_at(glm::dvec3(0.0), target, up);
            expect_orthonormal(glm::dmat3(world), 8.0 * double_unit);
            const glm::dvec3 forward = target == glm::dvec3(0.0) ? glm::dvec3(0, 0, -1) : safe_normalize(target);
            EXPECT_LT(glm::length(-glm::dvec3(world[2]) - forward), 4.0 * double_unit);
        }
    // Up nearly along the view: beyond the eighth digit its product with the view is rounding error.
    const glm::dvec3 view = glm::normalize(glm::dvec3(3.0, -7.0, 2.0));
    for (const double lean : {1e-3, 1e-7, 2e-9, 1e-10, 1e-16})
        expect_orthonormal(glm::dmat3(look_at(glm::dvec3(0.0), view, view + glm::dvec3(lean, 0.0, -lean))), 1e-15);
    const glm::dmat4 level = look_at({1, 2, 3}, {1, 2, -7}, y);
    EXPECT_EQ(glm::dmat3(level), glm::dmat3(1.0));
    EXPECT_EQ(level[3], glm::dvec4(1, 2, 3, 1));
    const glm::dmat4 side = look_at({0, 0, 0}, {5, 0, 0}, y);
    EXPECT_EQ(glm::dvec3(side[0]), glm::dvec3(0, 0, 1));  // looking along x, z is to the right
    EXPECT_EQ(glm::dvec3(side[1]), y);
}

TEST(Transforms, KF17_WhatGrowsFromNothingDoesNotTurn) {
    const glm::dmat4 m = turning(90, {1, 2, 3}) * scaling(1, 2, 3), none = scaling(0, 0, 0);
    EXPECT_LT(distance(interpolate_matrix(none, m, 0.5), glm::dmat4(0.5 * glm::dmat3(m))), 1e-15);
    EXPECT_LT(distance(interpolate_matrix(m, none, 0.25), glm::dmat4(0.75 * glm::dmat3(m))), 1e-15);
}

TEST(Transforms, UnitQuaternionsKeepTheirBits) {
    std::mt19937 random(3);
    std::normal_distribution<double> number;
    for (int i = 0; i < 1000; ++i) {
        const double w = number(random), x = number(random), y = number(random), z = number(random);
        const glm::dquat q = safe_normalize(glm::dquat(w, x, y, z));
        EXPECT_NEAR(glm::length(q), 1.0, 4.0 * double_unit);
        const glm::dquat nearly = q * (1.0 + 2.0 * double_unit);
        if (std::abs(glm::dot(nearly, nearly) - 1.0) <= 4.0 * std::numeric_limits<double>::epsilon()) {
            EXPECT_EQ(safe_normalize(nearly), nearly);
        }
        EXPECT_NEAR(glm::length(safe_normalize(q * (1.0 + 1e-14))), 1.0, 4.0 * double_unit);
        EXPECT_NEAR(glm::length(safe_normalize(q * (1.0 - 1e-14))), 1.0, 4.0 * double_unit);
    }
}

TEST(Transforms, KF28_NormalizeAnyLength) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(1.0, -2.0, 0.5));
    for (const double length : {1e-300, 1e-38, 1e-30, 1e-3, 1.0, 1e20, 1e38, 1e300})
        EXPECT_LT(glm::length(safe_normalize(direction * length) - direction), 4.0 * double_unit) << length;
    for (const float length : {1e-38f, 1e-30f, 1.0f, 1e20f, 1e38f})
        EXPECT_LT(glm::length(safe_normalize(glm::vec3(direction) * length) - glm::vec3(direction)), 2e-7f) << length;
    for (const double none : {0.0, -0.0, 5e-324, infinity, -infinity, not_a_number})
        EXPECT_EQ(safe_normalize(glm::dvec3(none, 0.0, 0.0)), glm::dvec3(0.0)) << none;
    EXPECT_EQ(safe_normalize(glm::dvec3(1.0, not_a_number, 0.0)), glm::dvec3(0.0));
    EXPECT_EQ(safe_normalize(glm::dvec3(std::numeric_limits<double>::max(), 0.0, 0.0)), glm::dvec3(1.0, 0.0, 0.0));
    const glm::dquat identity(1.0, 0.0, 0.0, 0.0);
    EXPECT_EQ(safe_normalize(glm::dquat(0.0, 0.0, 0.0, 0.0)), identity);
    EXPECT_EQ(safe_normalize(glm::dquat(0.0, not_a_number, 0.0, 1.0)), identity);
    EXPECT_EQ(safe_normalize(glm::dquat(0.0, infinity, 0.0, 1.0)), identity);
    EXPECT_EQ(ScenePose{}.world.size(), 0u);
    Scene scene;
    scene.nodes.resize(1);
    EXPECT_EQ(pose(scene, 0.0).world[0], glm::dmat4(1.0));  // a default node stays where it is
}

}  // namespace
}  // namespace aleph
