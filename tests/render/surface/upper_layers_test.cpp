// Coat and sheen: the whole surface is reciprocal, and what the layers below get under uniform light is known.

#include "render/surface/sheen.h"
#include "tests/support/lobes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

struct LayeredCase {
    std::string name;
    SurfaceMaterial material;
};

std::vector<LayeredCase> list_layered() {
    SurfaceMaterial metal = make_metal(0.1f),
                    tilted = with_coat(with_sheen(make_white_plastic(0.3f), 0.4f, 0.6f), 0.2f);
    tilted.coat.normal = glm::normalize(glm::vec3(0.3f, -0.2f, 1.0f));
    SurfaceMaterial sheet = make_glass(0.3f, 1.5f, false);
    return {{"coat alone", with_coat({}, 0.2f)},
            {"smooth coat on Lambert", with_coat(make_lambert(1.0f), 0.0f)},
            {"coat on Lambert", with_coat(make_lambert(1.0f), 0.3f, 0.8f)},
            {"coat on plastic", with_coat(make_white_plastic(0.5f), 0.05f)},
            {"coat on metal", with_coat(metal, 0.3f)},
            {"coat on a sheet", with_coat(sheet, 0.3f)},
            {"sheen alone", with_sheen({}, 0.05f)},
            {"sheen on Lambert", with_sheen(make_lambert(1.0f), 0.1f)},
            {"sheen on metal", with_sheen(metal, 0.3f)},
            {"sheen on a sheet", with_sheen(sheet, 0.3f)},
            {"sheen and coat on plastic", with_coat(with_sheen(make_white_plastic(0.3f), 0.2f, 0.7f), 0.2f)},
            {"with a normal map of the coat", tilted}};
}

/// f of the whole surface; 0 on the far side of opaque ones. A coat with a normal map counts by the cosine with its own
/// normal, as every lobe with one, and is left out.
float scatter(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec3& light) {
    const ViewedSurface surface = make_viewed(material, view);
    const LitSurface lit(surface);
    if (!lit.is_reached(light)) return 0.0f;
    float value = scatter_towards(lit, light, 0.0f, {}).x;
    if (material.coat.normal != glm::vec3(0.0f)) {
        SurfaceMaterial coat;
        coat.coat = material.coat;
        const ViewedSurface alone = make_viewed(coat, view);
        value -= scatter_towards(LitSurface(alone), light, 0.0f, {}).x;
    }
    return value / std::abs(light.z);
}

/// The far side of a sheet is seen from the other side, with the normal there.
float scatter_back(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec3& light) {
    if (light.z > 0.0f) return scatter(material, light, view);
    return scatter(material, {light.x, light.y, -light.z}, {view.x, view.y, -view.z});
}

TEST(UpperLayers, MC15_CoatAndSheenAreReciprocal) {
    std::mt19937 engine(3);
    std::uniform_real_distribution<float> height(0.003f, 1.0f), azimuth(0.0f, 6.28f);
    for (const LayeredCase& entry : list_layered()) {
        int bright = 0;
        for (int i = 0; i < 4000; ++i) {
            const glm::vec3 a = direction_of(height(engine), azimuth(engine));
            glm::vec3 b = direction_of(height(engine), azimuth(engine));
            if (i % 2 == 0) b = glm::normalize(glm::vec3(-a.x, -a.y, a.z) + 0.2f * b);  // near the mirror direction
            if (entry.material.has_glass() && i % 4 < 2) b.z = -b.z;
            const float there = scatter(entry.material, a, b), back = scatter_back(entry.material, a, b);
            ASSERT_NEAR(there, back, 1e-4f * std::max(there, back) + 2e-6f) << entry.name;
            bright += there > 1e-3f;
        }
        EXPECT_GT(bright, 50) << entry.name;
    }
}

