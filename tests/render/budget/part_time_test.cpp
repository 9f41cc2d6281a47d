// Parts of pictures, and what is timed of them.

#include "engine/load/load_scene.h"
#include "render/frame/sequence.h"
#include "render/pixels/picture_part.h"
#include "tests/support/paths.h"
#include "tests/support/quick_settings.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(PicturePart, IsSpreadOverThePicture) {
    const PicturePart part = choose_part(320, 240, 8, 4);
    EXPECT_DOUBLE_EQ(find_share(part), 0.125);
    for (int row = 0; row < 240; row += 4) {
        int blocks = 0;
        for (int x = 0; x < 320; x += 4) {
            blocks += part(x, row);
            for (int i = 0; i < 16; ++i) EXPECT_EQ(part(x + i % 4, row + i / 4), part(x, row));  // blocks are whole
        }
        EXPECT_EQ(blocks, 10) << row;
    }
    for (int x = 0; x < 320; x += 4) {
        int blocks = 0;
        for (int y = 0; y < 32; y += 4) blocks += part(x, y);
        EXPECT_EQ(blocks, 1) << x;
    }
}

TEST(PicturePart, OneOfOneIsTheWholePicture) {
    EXPECT_DOUBLE_EQ(find_share(choose_part(7, 5, 1, 4)), 1.0);
}

class PartTiming : public testing::Test {
  protected:
    PartTiming() : scene(load_scene((source_folder() / "scenes/cornell/scene.json").string())) {}

    /// Without lighting keyframes, so that frames and parts read the same light.
    RenderSettings settings_for(double error) const {
        RenderSettings settings = quick_settings(96, 72);
        follow_error(settings, error);
        settings.cache.light_step = 0;
        return settings;
    }

    Scene scene;
};

TEST_F(PartTiming, APartOfAllPixelsDoesWhatTheFrameDoes) {
    const std::vector<RenderSettings> settings = {settings_for(8.0), settings_for(2.0)};
    const PartTimes times =
        Sequence(scene, settings.front()).time_part(4, choose_part(96, 72, 1, 4), settings, [](auto&) { return true; });
    ASSERT_EQ(times.parts.size(), 2u);
    for (std::size_t i = 0; i < settings.size(); ++i) {
        const FrameCounts counts = Sequence(scene, settings[i]).render(4).statistics.counts;
        EXPECT_EQ(times.parts[i].samples, counts.samples) << i;
        EXPECT_EQ(times.parts[i].records, counts.records) << i;
    }
    EXPECT_GT(times.parts[1].samples, times.parts[0].samples);
}

TEST_F(PartTiming, ItsSamplesAreItsShare) {
    const std::vector<RenderSettings> settings = {settings_for(0.5)};
    const auto count = [&](int every) {
        return Sequence(scene, settings.front())
            .time_part(4, choose_part(96, 72, every, 4), settings, [](auto&) { return true; })
            .parts.front();
    };
    const PartTime all = count(1), quarter = count(4);
    EXPECT_NEAR(static_cast<double>(quarter.samples), 0.25 * static_cast<double>(all.samples),
                0.05 * static_cast<double>(all.samples));
    EXPECT_LT(quarter.records, all.records);
    EXPECT_GT(quarter.records, all.records / 4) << "blocks do not share their light";
}

TEST_F(PartTiming, EndsWhenItsCallerSaysSo) {
    const std::vector<RenderSettings> settings = {settings_for(8.0), settings_for(4.0), settings_for(2.0)};
    int asked = 0;
    const PartTimes times =
        Sequence(scene, settings.front()).time_part(4, choose_part(96, 72, 4, 4), settings, [&](auto&) {
            return ++asked < 2;
        });
    EXPECT_EQ(times.parts.size(), 2u);
    EXPECT_GT(times.before, 0.0);
}

TEST_F(PartTiming, LightIsTimedOnceForEachMoment) {
    RenderSettings settings = settings_for(8.0);
    settings.cache.light_step = 10;
    Sequence sequence(scene, settings);
    EXPECT_GT(sequence.time_light(4).keyframes, 0.0);
    EXPECT_EQ(sequence.time_light(5).keyframes, 0.0);
    settings.cache.light_step = 0;
    EXPECT_EQ(Sequence(scene, settings).time_light(4).keyframes, 0.0);
    EXPECT_GT(Sequence(scene, settings).time_light(4).fill, 0.0);
}

}  // namespace
}  // namespace aleph
