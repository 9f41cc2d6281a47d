// Irradiance records one by one and in pairs, with values by hand.
// Records beside rays of samples: which cost less, and pictures that mix the two.

#include "render/cache/irradiance_record.h"
#include "engine/load/load_scene.h"
#include "render/cache/gather_at.h"
#include "render/frame/sequence.h"
#include "render/guide/stopping_rule.h"
#include "tests/support/indirect_pictures.h"
#include "tests/support/paths.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr RadiusBounds wide_bounds{0.01f, 10.0f, 0.2f};

/// Grey light of 2 with gradients of the length 5.
IrradianceSample make_steep_sample(float nearest = 1.0f) {
    IrradianceSample sample{.irradiance = Rgb(2.0f)};
    sample.gradients.translation.fill({3.0f, 0.0f, 4.0f});
    sample.gradients.rotation.fill({3.0f, 0.0f, 4.0f});
    sample.nearest_distance = nearest;
    sample.rays = 200;
    sample.relative_error = 0.3f;
    return sample;
}

TEST(IrradianceRecord, NoiseAndBoundsAreKept) {
    IrradianceSample sample = make_steep_sample();
    IrradianceRecord record = make_record({1.0f, 2.0f, 3.0f}, up, 0.5f, sample, wide_bounds).value();
    EXPECT_EQ(record.position, glm::vec3(1.0f, 2.0f, 3.0f));
    EXPECT_EQ(record.min_radius, 0.01f);
    EXPECT_NEAR(record.max_growth, 25.0f, 1e-4f);
    EXPECT_EQ(record.noise.error, 0.3f);
    EXPECT_NEAR(record.noise.ray_variance, 18.0f, 1e-4f);
    EXPECT_EQ(record.growth, 0.0f);
    sample.relative_error = float_infinity;
    record = make_record(glm::vec3(0.0f), up, 0.5f, sample, wide_bounds).value();
    EXPECT_EQ(record.noise.error, 1.0f);
    EXPECT_EQ(record.noise.ray_variance, 200.0f);
}

TEST(IrradianceRecord, SteepLightHasASmallRadiusAndThenALimitedGradient) {
    // Within alpha R of .4 m, a slope of 5 takes all of 2.
    IrradianceRecord record = make_record(glm::vec3(0.0f), up, 0.5f, make_steep_sample(), wide_bounds).value();
    EXPECT_NEAR(record.radius, 0.8f, 1e-6f);
    expect_near(record.gradients.translation[1], {3.0, 0.0, 4.0}, 1e-5);
    expect_near(record.gradients.rotation[1], {1.2, 0.0, 1.6}, 1e-6);  // within a unit, all of 2
    // The radius stops at its bound.
    record = make_record(glm::vec3(0.0f), up, 0.5f, make_steep_sample(), {1.6f, 10.0f, 0.2f}).value();
    EXPECT_EQ(record.radius, 1.6f);
    expect_near(record.gradients.translation[1], {1.5, 0.0, 2.0}, 1e-6);
    // Near surfaces bound it, far ones do not.
    EXPECT_EQ(make_record(glm::vec3(0.0f), up, 0.5f, make_steep_sample(0.1f), wide_bounds)->radius, 3.5f * 0.1f);
    IrradianceSample flat = make_steep_sample(float_infinity);
    flat.gradients.translation.fill(glm::vec3(0.0f));
    EXPECT_EQ(make_record(glm::vec3(0.0f), up, 0.5f, flat, wide_bounds)->radius, 10.0f);
    EXPECT_EQ(make_record(glm::vec3(0.0f), up, 0.5f, flat, {12.0f, 10.0f, 0.2f})->radius, 12.0f);
}

