// The surface model: reciprocity, Fresnel, and lobes at their limits. The sheen layer: its table, its reciprocity.

#include "render/surface/bsdf.h"
#include "render/surface/sheen.h"
#include "tests/support/lobes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr long double exact_pi = std::numbers::pi_v<long double>;

/// Walter et al. 2007, eq. 33, for an h that need not be exactly unit.
long double exact_ggx(long double alpha, const glm::vec3& h) {
    const long double s2 = static_cast<long double>(h.x) * h.x + static_cast<long double>(h.y) * h.y;
    const long double c2 = static_cast<long double>(h.z) * h.z;
    const long double w = alpha * alpha * c2 + s2;
    return alpha * alpha / (exact_pi * w * w);
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
        EXPECT_NEAR(ggx_d(glm::vec2(alpha), {0.0f, 0.0f, 1.0f}) * exact_pi * alpha * alpha, 1.0L, 1e-5L);
    }
}

TEST(Microfacets, AreFiniteWhereBothDirectionsGraze) {
    const SurfaceMaterial metal = make_metal(0.3f);
    for (const float cosine : {1e-10f, 1e-20f, 1e-25f, 1e-37f}) {
        const Rgb f = evaluate_glossy(metal, {1.0f, 0.0f, cosine}, {-1.0f, 0.0f, cosine});
        EXPECT_TRUE(std::isfinite(f.x) && f.x >= 0.0f) << cosine << ": " << f.x;
    }
}

TEST(Microfacets, MC07_RoughnessZeroIsAMirror) {
    const glm::vec3 view = direction_of(0.4f);
    for (const double roughness : {0.0, 1e-6, 0.03}) {
        Material metal{.base_color = glm::dvec3(0.5),
                       .gloss = {.metallic = 0.5, .roughness = roughness},
                       .glass = {.transmission = 0.5},
                       .layers = {.clearcoat = 1.0, .clearcoat_roughness = roughness}};
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
    material.gloss.stretch = 1.0f;
    EXPECT_FALSE(material.is_mirror());
    EXPECT_EQ(material.widths(), glm::vec2(1.0f, min_ggx_alpha));
    material.gloss.stretch = 1e-4f;
    EXPECT_TRUE(material.is_mirror());
}

TEST(Microfacets, MC08_GrazingWeightsOfEveryLobeStayAtMostOne) {
    RandomStream random({8, 0, 0, 0});
    const auto check = [&](const SurfaceMaterial& material, const char* what) {
        for (const float cosine : {0.9f, 0.5f, 0.2f, 1e-2f, 1e-3f, 1e-4f, 1e-6f, 0.0f}) {
            const ViewedSurface surface = make_viewed(material, direction_of(cosine));
            const LitSurface lit(surface);
            for (int i = 0; i < 2000; ++i) {
                const float weight = sample_scatter(lit, share_lobes(lit, LobeSet::all), random).weight.x;
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
    EXPECT_EQ(sheen_albedo(float_nan, float_nan), sheen_albedo(min_sheen_alpha, 0.0f));
    EXPECT_EQ(sheen_albedo(-1.0f, -float_infinity), sheen_albedo(min_sheen_alpha, 0.0f));
    EXPECT_EQ(sheen_albedo(float_infinity, float_infinity), sheen_albedo(1.0f, 1.0f));
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

TEST(Microfacets, AlbedoIsTheIntegralOfTheLobe) {
    for (const float roughness : {0.1f, 0.35f, 0.6f, 1.0f}) {
        for (const float f0 : {0.04f, 1.0f}) {
            for (const float cosine : {0.08f, 0.4f, 0.93f}) {
                SurfaceMaterial material = make_metal(roughness * roughness);
                material.gloss.f0 = Rgb(f0);
                const ViewedSurface surface = make_viewed(material, direction_of(cosine));
                const AlbedoParts parts = ggx_albedo(material.gloss.alpha, cosine);
                EXPECT_TRUE(holds([&](Trial& trial) {
                    trial.near(
                        mean_scattered(LitSurface(surface), trial.times(4000), 5 + trial.seed, LobeSet::specular),
                        f0 * parts.straight + parts.grazing, 0.005);
                })) << roughness
                    << ' ' << f0 << ' ' << cosine;
            }
        }
    }
}

TEST(Bsdf, MC15_Reciprocity) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> unit(1e-3f, 1.0f), angle(0.0f, 6.28f);
    const auto expect_equal = [](float there, float back) {
        ASSERT_NEAR(there, back, 1e-5f * std::max(there, back));
        ASSERT_GE(there, 0.0f);
    };
    for (const float alpha : {1e-3f, 0.02f, 0.1f, 0.3f, 0.7f, 1.0f}) {
        for (const float stretch : {0.0f, 0.5f}) {
            SurfaceMaterial material = make_white_plastic(alpha);
            material.gloss.stretch = stretch;
            int lit = 0;
            for (int i = 0; i < 4000; ++i) {
                const glm::vec3 a = direction_of(unit(engine), angle(engine));
                // Every other pair is near a mirror's, where narrow lobes are bright.
                glm::vec3 b = direction_of(unit(engine), angle(engine));
                if (i % 2 == 0) b = glm::normalize(glm::vec3(-a.x, -a.y, a.z) + 0.5f * alpha * b);
                const float there = evaluate_glossy(material, a, b).x;
                expect_equal(there, evaluate_glossy(material, b, a).x);
                expect_equal(evaluate_diffuse(material, a.z, b.z).x, evaluate_diffuse(material, b.z, a.z).x);
                lit += there > 0.0f;
            }
            EXPECT_GT(lit, 1000) << alpha;
        }
    }
}

TEST(Bsdf, NothingBelowTheSurface) {
    const SurfaceMaterial material = make_white_plastic(0.3f);
    const glm::vec3 above = direction_of(0.5f), below(above.x, above.y, -above.z);
    for (const auto& [view, light] : {std::pair(above, below), std::pair(below, above), std::pair(below, below)}) {
        EXPECT_EQ(evaluate_glossy(material, view, light), Rgb(0.0f));
        EXPECT_EQ(pdf_glossy(material, view, light), 0.0f);
    }
}

TEST(Bsdf, FresnelStaysBetweenZeroAndOne) {
    for (const float f0 : {0.0f, 0.04f, 1.0f}) {
        SurfaceMaterial material = make_white_plastic(0.5f);
        material.gloss.f0_max = f0;
        for (int i = 0; i <= 100; ++i) {
            const float transmission = diffuse_transmission(material, static_cast<float>(i) / 100.0f);
            ASSERT_GE(transmission, 0.0f);
            ASSERT_LE(transmission, 1.0f - f0 + 1e-6f);
        }
        EXPECT_NEAR(diffuse_transmission(material, 1.0f), 1.0f - f0, 1e-6f);
        EXPECT_NEAR(diffuse_transmission(material, 0.0f), 0.0f, 1e-6f);
        // The mean in closed form against its integral, 2 cos d cos.
        double mean = 0.0;
        for (int i = 0; i < 10'000; ++i) {
            const float c = (static_cast<float>(i) + 0.5f) / 10'000.0f;
            mean += 2.0 * c * diffuse_transmission(material, c) / 10'000.0;
        }
        EXPECT_NEAR(mean_diffuse_transmission(material), mean, 1e-5);
    }
}

}  // namespace
}  // namespace aleph
