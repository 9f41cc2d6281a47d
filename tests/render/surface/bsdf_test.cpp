// The surface model: reciprocity, no light from below, Fresnel.

#include "render/surface/bsdf.h"
#include "tests/support/lobes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

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
