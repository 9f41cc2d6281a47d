// Irradiance in place of the light of wide lobes.

#include "render/path/glossy_light.h"
#include "render/cache/gather.h"
#include "render/surface/glossy_albedo.h"
#include "tests/support/lobes.h"
#include "tests/support/test.h"
#include "tests/support/trial.h"

namespace aleph {
namespace {

/// Share of uniform light that all lobes but the Lambert layer reflect.
Mean reflected_share(const ViewedSurface& surface, int count, std::uint32_t seed = 0) {
    return mean_scattered(LitSurface(surface), count, 5 + seed, LobeSet::specular);
}

TEST(GlossyLight, AlbedoIsTheIntegralOfTheLobe) {
    for (const float roughness : {0.1f, 0.35f, 0.6f, 1.0f}) {
        for (const float f0 : {0.04f, 1.0f}) {
            for (const float cosine : {0.08f, 0.4f, 0.93f}) {
                SurfaceMaterial material = make_metal(roughness * roughness);
                material.gloss.f0 = Rgb(f0);
                const ViewedSurface surface = make_viewed(material, direction_of(cosine));
                const float albedo = glossy_albedo(material, cosine).x;
                EXPECT_TRUE(holds([&](Trial& trial) {
                    trial.near(reflected_share(surface, trial.times(4000), trial.seed), albedo, 0.005);
                })) << roughness
                    << ' ' << f0 << ' ' << cosine;
            }
        }
    }
}

/// A surface with every lobe that irradiance can stand in for.
ViewedSurface make_layered_surface(float alpha) {
    const SurfaceMaterial plastic = make_white_plastic(alpha);
    return make_viewed(with_sheen(with_coat(plastic, 0.3f, 0.8f), 0.5f, 0.3f), direction_of(0.7f));
}

TEST(GlossyLight, UniformLightIsReflectedExactly) {
    const ViewedSurface surface = make_layered_surface(0.4f);
    const SampledLobes all = choose_sampled_lobes(LitSurface(surface), Rgb(static_cast<float>(2.0 * pi)), 1e6f);
    EXPECT_EQ(all.shares, LobeShares{});
    EXPECT_GT(all.radiance.x, 0.1f);
    EXPECT_TRUE(holds([&](Trial& trial) {
        trial.near(reflected_share(surface, trial.times(40'000), trial.seed), 0.5 * all.radiance.x, 0.005);
    }));
}

TEST(GlossyLight, WithoutToleranceEveryLobeIsSampled) {
    const ViewedSurface surface = make_layered_surface(0.4f);
    const LitSurface lit(surface);
    const SampledLobes none = choose_sampled_lobes(lit, Rgb(1.0f), 0.0f);
    EXPECT_EQ(none.shares, share_lobes(lit, LobeSet::specular));
    EXPECT_EQ(none.radiance, Rgb(0.0f));
    EXPECT_EQ(none.error, 0.0f);
}

TEST(GlossyLight, ErrorsSumToTheToleranceAtMost) {
    const ViewedSurface surface = make_layered_surface(0.4f);
    const LitSurface lit(surface);
    float most = 0.0f;
    int sampled = lobe_count;
    for (float tolerance = 1e-3f; tolerance < 1.0f; tolerance *= 1.3f) {
        const SampledLobes chosen = choose_sampled_lobes(lit, Rgb(1.0f), tolerance);
        EXPECT_LE(chosen.error, tolerance);
        EXPECT_GE(chosen.error, most);
        most = chosen.error;
        int left = 0;
        float sum = 0.0f;
        for (const float share : chosen.shares) {
            left += share > 0.0f ? 1 : 0;
            sum += share;
        }
        EXPECT_LE(left, sampled);
        EXPECT_NEAR(sum, left > 0 ? 1.0f : 0.0f, 1e-6f);
        sampled = left;
    }
    EXPECT_EQ(sampled, 0);
    EXPECT_GT(most, 0.0f);
    // In twice the light, errors are twice as large.
    EXPECT_FLOAT_EQ(choose_sampled_lobes(lit, Rgb(2.0f), 1e6f).error, 2.0f * most);
}

TEST(GlossyLight, NarrowLobesAndGlassAreSampled) {
    for (const SurfaceMaterial& material :
         {make_metal(0.0f), make_metal(0.08f), make_glass(0.5f, 1.5f, true), make_glass(0.0f, 1.5f, false)}) {
        const ViewedSurface surface = make_viewed(material, direction_of(0.6f));
        const LitSurface lit(surface);
        const SampledLobes chosen = choose_sampled_lobes(lit, Rgb(1.0f), 1e6f);
        EXPECT_GT(chosen.shares[static_cast<int>(material.has_glass() ? Lobe::glass : Lobe::gloss)], 0.5f);
    }
}

/// A room with a lamp and walls of two colours: indirect light comes from all sides, but not evenly.
Scene make_two_coloured_room() {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.75), glm::dvec3(0.0), true);
    const int dark = add_lambert(scene, glm::dvec3(0.15), glm::dvec3(0.0), true);
    add_small_room(scene, white, dark, glm::dvec3(9.0), 0.5);
    add_camera(scene, {0.0, 0.0, 3.4}, glm::dvec3(0.0), 0.62);
    return scene;
}

/// The light of a lobe from what gather rays found, and what stands in for it.
struct LobeLight {
    double sampled = 0.0, error = 0.0, told = 0.0;
};

LobeLight compare_lobe(const PixelSurface& surface, const SurfaceMaterial& material, const Rgb& irradiance,
                       const GatherScratch& scratch) {
    ViewedSurface viewed = surface;
    viewed.material = material;
    const LitSurface lit(viewed);
    const SampledLobes chosen = choose_sampled_lobes(lit, irradiance, 1e6f);
    LobeLight light;
    for (std::size_t i = 0; i < scratch.rays.size(); ++i) {
        const glm::vec3 local = lit.basis.to_local(scratch.rays[i].direction);
        if (!(local.z > 0.0f)) continue;
        light.sampled += luminance(evaluate_glossy(material, lit.view, local) * scratch.light[i]);
    }
    light.sampled *= pi / static_cast<double>(scratch.rays.size());
    light.error = luminance(chosen.radiance) - light.sampled;
    light.told = chosen.error;
    return light;
}

TEST(GlossyLight, TheErrorInARoomIsAboutWhatIsTold) {
    constexpr int width = 12, height = 9;
    const Stage stage(make_two_coloured_room(), width, height);
    const SampleHits hits = cast_centers(stage.rays, stage.view, nullptr);
    RayTask task(stage.rays);
    GatherScratch scratch;
    for (const float roughness : {0.6f, 1.0f}) {
        SurfaceMaterial material = make_metal(roughness * roughness);
        double errors = 0.0, told = 0.0;
        for (int p = 0; p < width * height; ++p) {
            if (hits.hits(p % width, p / width).instance == no_index) continue;
            const PixelSurface surface = make_pixel_surface(stage.shading, stage.view, hits, p % width, p / width);
            const IrradianceSample gathered =
                gather_irradiance(stage.lighting(), task, surface.point,
                                  {choose_strata(1024), {1, 2, 3, static_cast<std::uint32_t>(p)}}, scratch, {30});
            const LobeLight light = compare_lobe(surface, material, gathered.irradiance, scratch);
            errors += light.error * light.error;
            told += light.told * light.told;
        }
        EXPECT_GT(told, 0.0);
        EXPECT_LT(std::sqrt(errors / told), 1.5) << roughness;
        EXPECT_GT(std::sqrt(errors / told), 0.3) << roughness;
    }
}

}  // namespace
}  // namespace aleph