/// Albedo of a rough coat on a black surface, against the table.
TEST(UpperLayers, CoatTableKeepsItsAccuracy) {
    for (const float alpha : {0.0011f, 0.004f, 0.01f, 0.03f, 0.08f, 0.2f, 0.5f, 1.0f}) {
        for (const float cosine : {0.003f, 0.01f, 0.03f, 0.07f, 0.15f, 0.3f, 0.6f, 1.0f}) {
            const SurfaceMaterial coat = with_coat({}, alpha);
            const glm::vec3 view = direction_of(cosine);
            const ViewedSurface surface = make_viewed(coat, view);
            const LitSurface lit(surface);
            const double exact = integrate_around_lobe(alpha, view, [&](const glm::vec3& light) {
                return static_cast<double>(scatter_towards(lit, light, 0.0f, {}).x);
            });
            EXPECT_NEAR(coat_albedo(coat.coat, cosine), exact, 1.5e-3) << alpha << ' ' << cosine;
        }
    }
    EXPECT_FLOAT_EQ(coat_albedo({.strength = 0.5f}, 0.3f), 0.5f * (0.04f + 0.96f * std::pow(0.7f, 5.0f)));
}

/// Where the coat is smooth, its Fresnel term is that of the view, as KHR_materials_clearcoat has it: what a mirror
/// below reflects is mix(base, coat, clearcoat * fresnel(0.04, N.V)).
TEST(UpperLayers, SmoothCoatOnAMirror) {
    const SurfaceMaterial coated = with_coat(make_metal(0.0f), 0.0f, 0.7f);
    for (const float cosine : {0.9f, 0.4f, 0.1f}) {
        const ViewedSurface surface = make_viewed(coated, direction_of(cosine));
        const LitSurface lit(surface);
        const double share = 0.7 * (0.04 + 0.96 * std::pow(1.0 - cosine, 5.0));
        for (const Lobe lobe : {Lobe::gloss, Lobe::coat}) {
            LobeShares only{};
            only[static_cast<int>(lobe)] = 1.0f;
            const float weight = sample_scatter(lit, only, 0.5f, {0.5f, 0.5f}, 0.5f).weight.x;
            EXPECT_NEAR(weight, lobe == Lobe::coat ? share : 1.0 - share, 1e-5);
        }
    }
}

/// The Lambert layer loses what the layers above it reflect to the viewer, and no more.
TEST(UpperLayers, LambertBelowHasTheLightThatIsLeft) {
    for (const SurfaceMaterial& above :
         {with_coat({}, 0.3f), with_coat({}, 0.0f, 0.6f), with_sheen({}, 0.1f), with_sheen({}, 0.5f, 0.8f),
          with_coat(with_sheen({}, 0.3f, 0.5f), 0.1f, 0.7f)}) {
        for (const SurfaceMaterial& below : {make_lambert(0.5f), make_white_plastic(0.4f)}) {
            SurfaceMaterial material = below;
            material.coat = above.coat;
            material.sheen = above.sheen;
            for (const float cosine : {1.0f, 0.5f, 0.1f, 0.02f}) {
                const glm::vec3 view = direction_of(cosine);
                const ViewedSurface surface = make_viewed(material, view);
                const LitSurface lit(surface);
                constexpr int steps = 2000;
                double sum = 0.0;
                for (int i = 0; i < steps; ++i) {
                    const float c = (static_cast<float>(i) + 0.5f) / steps;
                    const glm::vec3 light = direction_of(c, 0.3f);
                    sum += evaluate_diffuse(material, cosine, c).x * lit.layers.relative(light) * c * 2.0 * pi / steps;
                }
                const double alone = diffuse_radiance(material, cosine, Rgb(static_cast<float>(pi))).x;
                EXPECT_NEAR(sum, alone, 1e-3 * alone) << cosine;
                EXPECT_LE(lit.below_sheen, 1.0f);
            }
        }
    }
}

/// The mean over directions that `entering` weighs by is 1, so that irradiance of uniform light stays what it is.
TEST(UpperLayers, MC14_EnteringLightHasTheMeanOne) {
    const SurfaceMaterial material = with_coat(with_sheen(make_white_plastic(0.4f), 0.2f, 0.9f), 0.25f);
    const UpperLayers layers(material, {0.0f, 0.0f, 1.0f});
    constexpr int steps = 4000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const float c = (static_cast<float>(i) + 0.5f) / steps;
        sum += 2.0 * c * layers.entering(direction_of(c), c) / steps;
    }
    EXPECT_NEAR(sum, 1.0, 1e-3);
}

}  // namespace
}  // namespace aleph
