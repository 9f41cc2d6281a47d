// Reports of progress: they come often enough for a stop to be quick, and what they throw leaves the sequence as it
// was.

#include <gmock/gmock.h>

#include <map>

#include "tests/support/frame_bytes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

struct Stopped : std::exception {};

/// Frames between lighting keyframes, of light that comes by several bounces.
RenderSettings keyframe_settings(int width, int height) {
    RenderSettings settings = quick_settings(width, height);
    settings.cache.gather = 16;
    settings.cache.accuracy = 0.2;
    settings.cache.light_step = 10;
    settings.light.bounces = 3;
    return settings;
}

TEST(FrameProgress, StagesReportAndGathersDoInPieces) {
    constexpr std::uint64_t most_gathers = 64;  // of a thread, between two reports
    with_threads(1, [&] {
        Sequence sequence(pool_scene(), keyframe_settings(80, 60));
        std::map<std::string, std::uint64_t> reports;
        FrameRequest request{.maps = true, .progress = [&](double, const char* stage) { ++reports[stage]; }};
        const FrameStatistics frame = sequence.render(5, request).statistics;
        std::uint64_t gathers = frame.counts.records + frame.counts.multi_bounce_records;
        ASSERT_GE(frame.keyframes.size(), 2u);
        for (const KeyframeStatistics& keyframe : frame.keyframes)
            gathers += keyframe.counts.records + keyframe.counts.multi_bounce_records;
        EXPECT_GE(reports["fill"], gathers / most_gathers);
        for (const char* const stage : {"pose", "first hits", "estimate", "motion", "vision", "shade"})
            EXPECT_GE(reports[stage], 1u) << stage;
    });
}

TEST(FrameProgress, AFrameThatIsStoppedAnywhereLeavesTheOthersAsTheyAre) {
    constexpr int stops = 8;
    const RenderSettings settings = keyframe_settings(16, 12);
    const std::string expected = frame_bytes(2, pool_scene(), settings, {5}).front();
    int reports = 0;
    Sequence(pool_scene(), settings).render(25, {.maps = true, .progress = [&](double, const char*) { ++reports; }});
    ASSERT_GT(reports, 20);
    for (int i = 0; i < stops; ++i) {
        Sequence sequence(pool_scene(), settings);
        int left = i * reports / stops;
        const auto stop = [&](double, const char*) {
            if (left-- == 0) throw Stopped();
        };
        EXPECT_THROW(sequence.render(25, {.maps = true, .progress = stop}), Stopped);
        EXPECT_TRUE(frame_bytes(sequence, pool_scene(), settings, 5) == expected) << i;
    }
}

}  // namespace
}  // namespace aleph
