// Radii of irradiance values where the answer is known.

#include "scenes/studies/radius_rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace aleph {
namespace {

constexpr double pi = std::numbers::pi;

/// Points where the rays of strata meet z = height(x, y) of a ceiling, and its radiance there.
HemisphereMesh make_ceiling(int rows, int columns, double height, const std::function<double(double, double)>& light) {
    HemisphereMesh mesh{rows, columns, {}, {}};
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const double sine2 = (row + 0.5) / rows, sine = std::sqrt(sine2), cosine = std::sqrt(1.0 - sine2);
            const double angle = 2.0 * pi * (column + 0.5) / columns, far = height / cosine;
            mesh.points.emplace_back(far * sine * std::cos(angle), far * sine * std::sin(angle), height);
            mesh.radiance.push_back(light(mesh.points.back().x, mesh.points.back().y));
        }
    }
    return mesh;
}

TEST(RadiusRules, ATriangleSendsWhatLambertsFormulaSays) {
    // An octant of the sphere about the normal: a quarter of the hemisphere, so pi / 4.
    EXPECT_NEAR(triangle_irradiance({glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}}, {}), pi / 4.0, 1e-12);
    EXPECT_NEAR(triangle_irradiance({glm::dvec3(0, 1, 0), {1, 0, 0}, {0, 0, 1}}, {}), -pi / 4.0, 1e-12);
    // A small triangle 2 m above: area cos cos / r^2.
    const double area = 0.5 * 1e-4 * 1e-4;
    EXPECT_NEAR(triangle_irradiance({glm::dvec3(0, 0, 2), {1e-4, 0, 2}, {0, 1e-4, 2}}, {}) / (area / 4.0), 1.0, 1e-4);
}

TEST(RadiusRules, AnEvenCeilingHasItsIrradianceAndNoCurvature) {
    const HemisphereMesh mesh = make_ceiling(32, 100, 3.0, [](double, double) { return 2.0; });
    // Up to the horizon that the last row leaves out: 1 / 64 of 2 pi.
    EXPECT_NEAR(mesh_irradiance(mesh, {}), 2.0 * pi * (1.0 - 0.5 / 32.0), 0.02);
    const glm::dmat2 hessian = mesh_hessian(mesh, 0.01);
    EXPECT_LT(std::abs(hessian[0][0]) + std::abs(hessian[1][1]), 0.02 * 2.0 * pi / 9.0);
}

TEST(RadiusRules, ABrightSpotHasTheHessianOfItsFormFactor) {
    // A spot of a small solid angle straight above, h away: E = a h^4 / (h^2 + d^2)^2, so E'' = -4 E / h^2.
    const double h = 2.0;
    HemisphereMesh mesh{1, 64, {}, {}};
    for (int i = 0; i < 64; ++i) {
        const double angle = 2.0 * pi * i / 64.0;
        mesh.points.emplace_back(0.01 * std::cos(angle), 0.01 * std::sin(angle), h);
        mesh.radiance.push_back(1.0);
    }
    const double light = mesh_irradiance(mesh, {});
    EXPECT_NEAR(light, pi * 1e-4 / (h * h), 0.01 * light);
    const glm::dmat2 hessian = mesh_hessian(mesh, 0.02);
    EXPECT_NEAR(hessian[0][0], -4.0 * light / (h * h), 0.01 * light);
    EXPECT_NEAR(hessian[1][1], -4.0 * light / (h * h), 0.01 * light);
    EXPECT_NEAR(hessian[0][1], 0.0, 1e-3 * light);
}

TEST(RadiusRules, TheRadiusIsThatOfTheIntegratedError) {
    // Eigenvalues 3 and -1: pi R^4 (3 + 1) / 4 = .5.
    const glm::dmat2 hessian(1.0, 2.0, 2.0, 1.0);
    EXPECT_NEAR(hessian_radius(hessian, 0.5), std::pow(0.5 / pi, 0.25), 1e-12);
    EXPECT_TRUE(std::isinf(hessian_radius(glm::dmat2(0.0), 0.5)));
}

}  // namespace
}  // namespace aleph
