// Records beside rays of samples: which cost less, and pictures that mix the two.

#include "render/cache/record_worth.h"

#include "engine/load/load_scene.h"
#include "render/cache/gather_at.h"
#include "render/frame/sequence.h"
#include "render/guide/stopping_rule.h"
#include "tests/support/indirect_pictures.h"
#include "tests/support/paths.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// One unit of irradiance, 512 rays, and a pixel 1 m wide.
bool is_worth(float radius, float ray_variance, float tolerance) {
    return is_worth_record({1.0f, ray_variance, {radius}}, 1.0f, 0.1f, 1.0f, tolerance, 512);
}

TEST(RecordWorth, GrowsWithReachAndVarianceAndFallsWithTolerance) {
    constexpr float loose = 1e6f;
    EXPECT_FALSE(is_worth(10.0f, 1.0f, loose)) << "about 3 pixels";
    EXPECT_TRUE(is_worth(30.0f, 1.0f, loose)) << "28 pixels";
    EXPECT_FALSE(is_worth(10.0f, 0.0f, 1e-3f)) << "no variance: no more samples";
    EXPECT_TRUE(is_worth(10.0f, 1.0f, 0.1f)) << "130 more samples";
    EXPECT_TRUE(is_worth(10.0f, 1.0f, 0.0f)) << "no error is tolerated";
    bool before = true;
    for (float tolerance = 1e-3f; tolerance < 1e3f; tolerance *= 1.5f) {
        const bool now = is_worth(8.0f, 2.0f, tolerance);
        EXPECT_TRUE(before || !now) << tolerance;
        before = now;
    }
    EXPECT_FALSE(before);
}

TEST(RecordWorth, WhatSpreadsLimitsTheReach) {
    const ExpectedRecord wide{1.0f, 0.0f, {1000.0f}}, narrow{1.0f, 0.0f, {1000.0f, 3.0f}};
    EXPECT_TRUE(is_worth_record(wide, 1.0f, 0.1f, 1.0f, 1.0f, 512));
    EXPECT_FALSE(is_worth_record(narrow, 1.0f, 0.1f, 1.0f, 1.0f, 512)) << "3 m sqrt(.1)";
}

TEST(RecordWorth, MoreRaysKeepNoiseBelowThatOfSamples) {
    // One unit of irradiance, of which a tenth is reflected.
    const auto rays = [](float ray_variance, float tolerance) {
        return add_rays_for_noise(512, {1.0f, ray_variance, {}}, 0.1f, tolerance);
    };
    EXPECT_EQ(rays(1.0f, 1.0f), 512);
    EXPECT_EQ(rays(0.0f, 1e-6f), 512);
    EXPECT_EQ(rays(1e6f, 1e-3f), most_rays);
    EXPECT_EQ(rays(1.0f, 0.0f), most_rays) << "no error is tolerated";
    const int more = rays(5.0f, 0.01f);
    EXPECT_GT(more, 512);
    EXPECT_NEAR(0.1 * std::sqrt(5.0 / more), 0.5 * 0.01 / error_deviations, 1e-5) << "half a standard error of samples";
}

TEST(RecordWorth, ATolerantPictureHasFewerRecordsAndAStrictOneAll) {
    IndirectStage room(make_cluttered_room(), 96, 72, 0.05, 1024);  // where a record costs much, fewer pay
    const auto count = [&](const Image<float>* tolerance) {
        room.context.tolerance = tolerance;
        return room.fill().cache.records().size();
    };
    const Image<float> loose(96, 72, 1e6f), strict(96, 72, 0.0f);
    const std::size_t all = count(nullptr), few = count(&loose), most = count(&strict);
    EXPECT_GE(few, 20u) << "large tiles have records in any case";
    EXPECT_LT(few * 2, all);
    EXPECT_GT(most, all * 8 / 10);
}

/// Rays of samples are without bias, and records nearly: the mixture has the light of traced paths.
TEST(RecordWorth, FramesMixRecordsAndRaysOfSamples) {
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
