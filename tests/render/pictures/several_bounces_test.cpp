// Light of several bounces from irradiance caches: every bounce counts once.

#include "render/cache/cache_fill.h"
#include "render/cache/further_bounces.h"
#include "render/cache/gather.h"
#include "tests/support/frame_bytes.h"
#include "tests/support/scenes/shot_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr double albedo = 0.7;

/// 1 + a + a^2 + ... up to a^last.
double sum_of_powers(int last) {
    double sum = 0.0;
    for (int i = last; i >= 0; --i) sum = 1.0 + albedo * sum;
    return sum;
}

Scene make_sphere(const glm::dvec3& emission) {
    Scene scene;
    const int wall = add_lambert(scene, glm::dvec3(albedo), emission);
    add_mesh(scene, flip_winding(make_faceted_sphere(2.0, 48, wall)));
    add_camera(scene, {0.3, 0.2, 0.4}, {1.0, -0.3, -1.0}, 1.2);
    return scene;
}

/// A lamp at the centre of a sphere: direct light is the same everywhere and has no noise.
Scene make_lit_sphere() {
    Scene scene = make_sphere(glm::dvec3(0.0));
    add_light(scene, Light::Kind::point, glm::dvec3(4.0 * std::numbers::pi / albedo), glm::dvec3(0.0));
    return scene;
}

RenderSettings cache_settings(int bounces, double accuracy, int gather) {
    RenderSettings settings = plain_settings(accuracy, gather);
    settings.light.bounces = bounces;
    return settings;
}

/// Facets are nearer to the lamp than the sphere: what direct light alone shows is 1.
double direct_of(const Stage& stage) {
    return mean_of_pixels(shade(stage, cache_settings(0, 0.3, 64))).mean();
}

TEST(SeveralBounces, IC23_EachAddsItsTermOnce) {
    const Stage stage(make_lit_sphere(), 24, 18);
    const double direct = direct_of(stage);
    EXPECT_NEAR(direct, 1.0, 0.01);
    for (const int bounces : {2, 3, 4}) {
        const ShadedFrame frame = shade(stage, cache_settings(bounces, 0.3, 64));
        const double expected = direct * sum_of_powers(bounces);
        EXPECT_NEAR(mean_of_pixels(frame).mean(), expected, 0.004 * expected) << bounces;
        // Hardly a look-up finds no record.
        EXPECT_LT(frame.counts.rays.multi_bounce, frame.counts.rays.gather / 50) << bounces;
    }
}

TEST(SeveralBounces, IC23_AllTogetherAreAGeometricSeries) {
    const Stage stage(make_lit_sphere(), 12, 9);
    const double expected = direct_of(stage) / (1.0 - albedo);
    for (const int bounces : {30, 1000}) {
        RenderSettings settings = cache_settings(bounces, 0.5, 64);
        settings.light.path_depth = bounces + 1;
        EXPECT_NEAR(mean_of_pixels(shade(stage, settings)).mean(), expected, 0.006 * expected) << bounces;
    }
}

/// Records that reach nowhere: all light between them goes along random rays.
TEST(SeveralBounces, IC23_EachCountsWithoutRecordsAround) {
    const Stage stage(make_lit_sphere(), 12, 9);
    const RenderSettings settings = cache_settings(8, 0.3, 64);
    const Image<float> accuracy;
    const LightingContext lighting = stage.lighting();
    RayTask task(stage.rays);
    GatherScratch scratch;
    for (const int bounces : {2, 3, 6}) {
        const IndirectContext context{.lighting = lighting,
                                      .view = stage.view,
                                      .settings = settings,
                                      .accuracy = accuracy,
                                      .progress = {},
                                      .bounces = {.further = {.bounces = bounces - 1, .noted = true}, .before = 1}};
        const GatherOptions options{.depth = 8, .multi_bounce = context.bounces.further};
        IrradianceCache cache = make_cache(stage.shading);
        std::vector<KeptRays> gathered;
        for (std::uint32_t i = 0; i < 64; ++i) {
            const float turn = 2.4f * static_cast<float>(i), z = (static_cast<float>(i) - 31.5f) / 32.0f;
            const glm::vec3 normal(std::sqrt(1.0f - z * z) * glm::vec2(std::cos(turn), std::sin(turn)), z);
            const SurfacePoint point = make_point(-1.9f * normal - glm::vec3(stage.shading.anchor), normal);
            const IrradianceSample sample =
                gather_irradiance(lighting, task, point, {choose_strata(64), {i, 1, 2, 3}}, scratch, options);
            cache.insert(*make_record(point.position, normal, 0.3f, sample, {1e-6f, 1e-6f, 1e-6f}));
            gathered.push_back(keep_rays(scratch));
        }
        RayCounts counts;
        Mean irradiance;
        for (const IrradianceRecord& record : add_bounces(context, cache, 0.3f, std::move(gathered), bounces, counts)) {
            irradiance.add(luminance(record.irradiance));
        }
        const double expected = std::numbers::pi * direct_of(stage) * sum_of_powers(bounces - 1);
        EXPECT_NEAR(irradiance.mean(), expected, 0.02 * expected) << bounces;
        EXPECT_LT(irradiance.error(), 0.01 * expected) << bounces;
        EXPECT_GT(counts.gather, 0u);
    }
}

