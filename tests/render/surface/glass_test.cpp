// Dielectric interfaces: reflectance, refraction, reciprocity, nested media.
// Media take light on its way: to lamps through rough walls, to the hits of gathers, and to a camera inside.

#include <cfloat>

#include "render/cache/gather.h"
#include "render/frame/sequence.h"
#include "render/path/path.h"
#include "render/surface/glass.h"
#include "render/surface/microfacets.h"
#include "tests/support/lobes.h"
#include "tests/support/scenes/render_scenes.h"
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
    std::uniform_real_distribution<float> height(0.01f, 1.0f), azimuth(0.0f, 6.28f);
    int lit_pairs = 0;
    for (const float ratio : {0.5f, 2.0f, 4.0f, 1.0f / 1.5f, 1.2f, 1.5f, 2.4f}) {
        // Where the ratio seen from the other side is rounded, so is the direction in which next to nothing passes.
        const bool exact = 2.0f * ratio == std::floor(2.0f * ratio) && ratio != 1.5f;
        for (const float alpha : {0.02f, 0.1f, 0.4f, 1.0f}) {
            const SurfaceMaterial here = make_glass(alpha, ratio, true), there = make_glass(alpha, 1.0f / ratio, true);
            const SurfaceMaterial sheet = make_glass(alpha, ratio, false);
            for (int i = 0; i < 4000; ++i) {
                const glm::vec3 a = direction_of(height(engine), azimuth(engine));
                const glm::vec3 b = direction_of(height(engine), azimuth(engine)), below(b.x, b.y, -b.z);
                const auto f = [](const SurfaceMaterial& material, const glm::vec3& view, const glm::vec3& light) {
                    return evaluate_glass(material, view, light).f_cos.x / std::abs(light.z);
                };
                const auto expect_equal = [&](float x, float y, const char* what, float rounding = 0.0f) {
                    ASSERT_NEAR(x, y, 1e-5f * std::max(x, y) + rounding) << what << ' ' << ratio << ' ' << alpha;
                };
                expect_equal(f(here, a, b), f(here, b, a), "reflected");
                expect_equal(f(sheet, a, below), f(sheet, b, {a.x, a.y, -a.z}), "sheet");
                // With radiance over n^2, f times the viewer's n^2 is the same both ways. Seen from below, up is down.
                const float forth = f(here, a, below), back = f(there, b, {a.x, a.y, -a.z});
                expect_equal(forth, ratio * ratio * back, "refracted", exact ? 0.0f : 1e-6f);
                if (forth > 0.0f) ++lit_pairs;
            }
        }
    }
    EXPECT_GT(lit_pairs, 10'000);
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

constexpr double half_way = 1.0;  // m, over which a tinted medium takes half of the light

int add_medium(Scene& scene, double roughness, double ior, bool tinted) {
    return add_glass(scene, ior, 1.0, tinted ? half_way : 0.0, roughness);
}

RenderSettings few_samples(Integrator integrator, std::uint32_t seed) {
    RenderSettings settings = plain_settings(0.3, 64);
    settings.light.integrator = integrator;
    settings.seed = seed;
    return settings;
}

/// Mean of a small picture of a rough slab with its front at z = 0, `thick` m deep, and a lamp.
Mean picture_slab(double thick, double lamp_side, double lamp_z, bool tinted, Integrator integrator,
                  const Trial& trial) {
    Scene scene;
    add_mesh(scene, make_box({40.0, 40.0, thick}, add_medium(scene, 0.6, 1.5, tinted)), {0.0, 0.0, -0.5 * thick});
    add_lamp(scene, lamp_side, glm::dvec3(10.0), {0.0, 0.0, lamp_z}, no_turn);
    add_camera(scene, {0.0, 0.0, 3.0}, {0.0, 0.0, 0.0}, 0.1);
    const Stage stage(std::move(scene), 16, 16);
    Mean mean;
    for (std::uint32_t run = 0; run < 64u; ++run) {
        for (const Rgb& pixel : shade(stage, few_samples(integrator, trial.seed + run)).color.pixels) mean.add(pixel.x);
    }
    return mean;
}

/// Light that refraction turns as far as it can goes 1.342 times as far through the slab as straight light.
TEST(TintedGlass, TakesLightOfLampsByTheWayInsideAlone) {
    constexpr double turned = 1.342;
    for (const Integrator integrator : {Integrator::path, Integrator::cache}) {
        const Trial trial;
        const auto share = [&](double thick, double side, double z) {
            return picture_slab(thick, side, z, true, integrator, trial).mean() /
                   picture_slab(thick, side, z, false, integrator, trial).mean();
        };
        const double behind = share(1.0, 8.0, -10.0);
        EXPECT_LT(behind, 0.5) << "the lamp is outside: the air to it takes nothing";
        EXPECT_GT(behind, 0.95 * std::pow(0.5, turned));
        const double inside = share(8.0, 2.0, -4.0);
        EXPECT_LT(inside, std::pow(0.5, 4.0)) << "the lamp is in the glass";
        EXPECT_GT(inside, 0.95 * std::pow(0.5, 4.0 * turned));
    }
}

TEST(TintedGlass, ChannelsWithoutLossPassFromAnyDistance) {
    EXPECT_EQ(transmit({0.0f, 1.0f, 2.0f}, std::numeric_limits<float>::infinity()), Rgb(1.0f, 0.0f, 0.0f));
    EXPECT_EQ(transmit(Rgb(0.0f), 3.0f), Rgb(1.0f));
    EXPECT_FLOAT_EQ(transmit(Rgb(0.5f), 3.0f).x, std::exp(-1.5f));
}

/// Mean radiance over the hemisphere above the origin, as a gather finds it.
double gather_at_origin(const Stage& stage) {
    RayTask task(stage.rays);
    GatherScratch scratch;
    const auto found = gather_irradiance(stage.lighting(), task, make_point(glm::vec3(0.0f), up),
                                         {choose_strata(1024), {1, 2, 3, 4}}, scratch, {.depth = 8});
    return found.irradiance.x / std::numbers::pi;
}

/// A ball of ior 1 about a point turns no light.
TEST(TintedGlass, GathersInsideLoseLightOnTheWayOut) {
    constexpr double radius = 2.0;
    Scene scene;
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(1.0));
    add_mesh(scene, make_faceted_sphere(radius, 96, add_medium(scene, 0.0, 1.0, true)));
    const double left = std::pow(0.5, radius / half_way);
    EXPECT_NEAR(gather_at_origin(Stage(std::move(scene))), left, 0.01 * left);
}

