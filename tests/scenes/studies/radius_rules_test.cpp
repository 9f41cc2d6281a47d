// Radii of irradiance values where they are known in closed form.

#include "scenes/studies/radius_rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "render/cache/gather_summary.h"

namespace aleph {
namespace {

constexpr double pi_ = std::numbers::pi;
constexpr double far_away = 1e4;  // m
const HemisphereStrata fine{64, 200};

/// What a gather finds that casts its rays through the middles of the cells. The normal is z.
GatherScratch make_gather(const HemisphereStrata& strata,
                          const std::function<void(const glm::vec3& direction, float& distance, Rgb& light)>& look) {
    const Basis basis = make_basis({0.0f, 0.0f, 1.0f});
    GatherScratch scratch;
    for (int row = 0; row < strata.rows; ++row) {
        for (int column = 0; column < strata.columns; ++column) {
            const double sine2 = (row + 0.5) / strata.rows, turn = 2.0 * pi_ * (column + 0.5) / strata.columns;
            const glm::dvec3 local(std::sqrt(sine2) * std::cos(turn), std::sqrt(sine2) * std::sin(turn),
                                   std::sqrt(1.0 - sine2));
            const glm::vec3 direction = glm::vec3(glm::dvec3(basis.tangent) * local.x +
                                                  glm::dvec3(basis.bitangent) * local.y + glm::dvec3(0, 0, local.z));
            float distance = 1.0f;
            Rgb light(0.0f);
            look(direction, distance, light);
            scratch.rays.push_back({.direction = direction});
            scratch.hits.push_back({.instance = 0, .distance = distance});
            scratch.places.push_back({strata.cell(row, column), row, column, 1.0f});
            scratch.distances.push_back(distance);
            scratch.radiance.push_back(light);
        }
    }
    scratch.sides.assign(scratch.distances.size(), 1);
    scratch.below.assign(scratch.distances.size(), 0);
    return scratch;
}

/// A disc of radiance 1 overhead, parallel to the surface, at 2 m: at a distance x from its axis the irradiance is
/// pi / 2 (1 - (x^2 + h^2 - a^2) / sqrt((x^2 + h^2 + a^2)^2 - 4 a^2 x^2)), whose second derivative at 0 is
/// -4 pi a^2 h^2 / (a^2 + h^2)^3 along each axis.
TEST(RadiusRules, HessianUnderADiscIsThatOfTheClosedForm) {
    const double height = 2.0, lit_rows = 24.0;
    const GatherScratch scratch = make_gather(fine, [&](const glm::vec3& d, float& distance, Rgb& light) {
        distance = static_cast<float>(height) / d.z;
        light = Rgb(1.0 - d.z * d.z < lit_rows / fine.rows ? 1.0f : 0.0f);
    });
    // The outermost lit samples are corners of the mesh, and its rim: those beyond are farther away, and black.
    const double sine2 = (lit_rows - 0.5) / fine.rows;
    const double a2 = height * height * sine2 / (1.0 - sine2), h2 = height * height;
    const double expected = -4.0 * pi_ * a2 * h2 / std::pow(a2 + h2, 3.0);
    const HessianEigenvalues found = find_hessian(fine, {0.0f, 0.0f, 1.0f}, scratch, height, far_away);
    EXPECT_NEAR(found.first, expected, 0.01 * std::abs(expected));
    EXPECT_NEAR(found.second, expected, 0.01 * std::abs(expected));
}

/// Light from a plane of equal radiance does not change along a parallel plane. The mesh ends at the last row.
TEST(RadiusRules, HessianUnderAnEvenPlaneVanishes) {
    const auto even = [](const glm::vec3& d, float& distance, Rgb& light) {
        distance = 1.0f / d.z;
        light = Rgb(1.0f);
    };
    const auto found = find_hessian(fine, {0.0f, 0.0f, 1.0f}, make_gather(fine, even), 1.0, far_away);
    EXPECT_LT(found.sum(), 0.01 * pi_);
}

/// An error of half of (|l1| + |l2|) r^2 over the irradiance, integrated over the disc, is the bound.
TEST(RadiusRules, HessianRadiusMeetsItsBound) {
    const HessianEigenvalues hessian{-3.0, 1.0};
    const double irradiance = 2.0, bound = 1e-3, radius = hessian_radius(hessian, irradiance, bound);
    double sum = 0.0;
    constexpr int steps = 1000;
    for (int i = 0; i < steps; ++i) {
        const double r = radius * (i + 0.5) / steps;
        sum += 0.5 * (3.0 + 1.0) * r * r / irradiance * 2.0 * pi_ * r * radius / steps;
    }
    EXPECT_NEAR(sum, bound, 1e-5 * bound);
}

TEST(RadiusRules, SplitSphereReachesAsFarAsItsSphereSays) {
    const float radius = 3.0f, accuracy = 0.2f;
    GatherScratch scratch = make_gather(fine, [&](const glm::vec3&, float& distance, Rgb& light) {
        distance = radius;
        light = Rgb(1.0f);
    });
    IrradianceSample sample;
    sample.irradiance = Rgb(static_cast<float>(pi_));
    summarize_hemisphere(fine, make_basis({0.0f, 0.0f, 1.0f}), scratch, sample);
    EXPECT_NEAR(sample.harmonic_mean_distance, radius, 1e-5f);
    const RuleInput input{.rule = RadiusRule::split_sphere, .accuracy = accuracy, .most = 10.0f, .hessian = {}};
    const auto record = make_ruled_record(glm::vec3(0.0f), {0.0f, 0.0f, 1.0f}, sample, input);
    ASSERT_TRUE(record);
    EXPECT_NEAR(record->reach, accuracy * radius, 1e-5f);
    const auto error_at = [&](const glm::vec3& p, const glm::vec3& n) {
        return ruled_error(RadiusRule::split_sphere, *record, p, n);
    };
    EXPECT_NEAR(error_at({0.3f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}), 0.5f, 1e-4f);
    // 1 - cos = .02: its root over the accuracy is .7071.
    const glm::vec3 tilted(std::sqrt(1.0f - 0.98f * 0.98f), 0.0f, 0.98f);
    EXPECT_NEAR(error_at(glm::vec3(0.0f), tilted), 0.7071f, 1e-3f);
    EXPECT_TRUE(std::isinf(error_at({0.3f, 0.0f, -0.1f}, {0.0f, 0.0f, 1.0f})));
}

}  // namespace
}  // namespace aleph
