// Dielectric interfaces: reflectance, refraction, reciprocity, nested media.

#include "render/surface/glass.h"

#include <cfloat>

#include "render/path/path.h"
#include "render/surface/fresnel.h"
#include "tests/support/lobes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// Fresnel's equations by amplitudes (Born and Wolf, Principles of Optics, 1.5.2), and the transmittance from their
/// own.
struct Interface {
    long double reflected = 1.0L, passed = 0.0L, cos_passed = 0.0L;
};

Interface exact_interface(long double c, long double ratio) {
    const long double sine2 = (1.0L - c * c) / (ratio * ratio);
    if (sine2 >= 1.0L) return {};
    const long double t = std::sqrt(1.0L - sine2);
    const long double rs = (c - ratio * t) / (c + ratio * t), rp = (ratio * c - t) / (ratio * c + t);
    const long double ts = 2.0L * c / (c + ratio * t), tp = 2.0L * c / (ratio * c + t);
    return {(rs * rs + rp * rp) / 2.0L, c > 0.0L ? ratio * t / c * (ts * ts + tp * tp) / 2.0L : 0.0L, t};
}

TEST(Glass, MC16_ReflectanceAgainstLongDouble) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f), log_ratio(-1.5f, 1.5f);
    for (int i = 0; i < 200'000; ++i) {
        const float c = i % 2 == 0 ? unit(engine) : std::pow(10.0f, -4.0f * unit(engine));
        const float ratio = i % 5 == 0 ? 1.0f + 1e-3f * log_ratio(engine) : std::exp(log_ratio(engine));
        const float r = dielectric_reflectance(c, ratio);
        const Interface exact = exact_interface(c, ratio);
        ASSERT_GE(r, 0.0f);
        ASSERT_LE(r, 1.0f);
        // Close to total reflection the root of a difference of floats limits the digits.
        const long double g = std::max(static_cast<long double>(ratio) * exact.cos_passed, 3e-4L);
        ASSERT_NEAR(r, exact.reflected, 1e-6L + 1e-6L * ratio / g) << c << ' ' << ratio;
        ASSERT_NEAR(r + exact.passed, 1.0L, 2e-6L + 1e-6L * ratio / g) << c << ' ' << ratio;
    }
}

TEST(Glass, MC16_ReflectanceInClosedForm) {
    for (const float ratio : {0.2f, 1.0f / 1.5f, 1.0001f, 1.33f, 1.5f, 2.4f, 100.0f}) {
        const double straight = std::pow((ratio - 1.0) / (ratio + 1.0), 2.0);
        EXPECT_NEAR(dielectric_reflectance(1.0f, ratio), straight, 2e-6 * straight + 1e-12) << ratio;
        EXPECT_FLOAT_EQ(dielectric_reflectance(0.0f, ratio), 1.0f) << ratio;
        // At Brewster's angle tan = ratio; only light polarized across the plane is reflected.
        const double n2 = static_cast<double>(ratio) * ratio;
        const float brewster = static_cast<float>(1.0 / std::sqrt(1.0 + n2));
        EXPECT_NEAR(dielectric_reflectance(brewster, ratio), 0.5 * std::pow((n2 - 1.0) / (n2 + 1.0), 2.0), 1e-6);
    }
    for (const float c : {0.0f, 1e-6f, 0.3f, 1.0f}) EXPECT_EQ(dielectric_reflectance(c, 0.0f), 1.0f);
    for (const float c : {0.0f, 1e-30f, 0.3f, 1.0f}) EXPECT_EQ(dielectric_reflectance(c, 1.0f), 0.0f);
    // Total reflection from glass begins at a sine of 1 / 1.5.
    const float critical = std::sqrt(1.0f - 1.0f / 2.25f);
    EXPECT_EQ(dielectric_reflectance(critical - 1e-5f, 1.0f / 1.5f), 1.0f);
    EXPECT_LT(dielectric_reflectance(critical + 1e-3f, 1.0f / 1.5f), 0.9f);
}

