// All lobes together: energy, known albedos, and two independent ways to the same integral.

#include "render/surface/scatter.h"
#include "render/surface/sheen.h"
#include "tests/support/lobes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

const std::vector<float> view_cosines{1.0f, 0.9f, 0.6f, 0.3f, 0.1f, 0.03f, 0.005f};

struct NamedMaterial {
    std::string name;
    SurfaceMaterial material;
};

SurfaceMaterial make_mixture(bool volume, bool front, double roughness) {
    Material material{
        .gloss = {.metallic = 0.3, .roughness = roughness},
        .glass = {.transmission = 0.5, .thickness = volume ? 1.0 : 0.0},
        .layers = {
            .clearcoat = 0.7, .clearcoat_roughness = 0.6, .sheen_color = glm::dvec3(0.5), .sheen_roughness = 0.4}};
    return evaluate_plain(material, front);
}

std::vector<NamedMaterial> list_white_materials() {
    std::vector<NamedMaterial> all{{"lambert", make_lambert(1.0f)}};
    const auto add = [&](const std::string& name, float value, const SurfaceMaterial& material) {
        all.push_back({name + ' ' + std::to_string(value), material});
    };
    for (const float alpha : {0.0f, 1e-3f, 0.01f, 0.1f, 0.4f, 1.0f}) {
        add("metal", alpha, make_metal(alpha));
        add("plastic", alpha, make_white_plastic(alpha));
        add("plastic without f0", alpha, make_white_plastic(alpha, 0.0f));
        add("plastic, half specular", alpha, make_white_plastic(alpha, 0.02f, 0.5f));
        add("coat on metal", alpha, with_coat(make_metal(0.0f), alpha));
        add("coat on plastic", alpha, with_coat(make_white_plastic(0.5f), alpha, 0.8f));
        SurfaceMaterial brushed = make_metal(alpha);
        brushed.gloss.tangent = {0.6f, 0.8f, 0.0f};
        for (const float stretch : {0.04f, 0.8f, 1.0f}) {
            brushed.gloss.stretch = stretch;
            add("brushed metal, stretch " + std::to_string(stretch), alpha, brushed);
        }
        for (const float ratio : {1.0f, 1.001f, 1.05f, 1.5f, 1.0f / 1.5f, 2.4f, 0.7f, 0.0f}) {
            add("sheet, ratio " + std::to_string(ratio), alpha, make_glass(alpha, ratio, false));
            add("volume, ratio " + std::to_string(ratio), alpha, make_glass(alpha, ratio, true));
        }
    }
    for (const float roughness : {0.0f, 0.1f, 0.2f, 0.35f, 0.5f, 1.0f}) {
        add("sheen alone", roughness, with_sheen({}, roughness));
        add("sheen on Lambert", roughness, with_sheen(make_lambert(1.0f), roughness));
        add("sheen and coat on plastic", roughness,
            with_coat(with_sheen(make_white_plastic(0.3f), roughness, 0.7f), 0.2f));
    }
    for (const float roughness : {0.0f, 0.3f, 0.8f}) {
        add("mixture, sheet", roughness, make_mixture(false, true, roughness));
        add("mixture, volume", roughness, make_mixture(true, true, roughness));
        add("mixture, inside the volume", roughness, make_mixture(true, false, roughness));
    }
    return all;
}

TEST(Scatter, MC14_NothingScattersMoreThanArrives) {
    for (const NamedMaterial& entry : list_white_materials()) {
        for (const float cosine : view_cosines) {
            const ViewedSurface surface = make_viewed(entry.material, direction_of(cosine));
            const LitSurface lit(surface);
            const auto check = [](const ScatterSample& sample) {
                EXPECT_NEAR(glm::length(sample.direction), 1.0f, 1e-5f);
            };
            EXPECT_TRUE(holds([&](Trial& trial) {
                trial.at_most(mean_scattered(lit, trial.times(2000), 1 + trial.seed, LobeSet::all, check), 1.001);
            })) << entry.name
                << ", cosine " << cosine;
        }
    }
}

