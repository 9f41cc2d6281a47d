// Channels about the records that a picture's indirect light comes from.

#include "render/cache/irradiance_cache.h"
#include "tests/support/perception_scene.h"
#include "tests/support/shot_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

const FrameRequest everything{.frame = true, .maps = true, .progress = {}};

TEST(RecordMaps, RecordsOfKeyMomentsCountToo) {
    RenderSettings settings = shot_settings(10);
    settings.sampling.spp = 2;
    Sequence sequence(make_shot_with_mover(), settings);
    const ShadedFrame moment = sequence.render(0, everything).shaded, between = sequence.render(3, everything).shaded;
    EXPECT_GT(mean_of(moment.cache_count), 1.0);
    EXPECT_NEAR(mean_of(between.cache_count) / mean_of(moment.cache_count), 2.0, 0.3) << "of two moments";
    EXPECT_NEAR(mean_of(between.cache_radius) / mean_of(moment.cache_radius), 1.0, 0.05);
    for (std::size_t i = 0; i < moment.cache_count.size(); ++i) {
        const bool is_used = moment.cache_count.pixels[i] > 0.0f;
        EXPECT_EQ(moment.cache_radius.pixels[i] > 0.0f, is_used);
        EXPECT_LT(moment.cache_radius.pixels[i], 6.0f) << "m, of a room of 6";
    }
}

TEST(RecordMaps, OnlyOnRequestAndOnlyOfTheCache) {
    RenderSettings settings = shot_settings(0);
    settings.cache.gather = 16;
    EXPECT_TRUE(Sequence(make_shot(), settings).render(0).shaded.cache_count.empty());
    EXPECT_FALSE(Sequence(make_shot(), settings).render(0, everything).shaded.cache_radius.empty());
    settings.light.integrator = Integrator::path;
    EXPECT_TRUE(Sequence(make_shot(), settings).render(0, everything).shaded.cache_count.empty());
}

}  // namespace
}  // namespace aleph
