// Lobes at their limits: widths that single precision can hardly resolve, and smooth surfaces.

#include <gtest/gtest.h>

#include <random>

#include "render/surface/sheen.h"
#include "tests/support/lobes.h"

namespace aleph {
namespace {

constexpr long double pi = std::numbers::pi_v<long double>;

/// Walter et al. 2007, eq. 33, for an h that need not be exactly unit.
long double exact_ggx(long double alpha, const glm::vec3& h) {
    const long double s2 = static_cast<long double>(h.x) * h.x + static_cast<long double>(h.y) * h.y;
    const long double c2 = static_cast<long double>(h.z) * h.z;
    const long double w = alpha * alpha * c2 + s2;
    return alpha * alpha / (pi * w * w);
}

TEST(Microfacets, MC07_NarrowGgxAgainstLongDouble) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const float alpha : {1e-2f, 1e-3f, 3e-4f, 1e-4f, 1e-6f}) {
        for (int i = 0; i < 2000; ++i) {
            const double tangent = alpha * std::pow(10.0, 6.0 * unit(engine) - 3.0), azimuth = 6.2831853 * unit(engine);
            const glm::vec3 h(
                glm::normalize(glm::dvec3(tangent * std::cos(azimuth), tangent * std::sin(azimuth), 1.0)));
            const long double expected = exact_ggx(alpha, h);
            ASSERT_NEAR(ggx_d(glm::vec2(alpha), h) / expected, 1.0L, 1e-5L) << alpha << ' ' << tangent;
        }
        EXPECT_NEAR(ggx_d(glm::vec2(alpha), {0.0f, 0.0f, 1.0f}) * pi * alpha * alpha, 1.0L, 1e-5L);
    }
}

TEST(Microfacets, MC07_RoughnessZeroIsAMirror) {
    const glm::vec3 view = direction_of(0.4f);
    for (const double roughness : {0.0, 1e-6, 0.03}) {
        Material metal;
        metal.base_color = glm::dvec3(0.5);
        metal.roughness = roughness;
        metal.clearcoat = 1.0;
        metal.clearcoat_roughness = roughness;
        metal.transmission = 0.5;
        metal.metallic = 0.5;
        const SurfaceMaterial material = evaluate_plain(metal);
        EXPECT_TRUE(material.is_mirror() && material.is_coat_mirror() && material.is_glass_smooth());
        EXPECT_EQ(evaluate_glossy(material, view, {-view.x, -view.y, view.z}), Rgb(0.0f));
        EXPECT_EQ(sample_glossy(material, view, {0.3f, 0.9f}), glm::vec3(-view.x, -view.y, view.z));
    }
    // The narrowest lobe sends the light of the mirror into the same direction.
    const SurfaceMaterial narrow = make_metal(min_ggx_alpha);
    ASSERT_FALSE(narrow.is_mirror());
    Mean toward, weight;
    RandomStream random({7, 0, 0, 0});
    for (int i = 0; i < 20'000; ++i) {
        const glm::vec3 light = sample_glossy(narrow, view, random.next_2d());
        toward.add(glm::dot(light, glm::vec3(-view.x, -view.y, view.z)));
        weight.add(evaluate_glossy(narrow, view, light).x * light.z / pdf_glossy(narrow, view, light));
    }
    EXPECT_NEAR(toward.mean(), 1.0, 1e-3);
    EXPECT_NEAR(weight.mean(), 1.0, 1e-4);
}

TEST(Microfacets, MC07_BrushedAtRoughnessZeroIsNoMirror) {
    SurfaceMaterial material = make_metal(0.0f);
    material.stretch = 1.0f;
    EXPECT_FALSE(material.is_mirror());
    EXPECT_EQ(material.widths(), glm::vec2(1.0f, min_ggx_alpha));
    material.stretch = 1e-4f;
    EXPECT_TRUE(material.is_mirror());
}

TEST(Microfacets, MC08_GrazingWeightsOfEveryLobeStayAtMostOne) {
    RandomStream random({8, 0, 0, 0});
    const auto check = [&](const SurfaceMaterial& material, const char* what) {
        for (const float cosine : {1e-2f, 1e-3f, 1e-4f, 1e-6f, 0.0f}) {
            const ViewedSurface surface = make_viewed(material, direction_of(cosine));
            const LitSurface lit(surface);
            for (int i = 0; i < 2000; ++i) {
                const float pick = random.next();
                const glm::vec2 u = random.next_2d();
                const float weight =
                    sample_scatter(lit, share_lobes(lit, LobeSet::all), pick, u, random.next()).weight.x;
                ASSERT_TRUE(weight >= 0.0f && weight <= 1.0f + 1e-5f) << what << ' ' << cosine << ' ' << weight;
            }
        }
    };
    for (const float alpha : {1e-3f, 0.02f, 0.3f, 1.0f}) {
        check(make_metal(alpha), "metal");
        check(with_coat({}, alpha), "coat");
        check(make_glass(alpha, 1.5f, true), "glass");
        check(make_glass(alpha, 1.0f / 1.5f, true), "glass from inside");
        check(make_glass(alpha, 1.5f, false), "sheet");
    }
}

/// Charlie's distribution from the BRDF with both directions along h: f = D / (4 (2 c - c^2)).
double sheen_distribution(float alpha, const glm::vec3& h) {
    return evaluate_sheen(alpha, h, h) * 4.0 * (2.0 * h.z - static_cast<double>(h.z) * h.z);
}

/// There is no Phong lobe. The power of a cosine or sine that does occur, the sheen's sin^(1/alpha), keeps its digits.
TEST(Microfacets, MC09_SheenDistributionIsNormalized) {
    for (const float alpha : {1e-3f, 3e-3f, 0.01f, 0.1f, 0.5f, 1.0f}) {
        double sum = 0.0;
        constexpr int steps = 20'000;
        for (int i = 0; i < steps; ++i) {  // over z, where the integrand is D z 2 pi
            const double t = (i + 0.5) / steps, z = t * t;
            const glm::vec3 h(glm::dvec3(std::sqrt(1.0 - z * z), 0.0, z));
            sum += sheen_distribution(alpha, h) * z * 2.0 * std::numbers::pi * 2.0 * t / steps;
        }
        EXPECT_NEAR(sum, 1.0, 1e-3) << alpha;
    }
    EXPECT_EQ(evaluate_sheen(min_sheen_alpha, {0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}), 0.0f);
}

}  // namespace
}  // namespace aleph