TEST(Glass, MC16_ReflectanceOfOddNumbers) {
    const std::vector<float> odd{0.0f,    -0.0f,          FLT_TRUE_MIN, FLT_MIN, 1.0f,
                                 FLT_MAX, float_infinity, float_nan,    -1.0f,   -float_infinity};
    for (const float x : odd) {
        for (const float y : odd) {
            const float r = dielectric_reflectance(x, y);
            ASSERT_TRUE(r >= 0.0f && r <= 1.0f) << x << ' ' << y << ' ' << r;
            // Nothing reflects between equal media; all is reflected where the numbers make no interface.
            const bool all = std::isnan(x) || !(std::abs(y) > 1e-6f) || !std::isfinite(y);
            ASSERT_EQ(r, std::abs(y) == 1.0f ? 0.0f : all ? 1.0f : r) << x << ' ' << y;
        }
        EXPECT_EQ(dielectric_reflectance(x, FLT_MAX), 1.0f) << x;
    }
    // A cosine out of range is the nearest in range, a negative ratio its magnitude.
    EXPECT_EQ(dielectric_reflectance(-3.0f, 1.5f), dielectric_reflectance(0.0f, 1.5f));
    EXPECT_EQ(dielectric_reflectance(FLT_MAX, 1.5f), dielectric_reflectance(1.0f, 1.5f));
    EXPECT_EQ(dielectric_reflectance(0.4f, -1.5f), dielectric_reflectance(0.4f, 1.5f));
}

TEST(Glass, MC25_SmoothRefractionFollowsSnell) {
    for (const float ratio : {0.5f, 1.0f / 1.5f, 0.9f, 1.0f, 1.0001f, 1.33f, 1.5f, 2.4f}) {
        const SurfaceMaterial material = make_glass(0.0f, ratio, true);
        for (int i = 1; i <= 100; ++i) {
            const glm::vec3 view = direction_of(static_cast<float>(i) / 100.0f, 2.1f);
            const double sine = std::hypot(view.x, view.y) / static_cast<double>(ratio);
            const GlassSample sample = sample_glass(material, view, {0.4f, 0.6f}, 0x1.fffffep-1f);
            EXPECT_EQ(sample.weight, Rgb(1.0f));
            EXPECT_NEAR(glm::length(sample.light), 1.0f, 1e-6f);
            if (sine >= 1.0) {
                EXPECT_EQ(sample.light, glm::vec3(-view.x, -view.y, view.z)) << "total reflection, " << ratio;
                continue;
            }
            const double scale = -1.0 / ratio;
            const glm::vec3 expected(view.x * scale, view.y * scale, -std::sqrt(1.0 - sine * sine));
            EXPECT_NEAR(glm::distance(sample.light, expected), 0.0f, sine > 0.999 ? 1e-3f : 1e-5f) << ratio << ' ' << i;
        }
    }
}

TEST(Glass, MC25_ThicknessZeroIsASheetThatTurnsNothing) {
    const glm::vec3 view = direction_of(0.3f);
    SurfaceMaterial sheet = make_glass(0.0f, 1.5f, false);
    sheet.glass.tint = {0.5f, 0.25f, 1.0f};
    const GlassSample passed = sample_glass(sheet, view, {0.4f, 0.6f}, 0.99f);
    EXPECT_EQ(passed.light, -view);
    EXPECT_EQ(passed.weight, sheet.glass.tint);
    const GlassSample reflected = sample_glass(sheet, view, {0.4f, 0.6f}, 0.0f);
    EXPECT_EQ(reflected.light, glm::vec3(-view.x, -view.y, view.z));
    EXPECT_EQ(reflected.weight, Rgb(1.0f));
    const double share = 1.0 - exact_interface(0.3f, 1.5f).reflected;
    EXPECT_NEAR(evaluate_sheet(sheet, 0.3f).y, 0.25 * share, 1e-6);
    EXPECT_TRUE(sheet.passes_straight());
    EXPECT_FALSE(make_glass(0.0f, 1.5f, true).passes_straight());
}