TEST(SeveralBounces, IC23_NoSurfaceBeyondThePathsDepthScatters) {
    const Stage stage(make_lit_sphere(), 24, 18);
    RenderSettings settings = cache_settings(100, 0.3, 64);
    settings.light.path_depth = 3;
    EXPECT_EQ(count_bounces(settings), 2);
    const double expected = direct_of(stage) * sum_of_powers(2);
    EXPECT_NEAR(mean_of_pixels(shade(stage, settings)).mean(), expected, 0.004 * expected);
}

TEST(SeveralBounces, IC23_NorDoesOneThatReflects) {
    Scene scene = make_lit_sphere();
    scene.materials[0].base_color = glm::dvec3(0.95);
    scene.materials[0].gloss.metallic = 0.5;
    scene.materials[0].gloss.roughness = 0.7;
    const Stage stage(std::move(scene), 12, 9);
    RenderSettings settings = path_settings(2, 64);
    settings.light.path_depth = 3;
    const Mean paths = mean_of_pixels(shade(stage, settings));
    settings.light.integrator = Integrator::cache;
    settings.cache.accuracy = 0.3;
    settings.cache.gather = 256;
    EXPECT_NEAR(mean_of_pixels(shade(stage, settings)).mean(), paths.mean(), 0.015 * paths.mean());
}

/// It is direct light of the surface that is asked.
TEST(SeveralBounces, IC23_ALampBehindGlassIsNotFoundAgain) {
    Scene scene;
    Material glass;
    glass.gloss.metallic = glass.gloss.roughness = 0.0;
    glass.glass.transmission = 1.0;
    scene.materials.push_back(glass);
    add_mesh(scene, make_quad(20.0, 20.0, 0), {0.0, 1.0, 0.0}, z_to_down);
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(9.0));
    add_mesh(scene, make_quad(20.0, 20.0, lamp), {0.0, 2.0, 0.0}, z_to_down);
    const Stage stage(std::move(scene));
    RayTask task(stage.rays);
    RandomStream random({1, 2, 3, 4});
    const SurfacePoint floor = make_point(glm::vec3(0.0f), up);
    for (int i = 0; i < 200; ++i) {
        ASSERT_EQ(sample_multi_bounce_irradiance(stage.lighting(), task, floor, nullptr, {.bounces = 2}, 8, random),
                  Rgb(0.0f));
    }
    EXPECT_GT(task.counts.specular, 100u);
}

TEST(SeveralBounces, IC23_EverySampleFindsTheLightOfAllBounces) {
    const Stage stage(make_lit_sphere(), 24, 18);
    for (const int bounces : {2, 4}) {
        const double expected = direct_of(stage) * sum_of_powers(bounces);
        EXPECT_TRUE(holds([&](Trial& trial) {
            RenderSettings settings = cache_settings(bounces, 0.0, trial.times(32));
            settings.seed = trial.seed;
            const ShadedFrame frame = shade(stage, settings);
            const Mean mean = mean_of_pixels(frame);
            trial.near(mean, expected, 1e-3 * expected);
            EXPECT_LT(mean.error(), 0.004 * expected);
            EXPECT_GT(frame.counts.rays.path, frame.counts.samples);
            EXPECT_GT(frame.counts.multi_bounce_records, 0u);
        })) << bounces;
    }
}