TEST(IrradianceRecord, SlopeIsTheLuminances) {
    for (int channel = 0; channel < 3; ++channel) {
        IrradianceSample sample = make_steep_sample();
        sample.gradients.translation.fill(glm::vec3(0.0f));
        sample.gradients.translation[static_cast<std::size_t>(channel)] = {0.0f, -60.0f, 80.0f};
        Rgb one(0.0f);
        one[channel] = 1.0f;
        const float radius = 2.0f / (0.5f * 100.0f * luminance(one));
        const IrradianceRecord record = make_record(glm::vec3(0.0f), up, 0.5f, sample, wide_bounds).value();
        EXPECT_NEAR(record.radius, radius, 1e-5f * radius) << channel;
    }
}

IrradianceRecord make_unit_record(float irradiance = 1.0f) {
    return {.radius = 1.0f, .normal = up, .irradiance = Rgb(irradiance), .tangent = make_basis(up).tangent};
}

TEST(IrradianceRecord, ErrorIsTheLargestOfThree) {
    IrradianceRecord record = make_unit_record();
    record.position = {1.0f, 2.0f, 3.0f};
    record.radius = 2.0f;
    const glm::vec3 at = record.position + glm::vec3(0.3f, 0.0f, -0.4f);
    EXPECT_NEAR(interpolation_error(record, at, up), 0.25f, 1e-6f);
    record.growth = 0.8f;
    EXPECT_NEAR(interpolation_error(record, at, up), 0.25f, 1e-6f);
    record.growth = 1.2f;
    EXPECT_NEAR(interpolation_error(record, at, up), 0.3f, 1e-6f);
    const glm::vec3 turned(0.0f, 0.8f, 0.6f);  // sqrt(1 - .8)
    EXPECT_NEAR(interpolation_error(record, record.position, turned), 0.4472136f, 1e-6f);
}

TEST(IrradianceRecord, HeightCountsFromTheMeanOfBothPlanes) {
    IrradianceRecord record = make_unit_record();
    record.radius = 2.0f;
    const auto is_used = [&](float sine) {
        const glm::vec3 normal(sine, std::sqrt(1.0f - sine * sine), 0.0f);
        return std::isfinite(interpolation_error(record, {1.0f, 0.0f, 0.0f}, normal));
    };
    // A height of sine / 2, from -.1 to .2.
    EXPECT_TRUE(is_used(0.39f));
    EXPECT_FALSE(is_used(0.41f));
    EXPECT_TRUE(is_used(-0.19f));
    EXPECT_FALSE(is_used(-0.21f));
    // The bounds belong to the range.
    record.radius = 1.0f;
    EXPECT_TRUE(std::isfinite(interpolation_error(record, {0.0f, -0.05f, 0.0f}, up)));
    EXPECT_TRUE(std::isfinite(interpolation_error(record, {0.0f, 0.1f, 0.0f}, up)));
}

TEST(IrradianceRecord, HeadroomHasAToleranceOfAThousandthOfTheRadius) {
    IrradianceRecord record = make_unit_record();
    record.radius = 2.0f;
    const auto is_used = [&](float height) {
        return std::isfinite(interpolation_error(record, {0.3f, height, 0.0f}, up));
    };
    record.space.headroom = 0.05f;
    EXPECT_TRUE(is_used(0.0519f));
    EXPECT_FALSE(is_used(0.0521f));
    record.space.headroom = 0.0f;
    EXPECT_TRUE(is_used(2.0f * 1e-3f));
}

TEST(IrradianceRecord, ClearanceIsAlongTheTangentPlane) {
    IrradianceRecord record = make_unit_record();
    record.position = {5.0f, 6.0f, 7.0f};
    record.normal = glm::vec3(0.48f, -0.6f, 0.64f);
    const Basis basis = make_basis(record.normal);
    record.tangent = basis.tangent;
    for (int i = 0; i < 16; ++i) {
        const float angle = 0.39269908f * (static_cast<float>(i) + 0.5f), x = std::cos(angle), y = std::sin(angle);
        const auto is_beyond = [&](float distance) {
            return is_beyond_clearance(record, record.position + basis.to_world({distance * x, distance * y, 0.7f}));
        };
        record.space.sectors.fill(9.0f);
        record.space.sectors[static_cast<std::size_t>(sector_of(x, y))] = 2.0f;
        EXPECT_FALSE(is_beyond(1.99f)) << i;
        EXPECT_TRUE(is_beyond(2.01f)) << i;
        record.space.sectors.fill(1.0f);
        record.space.sectors[static_cast<std::size_t>(sector_of(x, y))] = 2.0f;
        EXPECT_FALSE(is_beyond(1.99f)) << i;
    }
    record = make_unit_record();
    record.space.sectors.fill(2.0f);
    EXPECT_FALSE(is_beyond_clearance(record, 2.0f * record.tangent));  // just as far
}

