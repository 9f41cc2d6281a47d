// The sheen layer: its table, its reciprocity.

#include "render/surface/sheen.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "tests/support/lobes.h"
#include "tests/support/numbers.h"

namespace aleph {
namespace {

/// KHR_materials_sheen with its simpler visibility term, in double.
double exact_sheen(double alpha, const glm::dvec3& view, const glm::dvec3& light) {
    const glm::dvec3 h = view + light;
    const double planar = h.x * h.x + h.y * h.y;
    const double d = (2.0 + 1.0 / alpha) * std::pow(planar / (planar + h.z * h.z), 0.5 / alpha) / (2.0 * pi);
    return d / (4.0 * (light.z + view.z - light.z * view.z));
}

/// By Gauss-Legendre's two-point rule in cells, in cosines that are dense at the horizon.
double exact_albedo(double alpha, double cos_view) {
    constexpr int cells = 80, azimuths = 80;
    const glm::dvec3 view(std::sqrt(1.0 - cos_view * cos_view), 0.0, cos_view);
    double sum = 0.0;
    for (int i = 0; i < 2 * cells; ++i) {
        const double t = (i / 2 + 0.5 + (i % 2 == 0 ? -0.5 : 0.5) / std::sqrt(3.0)) / cells;
        const double z = t * t * t, s = std::sqrt(1.0 - z * z);
        double ring = 0.0;
        for (int k = 0; k < azimuths; ++k) {
            const double phi = pi * (k + 0.5) / azimuths;
            ring += exact_sheen(alpha, view, {s * std::cos(phi), s * std::sin(phi), z});
        }
        sum += ring * z * 3.0 * t * t;
    }
    return sum * pi / (cells * azimuths);
}

TEST(Sheen, TableKeepsItsAccuracy) {
    double highest = 0.0;
    for (const float roughness : {0.032f, 0.05f, 0.1f, 0.17f, 0.3f, 0.5f, 0.77f, 1.0f}) {
        const float alpha = std::max(roughness * roughness, min_sheen_alpha);
        for (const float c : {0.0f, 1e-3f, 0.01f, 0.033f, 0.08f, 0.15f, 0.25f, 0.4f, 0.6f, 0.85f, 1.0f}) {
            const double exact = exact_albedo(alpha, std::max(c, 1e-7f)), scale = std::max(exact, 1.0);
            EXPECT_LE(sheen_albedo(alpha, c), exact + 4e-3 * scale) << roughness << ' ' << c;
            EXPECT_GE(sheen_albedo(alpha, c), exact - 5e-4 * scale) << roughness << ' ' << c;
            highest = std::max(highest, exact);
        }
    }
    EXPECT_GT(highest, 12.0);
    EXPECT_LT(highest, 13.0);
    // Out of range: as the nearest in range; no number: as the lowest.
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(sheen_albedo(nan, nan), sheen_albedo(min_sheen_alpha, 0.0f));
    EXPECT_EQ(sheen_albedo(-1.0f, -infinity), sheen_albedo(min_sheen_alpha, 0.0f));
    EXPECT_EQ(sheen_albedo(infinity, infinity), sheen_albedo(1.0f, 1.0f));
    EXPECT_EQ(sheen_albedo(0.0f, 0.3f), sheen_albedo(min_sheen_alpha, 0.3f));
    EXPECT_EQ(sheen_albedo(7.0f, 1.5f), sheen_albedo(1.0f, 1.0f));
    EXPECT_EQ(sheen_albedo(0.5f, -1.0f), sheen_albedo(0.5f, 0.0f));
}

TEST(Sheen, MC15_ReciprocalAndAsTheExtensionDefinesIt) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> height(0.01f, 1.0f), azimuth(0.0f, 6.28f);
    for (const float alpha : {1e-3f, 0.01f, 0.2f, 1.0f}) {
        for (int i = 0; i < 2000; ++i) {
            const glm::vec3 a = direction_of(height(engine), azimuth(engine));
            const glm::vec3 b = direction_of(height(engine), azimuth(engine));
            const float forth = evaluate_sheen(alpha, a, b), back = evaluate_sheen(alpha, b, a);
            ASSERT_FLOAT_EQ(forth, back);
            // The power of a float's sine: its rounding counts 1 / alpha times.
            const double exact = exact_sheen(alpha, glm::dvec3(a), glm::dvec3(b));
            ASSERT_NEAR(forth, exact, 1e-6 * (2.0 + 1.0 / alpha) * exact + 1e-30);
        }
    }
    EXPECT_EQ(evaluate_sheen(0.3f, direction_of(-0.1f), direction_of(0.5f)), 0.0f);
    EXPECT_EQ(evaluate_sheen(0.3f, direction_of(0.5f), direction_of(-0.1f)), 0.0f);
}

}  // namespace
}  // namespace aleph