TEST(Glass, MC15_RoughGlassIsReciprocal) {
    std::mt19937 engine(3);
    std::uniform_real_distribution<float> height(0.05f, 1.0f), azimuth(0.0f, 6.28f);
    int lit_pairs = 0;
    for (const float ratio : {1.0f / 1.5f, 1.2f, 1.5f, 2.4f}) {
        for (const float alpha : {0.1f, 0.4f, 1.0f}) {
            const SurfaceMaterial here = make_glass(alpha, ratio, true), there = make_glass(alpha, 1.0f / ratio, true);
            const SurfaceMaterial sheet = make_glass(alpha, ratio, false);
            for (int i = 0; i < 2000; ++i) {
                const glm::vec3 a = direction_of(height(engine), azimuth(engine));
                const glm::vec3 b = direction_of(height(engine), azimuth(engine)), below(b.x, b.y, -b.z);
                const auto f = [](const SurfaceMaterial& material, const glm::vec3& view, const glm::vec3& light) {
                    return evaluate_glass(material, view, light).f_cos.x / std::abs(light.z);
                };
                const auto expect_equal = [&](float x, float y, const char* what, float relative = 1e-5f,
                                              float rounding = 0.0f) {
                    ASSERT_NEAR(x, y, relative * std::max(x, y) + rounding) << what << ' ' << ratio << ' ' << alpha;
                };
                expect_equal(f(here, a, b), f(here, b, a), "reflected");
                expect_equal(f(sheet, a, below), f(sheet, b, {a.x, a.y, -a.z}), "sheet");
                // With radiance over n^2, f times the viewer's n^2 is the same both ways. Seen from below, up is down.
                const float forth = f(here, a, below), back = f(there, b, {a.x, a.y, -a.z});
                // The half vector of refraction is a difference; where next to nothing passes, 1 - F is one too.
                expect_equal(forth, ratio * ratio * back, "refracted", 1e-4f, 1e-5f);
                if (forth > 0.0f) ++lit_pairs;
            }
        }
    }
    EXPECT_GT(lit_pairs, 5000);
}

ViewedSurface make_wall(int material, float ior, bool front, float attenuation = 0.0f) {
    ViewedSurface surface = make_viewed(make_glass(0.0f, ior, true), {0.0f, 0.0f, 1.0f});
    surface.point.material = material;
    surface.point.front = front;
    surface.material.glass.attenuation = Rgb(attenuation);
    return surface;
}

TEST(Glass, MC25_NestedMedia) {
    Media media;
    const ViewedSurface block_in = make_wall(0, 1.33f, true, 2.0f), block_out = make_wall(0, 1.33f, false, 2.0f);
    const ViewedSurface ball_in = make_wall(1, 1.5f, true, 5.0f), ball_out = make_wall(1, 1.5f, false, 5.0f);
    // The camera stands in the block and sees its wall from inside.
    EXPECT_FLOAT_EQ(media.ratio_at(block_out), 1.0f / 1.33f);
    EXPECT_EQ(media.attenuation(block_out.point, block_out.material), Rgb(2.0f));
    EXPECT_EQ(media.attenuation(block_in.point, block_in.material), Rgb(0.0f));
    media.pass(block_out.point, block_out.material);
    EXPECT_EQ(media.ior(), 1.0f);

    EXPECT_FLOAT_EQ(media.ratio_at(block_in), 1.33f);
    media.pass(block_in.point, block_in.material);
    EXPECT_EQ(media.attenuation_inside(), Rgb(2.0f));
    EXPECT_FLOAT_EQ(media.ratio_at(ball_in), 1.5f / 1.33f);
    EXPECT_FLOAT_EQ(media.ratio_at(block_out), 1.0f / 1.33f);
    media.pass(ball_in.point, ball_in.material);
    EXPECT_EQ(media.attenuation(ball_out.point, ball_out.material), Rgb(5.0f));
    EXPECT_FLOAT_EQ(media.ratio_at(ball_out), 1.33f / 1.5f);
    media.pass(ball_out.point, ball_out.material);
    EXPECT_EQ(media.ior(), 1.33f);
    media.pass(block_out.point, block_out.material);
    EXPECT_EQ(media.ior(), 1.0f);
    EXPECT_EQ(media.attenuation_inside(), Rgb(0.0f));
}

}  // namespace
}  // namespace aleph