TEST(IrradianceRecord, ExtrapolationAddsBothGradients) {
    IrradianceRecord record = make_unit_record(5.0f);
    record.position = {1.0f, 2.0f, 3.0f};
    record.gradients.translation[0] = {1.0f, 2.0f, 3.0f};
    record.gradients.rotation[1] = {0.5f, 7.0f, -2.0f};
    const glm::vec3 turned(-0.8f, 0.0f, 0.6f), at = record.position + glm::vec3(0.1f, 0.2f, -0.5f);
    const Rgb value = extrapolate(record, at, turned);  // cross(up, turned) = (.6, 0, .8)
    EXPECT_NEAR(value.x, 5.0f - 1.0f, 1e-6f);
    EXPECT_NEAR(value.y, 5.0f + 0.3f - 1.6f, 1e-6f);
    EXPECT_EQ(value.z, 5.0f);
    EXPECT_EQ(extrapolate(record, record.position + glm::vec3(9.0f, 0.0f, 0.0f), up).x, 10.0f);
    EXPECT_EQ(extrapolate(record, record.position - glm::vec3(9.0f, 0.0f, 0.0f), up).x, 0.0f);
}

TEST(IrradianceRecord, GrowthIsTheDifferenceBeyondNoise) {
    IrradianceRecord a = make_unit_record(1.0f), b = make_unit_record(0.6f);
    a.position = {1.0f, 0.0f, 0.0f};
    b.position = {1.0f, 0.0f, 0.2f};
    EXPECT_NEAR(measure_growth(a, b), 0.5 / (0.5 * 0.04), 1e-3);  // .4 of the mean of .8
    a.noise.error = 0.03f;
    b.noise.error = 0.04f;
    EXPECT_FLOAT_EQ(combined_noise(a, b), 0.05f);
    const double expected = std::sqrt(0.25 - 0.01) / (0.5 * 0.04);
    EXPECT_NEAR(measure_growth(a, b), expected, 1e-3);
    EXPECT_NEAR(measure_growth(b, a), expected, 1e-3);
    // The worse of both extrapolations counts: from a it is off by .1, from b by .4.
    a.gradients.translation.fill({0.0f, 0.0f, -1.5f});
    EXPECT_NEAR(measure_growth(a, b), expected, 1e-3);
    EXPECT_NEAR(measure_growth(b, a), expected, 1e-3);
    b.gradients.translation.fill({0.0f, 0.0f, -1.0f});  // off by .2
    EXPECT_NEAR(measure_growth(a, b), std::sqrt(0.0625 - 0.01) / (0.5 * 0.04), 1e-3);
    a.noise.error = 0.5f;
    EXPECT_EQ(measure_growth(a, b), 0.0f);
    b.position = a.position;
    EXPECT_EQ(measure_growth(a, b), 0.0f);
    a = b = make_unit_record(0.0f);
    b.position.x = 1.0f;
    EXPECT_EQ(measure_growth(a, b), 0.0f);
}

TEST(RecordCorrection, ContactsHaveNoGradientBeyondThem) {
    const auto gradient = [](float nearest) {
        IrradianceSample sample{.irradiance = Rgb(1.0f)};
        sample.gradients.translation.fill({0.5f, 0.0f, 0.0f});
        sample.nearest_distance = nearest;
        return make_record(glm::vec3(0.0f), up, 0.2f, sample, {0.7f, 10.0f, 0.01f})->gradients.translation[0].x;
    };
    EXPECT_EQ(gradient(0.2f), 0.5f);   // a radius of 3.5 x 0.2 m
    EXPECT_EQ(gradient(0.05f), 0.5f);  // the least radius is 4 times that by distance
    EXPECT_NEAR(gradient(0.025f), 0.25f, 1e-6f);
    EXPECT_EQ(gradient(0.0f), 0.0f);
}