void expect_albedo(const SurfaceMaterial& material, float cosine, double albedo, const char* what) {
    const ViewedSurface surface = make_viewed(material, direction_of(cosine));
    EXPECT_TRUE(holds([&](Trial& trial) {
        trial.near(mean_scattered(LitSurface(surface), trial.times(20'000), 2 + trial.seed), albedo, 1e-5);
    })) << what
        << ", cosine " << cosine;
}

double coat_at(double cosine) {
    return 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0);
}

TEST(Scatter, SmoothAndMatteAlbedosAreKnown) {
    for (const float cosine : view_cosines) {
        const double f = coat_at(cosine);
        expect_albedo(make_lambert(0.7f), cosine, 0.7, "Lambert");
        expect_albedo(make_metal(0.0f), cosine, 1.0, "smooth metal");
        expect_albedo(make_glass(0.0f, 1.5f, true), cosine, 1.0, "smooth glass");
        expect_albedo(make_glass(0.0f, 1.0f / 1.5f, true), cosine, 1.0, "smooth glass from inside");
        expect_albedo(make_glass(0.0f, 1.5f, false), cosine, 1.0, "smooth sheet");
        expect_albedo(make_glass(0.5f, 1.0f, true), cosine, 1.0, "no interface");
        expect_albedo(with_coat({}, 0.0f, 0.5f), cosine, 0.5 * f, "smooth coat");
        expect_albedo(with_coat(make_metal(0.0f), 0.0f), cosine, 1.0, "smooth coat on metal");
        expect_albedo(with_coat(make_lambert(0.5f), 0.0f), cosine, f + (1.0 - f) * 0.5, "smooth coat on Lambert");
    }
}

TEST(Scatter, SheenTakesItsAlbedoFromTheLayerBelow) {
    for (const float roughness : {0.3f, 0.6f, 1.0f}) {
        for (const float cosine : {1.0f, 0.6f, 0.2f, 0.05f}) {
            const double sheen = sheen_layer_albedo(roughness * roughness, cosine);
            const ViewedSurface alone = make_viewed(with_sheen({}, roughness, 0.6f), direction_of(cosine));
            const ViewedSurface layered =
                make_viewed(with_sheen(make_lambert(0.5f), roughness, 0.6f), direction_of(cosine));
            EXPECT_TRUE(holds([&](Trial& trial) {
                const int count = trial.times(40'000);
                trial.near(mean_scattered(LitSurface(alone), count, 3 + trial.seed), 0.6 * sheen, 2e-3);
                trial.near(mean_scattered(LitSurface(layered), count, 4 + trial.seed),
                           0.6 * sheen + (1.0 - 0.6 * sheen) * 0.5, 2e-3);
            })) << roughness
                << ' ' << cosine;
        }
    }
}

/// Materials without mirrors, wide enough for a grid of directions.
std::vector<NamedMaterial> list_rough_materials() {
    SurfaceMaterial brushed = make_metal(0.3f);
    brushed.gloss.stretch = 0.5f;
    brushed.gloss.tangent = {1.0f, 0.0f, 0.0f};
    SurfaceMaterial bumpy = with_coat(make_white_plastic(0.5f), 0.4f);
    bumpy.coat.normal = glm::normalize(glm::vec3(0.2f, -0.1f, 1.0f));
    return {{"metal", make_metal(0.4f)},
            {"brushed", brushed},
            {"plastic without f0", make_white_plastic(0.6f, 0.0f)},
            {"coat with a normal map", bumpy},
            {"sheen", with_sheen(make_lambert(0.5f), 0.4f)},
            {"sheet", make_glass(0.4f, 1.5f, false)},
            {"glass", make_glass(0.4f, 1.5f, true)},
            {"glass from inside", make_glass(0.5f, 1.0f / 1.5f, true)},
            {"mixture, sheet", make_mixture(false, true, 0.7)},
            {"mixture, volume", make_mixture(true, true, 0.7)},
            {"mixture, inside the volume", make_mixture(true, false, 0.7)}};
}

/// Moments to compare: all light, what passes, where it goes, and how much of it sampling the lobes finds.
constexpr int keyframe_count = 5;
using Moments = std::array<double, keyframe_count>;
constexpr std::array<const char*, keyframe_count> keyframe_names{"all", "passed", "along x", "height",
                                                                 "found by lobes"};

/// A uniform light, which can be sampled as well.
constexpr auto pdf_light = static_cast<float>(0.25 / pi);

Moments integrate_scattered(const LitSurface& lit) {
    constexpr int heights = 400, azimuths = 240;
    const LobeShares shares = share_lobes(lit, LobeSet::all);
    Moments sums{};
    for (int i = 0; i < heights; ++i) {
        const double theta = pi * (i + 0.5) / heights, cell = std::sin(theta) * pi / heights * 2.0 * pi / azimuths;
        for (int k = 0; k < azimuths; ++k) {
            const double azimuth = 2.0 * pi * (k + 0.5) / azimuths;
            const glm::vec3 d = direction_of(static_cast<float>(std::cos(theta)), static_cast<float>(azimuth));
            if (!lit.is_reached(d)) continue;
            const double f = scatter_towards(lit, d, 0.0f, {}).x * cell;
            const double by_light = scatter_towards(lit, d, pdf_light, shares).x * cell;
            const Moments here{f, d.z < 0.0f ? f : 0.0, f * d.x, f * d.z * d.z, f - by_light};
            for (int m = 0; m < keyframe_count; ++m) sums[m] += here[m];
        }
    }
    return sums;
}

std::array<Mean, keyframe_count> sample_keyframes(const LitSurface& lit, int count, std::uint32_t seed) {
    std::array<Mean, keyframe_count> means;
    const LobeShares shares = share_lobes(lit, LobeSet::all);
    RandomStream random({5 + seed, 0, 0, 0});
    for (int i = 0; i < count; ++i) {
        const ScatterSample sample = sample_scatter(lit, shares, random);
        const double w = sample.weight.x;
        const glm::vec3& d = sample.direction;
        const double found = w > 0.0 ? w * power_heuristic(sample.pdf, pdf_light) : 0.0;
        const Moments here{w, sample.passes ? w : 0.0, w * d.x, w * d.z * d.z, found};
        for (int m = 0; m < keyframe_count; ++m) means[m].add(here[m]);
    }
    return means;
}

TEST(Scatter, SamplesAndIntegralAgree) {
    for (const NamedMaterial& entry : list_rough_materials()) {
        for (const float cosine : {1.0f, 0.7f, 0.25f, 0.05f}) {
            const ViewedSurface surface = make_viewed(entry.material, direction_of(cosine));
            const LitSurface lit(surface);
            const Moments integrals = integrate_scattered(lit);
            for (int m = 0; m < keyframe_count; ++m) {
                EXPECT_TRUE(holds([&](Trial& trial) {
                    trial.near(sample_keyframes(lit, trial.times(30'000), trial.seed)[m], integrals[m], 1e-3);
                })) << entry.name
                    << ", cosine " << cosine << ": " << keyframe_names[m];
            }
        }
    }
}

TEST(Scatter, SharesAreProbabilitiesOfLobesThatExist) {
    for (const NamedMaterial& entry : list_white_materials()) {
        for (const float cosine : view_cosines) {
            const ViewedSurface surface = make_viewed(entry.material, direction_of(cosine));
            const LobeShares shares = share_lobes(LitSurface(surface), LobeSet::all);
            float sum = 0.0f;
            for (const float share : shares) {
                EXPECT_GE(share, 0.0f);
                sum += share;
            }
            EXPECT_NEAR(sum, 1.0f, 1e-5f) << entry.name;
            const LobeShares specular = share_lobes(LitSurface(surface), LobeSet::specular);
            EXPECT_EQ(specular[static_cast<int>(Lobe::diffuse)], 0.0f);
        }
    }
    const ViewedSurface black = make_viewed({}, direction_of(0.5f));
    EXPECT_EQ(share_lobes(LitSurface(black), LobeSet::all), LobeShares{});
    EXPECT_EQ(sample_scatter(LitSurface(black), {}, 0.5f, {0.5f, 0.5f}, 0.5f).weight, Rgb(0.0f));
}

}  // namespace
}  // namespace aleph