TEST(SeveralBounces, IC23_AFurnaceGainsNoLight) {
    const Stage stage(make_sphere(glm::dvec3(1.0)), 16, 12);
    for (const int bounces : {0, 1, 2, 4}) {
        const double expected = sum_of_powers(bounces + 1);
        const Mean mean = mean_of_pixels(shade(stage, cache_settings(bounces, 0.3, 64)));
        EXPECT_NEAR(mean.mean(), expected, 0.01 * expected) << bounces;
    }
}

TEST(SeveralBounces, IC23_TheyCostLessThanThePictureHoweverMany) {
    const Stage stage(make_shot(), 96, 72);
    const auto counts = [&](int bounces) { return shade(stage, cache_settings(bounces, 0.1, 128)).counts; };
    const FrameCounts one = counts(1), two = counts(2), three = counts(3);
    EXPECT_EQ(one.multi_bounce_rays, 0u);
    EXPECT_GT(two.multi_bounce_records, 0u);
    EXPECT_LT(two.multi_bounce_rays, one.rays.total());
    EXPECT_LT(three.multi_bounce_rays, 2 * two.multi_bounce_rays);
    const FrameCounts many = counts(16);
    EXPECT_LT(many.multi_bounce_rays, 1.3 * three.multi_bounce_rays);
    EXPECT_LT(many.rays.total(), 1.3 * three.rays.total());
}

/// Their noise is that of whole walls, which does not shrink with the pixels.
TEST(SeveralBounces, RecordsTakeMoreRaysForALargePicture) {
    const Stage stage(make_lit_sphere(), 96, 72);
    const auto count_rays = [&](int width, int height) {
        RenderSettings settings = cache_settings(2, 0.3, 64);
        set_size(settings, width, height);
        const FrameCounts counts = shade(stage, settings).counts;
        EXPECT_GT(counts.multi_bounce_records, 20u);
        return counts.multi_bounce_rays;
    };
    const std::uint64_t small = count_rays(96, 72);
    EXPECT_EQ(count_rays(160, 120), small);
    EXPECT_GT(count_rays(320, 240), small + small / 4);
}

TEST(SeveralBounces, IC23_FilesAreEqualForAnyThreadsAloneAndInASequence) {
    const Scene scene = make_shot_with_mover();
    for (const int light_step : {0, 4}) {
        RenderSettings settings = shot_settings(light_step);
        settings.light.bounces = 3;
        settings.sampling.spp = 2;
        settings.cache.gather = 16;
        settings.cache.accuracy = 0.5;
        set_size(settings, 32, 24);
        Sequence sequence(scene, settings);
        for (const int frame : {1, 2}) frame_bytes(sequence, scene, settings, frame);
        const std::string expected = frame_bytes(sequence, scene, settings, 3);
        for (const int threads : {1, 3}) {
            EXPECT_TRUE(frame_bytes(threads, scene, settings, {3})[0] == expected) << light_step << " " << threads;
        }
        settings.light.bounces = 1;
        Sequence one(scene, settings);
        EXPECT_FALSE(frame_bytes(one, scene, settings, 3) == expected);
    }
}

/// Lighting keyframes have as many bounces as light that a frame computes itself.
TEST(SeveralBounces, IC23_KeyMomentsHaveThemToo) {
    const Scene scene = make_shot_with_mover();
    const auto mean = [&](int bounces, int light_step) {
        RenderSettings settings = shot_settings(light_step);
        settings.light.bounces = bounces;
        settings.cache.gather = 64;
        Mean sum;
        for (const Rgb& pixel : Sequence(scene, settings).render(5).shaded.indirect.pixels) sum.add(luminance(pixel));
        return sum.mean();
    };
    const double one = mean(1, 0), three = mean(3, 0), from_keyframes = mean(3, 10);
    EXPECT_GT(three, 1.1 * one);
    EXPECT_NEAR(from_keyframes, three, 0.02 * three);
}

}  // namespace
}  // namespace aleph