TEST(RecordRays, MoreRaysKeepNoiseBelowThatOfSamples) {
    // One unit of irradiance, of which a tenth is reflected.
    const auto rays = [](float ray_variance, float tolerance, float radius = 1.0f) {
        return add_rays_for_noise(512, {1.0f, ray_variance, radius}, 0.1f, tolerance, 1.0f);
    };
    EXPECT_EQ(rays(1.0f, 1.0f), 512);
    EXPECT_EQ(rays(0.0f, 1e-6f), 512);
    EXPECT_EQ(rays(1e6f, 1e-3f), most_rays);
    EXPECT_EQ(rays(1.0f, 0.0f), most_rays) << "no error is tolerated";
    const int more = rays(5.0f, 0.01f);
    EXPECT_GT(more, 512);
    EXPECT_NEAR(0.1 * std::sqrt(5.0 / more), 0.5 * 0.01 / error_deviations, 1e-5) << "half a standard error of samples";
    EXPECT_EQ(rays(2.0f, 0.01f, 5.0f), rays(2.0f, 0.01f));
    EXPECT_NEAR(rays(2.0f, 0.01f, 7.0f), 1.4 * 1.4 * rays(2.0f, 0.01f), 2.0) << "few records reach far";
}

/// Rays of samples are without bias, and records nearly: the mixture has the light of traced paths.
TEST(RecordRays, FramesMixRecordsAndRaysOfSamples) {
    const Scene scene = load_scene(source_folder() / "scenes/cornell/scene.json");
    RenderSettings settings{.picture = {.width = 48, .height = 36}};
    follow_error(settings, 1.0);
    settings.light.bounces = 2;
    const FrameOutput mixed = Sequence(scene, settings).render(15);
    EXPECT_GT(mixed.shaded.counts.records, 10u);
    EXPECT_GT(mixed.shaded.counts.rays.path, 1000u) << "samples cast rays";

    settings.error = 0.0;  // the same records, without a tolerance: everywhere
    settings.sampling.rule = Sampling::uniform;
    settings.sampling.spp = 1;
    const FrameOutput records = Sequence(scene, settings).render(15);
    EXPECT_LT(mixed.shaded.counts.records, records.shaded.counts.records);

    settings.light.integrator = Integrator::path;
    settings.sampling.spp = 256;
    settings.seed = 7;
    const FrameOutput traced = Sequence(scene, settings).render(15);
    double of_mixed = 0.0, of_traced = 0.0;
    for (std::size_t i = 0; i < traced.shaded.color.size(); ++i) {
        of_mixed += luminance(mixed.shaded.color.pixels[i]);
        of_traced += luminance(traced.shaded.color.pixels[i]);
    }
    EXPECT_NEAR(of_mixed / of_traced, 1.0, 0.01);
}

TEST(RecordCorrection, RaysFollowVarianceAndAccuracy) {
    RenderSettings settings;
    settings.cache.accuracy = 0.1;
    EXPECT_EQ(choose_rays(settings, 0.1f, 1.0f), 2500);  // a standard error of a fifth of the accuracy: 1 / .02^2
    EXPECT_EQ(choose_rays(settings, 0.2f, 1.0f), 625);
    EXPECT_EQ(choose_rays(settings, 1.0f, 1.0f), 64);
    EXPECT_EQ(choose_rays(settings, 0.01f, 1.0f), 8192);
    EXPECT_EQ(choose_rays(settings, 0.1f, std::nullopt), 512);
    settings.cache.gather = 1000;
    EXPECT_EQ(choose_rays(settings, 0.1f, 9.0f), 1000);
    EXPECT_EQ(choose_rays(settings, 0.2f, 9.0f), 250);
}

}  // namespace
}  // namespace aleph