/// A point light and a gather at the centre of a white ball within the medium: light goes to the wall and back.
TEST(TintedGlass, GathersInsideLoseLightOnTheWayToWallsAndFromThemToLamps) {
    constexpr double radius = 2.0, albedo = 0.5, intensity = 8.0;
    const double expected =
        albedo / std::numbers::pi * intensity / (radius * radius) * std::pow(0.5, 2.0 * radius / half_way);
    for (const double specular : {0.0, 1e-3}) {  // plain Lambert surfaces have code of their own
        Scene scene;
        const int white = add_lambert(scene, glm::dvec3(albedo), glm::dvec3(0.0), true);
        scene.materials[white].gloss.specular = specular;
        add_mesh(scene, make_faceted_sphere(10.0, 48, add_medium(scene, 0.0, 1.0, true)));
        add_mesh(scene, make_faceted_sphere(radius, 96, white));
        add_light(scene, Light::Kind::point, glm::dvec3(intensity), glm::dvec3(0.0));
        EXPECT_NEAR(gather_at_origin(Stage(std::move(scene))), expected, 0.01 * expected) << specular;
    }
}

TEST(TintedGlass, MediaAroundAPointAreThoseThatARayLeaves) {
    Scene scene;
    add_mesh(scene, make_faceted_sphere(2.0, 48, add_medium(scene, 0.0, 1.5, true)));
    add_mesh(scene, make_faceted_sphere(20.0, 48, add_medium(scene, 0.0, 1.33, false)));
    const Stage stage(std::move(scene));
    RayTask task(stage.rays);
    const auto find = [&](float height, const glm::vec3& direction, std::uint64_t expected_rays) {
        std::uint64_t rays = 0;
        const Media media = find_media(stage.shading, task.tracer, {glm::vec3(0.0f, height, 0.0f), direction}, rays);
        EXPECT_EQ(rays, expected_rays) << height;
        return media;
    };
    const Media both = find(0.0f, up, 3);
    EXPECT_EQ(both.ior(), 1.5f) << "the innermost";
    EXPECT_FLOAT_EQ(both.attenuation_inside().x, std::log(2.0f) / static_cast<float>(half_way));
    EXPECT_EQ(find(5.0f, -up, 4).ior(), 1.33f) << "the ray enters the ball and leaves it";
    EXPECT_EQ(find(50.0f, -up, 5).ior(), 1.0f);
}

TEST(TintedGlass, CameraInsideSeesLampsThroughTheMedium) {
    Scene scene;
    scene.film.exposure = 1.0;
    add_mesh(scene, make_faceted_sphere(20.0, 48, add_medium(scene, 0.0, 1.33, true)));
    add_lamp(scene, 10.0, glm::dvec3(1.0), {0.0, 0.0, -3.0}, no_turn);
    add_camera(scene, glm::dvec3(0.0), {0.0, 0.0, -1.0}, 0.1);
    for (const Integrator integrator : {Integrator::path, Integrator::cache}) {
        RenderSettings settings = few_samples(integrator, 1);
        settings.picture.width = settings.picture.height = 8;
        Sequence sequence(scene, settings);
        const FrameOutput frame = sequence.render(0);
        for (const Rgb& pixel : frame.shaded.color.pixels) EXPECT_NEAR(pixel.x, std::pow(0.5, 3.0 / half_way), 1e-3);
        EXPECT_EQ(frame.statistics.counts.rays.total(), frame.statistics.traced.all);
    }
}

}  // namespace
}  // namespace aleph
