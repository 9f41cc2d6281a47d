// Sequences of small pictures with known differences, and tracks along known motion.

#include "render/compare/compare_sequence.h"
#include "render/compare/surface_track.h"
#include "tests/support/grey_image.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int picture_width = 10, picture_height = 8;
constexpr std::size_t pixels = picture_width * picture_height;

ChannelImage grey(float value) {
    return grey_image(picture_width, picture_height, value);
}

/// Maps of a surface at rest, with a threshold of 1 cd/m2.
ChannelImage still_maps() {
    const auto channel = [](const char* name, float value) {
        return Channel{name, Image<float>(picture_width, picture_height, value)};
    };
    return {{channel("forward.u", 0.0f), channel("forward.v", 0.0f), channel("motion.valid", 1.0f),
             channel("threshold.Y", 1.0f)},
            {}};
}

TEST(CompareSequence, SumsOverFrames) {
    SequenceComparison sequence({.tolerance = 0.15});
    for (const auto& [frame, step] : {std::pair{3, 0.0f}, {4, 0.2f}, {9, 0.1f}}) {
        sequence.add(frame, grey(0.5f + step), grey(0.5f), {});
        EXPECT_EQ(sequence.frames().back().frame, frame);
        EXPECT_EQ(sequence.frames().back().same, step < 0.15f);
        EXPECT_FALSE(sequence.frames().back().visible.has_value());
    }
    const SequenceSummary summary = sequence.summary();
    EXPECT_EQ(summary.frames, 3u);
    EXPECT_EQ(summary.different, 1u);
    EXPECT_EQ(summary.worst_frame, 4);
    EXPECT_NEAR(summary.max_abs, 0.2, 1e-6);
    EXPECT_NEAR(summary.rms, std::sqrt((0.04 + 0.01) / 3.0), 1e-6);
    EXPECT_NEAR(summary.percent(summary.beyond), 100.0 / 3.0, 1e-9);
    EXPECT_FALSE(summary.threshold.has_value());
    EXPECT_FALSE(summary.visible.has_value());
    EXPECT_FALSE(summary.same());
    ChannelImage broken = grey(0.5f);
    broken.channels[1].values(2, 2) = float_nan;
    sequence.add(12, broken, grey(0.5f), {});
    EXPECT_FALSE(sequence.frames().back().same);
    EXPECT_EQ(sequence.summary().a.nan, 1u);
}

TEST(CompareSequence, ErrorsAgainstTheThresholdOfTheMaps) {
    SequenceComparison sequence({});
    const ChannelImage maps = still_maps();
    for (int frame = 0; frame < 4; ++frame) {
        sequence.add(frame, grey(0.53f), grey(0.5f), {.threshold = &maps});  // 3 cd/m2
        EXPECT_EQ(sequence.frames().back().result.threshold->beyond, pixels);
        EXPECT_FALSE(sequence.frames().back().same);
    }
    const SequenceSummary summary = sequence.summary();
    EXPECT_EQ(summary.threshold->pixels, 4 * pixels);
    EXPECT_NEAR(summary.threshold->worst, 3.0, 1e-5);
    EXPECT_NEAR(summary.threshold->percentile_99, 3.0, 0.016);
    const ChannelImage no_threshold{{{"Z", Image<float>(picture_width, picture_height, 1.0f)}}, {}};
    EXPECT_THROW(sequence.add(5, grey(0.5f), grey(0.5f), {.threshold = &no_threshold}), InputError);
}

/// A checkerboard of 2 pixels: what the eye sees well.
ChannelImage checkers(float step) {
    ChannelImage picture = grey(0.5f);
    for (Channel& channel : picture.channels) {
        for (const auto [x, y] : all_pixels(picture_width, picture_height))
            channel.values(x, y) += (x / 2 + y / 2) % 2 ? step : -step;
    }
    return picture;
}

TEST(CompareSequence, VisibleDifferencesJudgeOnceTheSequenceEnds) {
    std::vector<std::int64_t> received;
    SequenceComparison sequence({.tolerance = unlimited, .share = 50.0}, {},
                                [&](const VisibleMaps& maps) { received.push_back(maps.frame); });
    const ChannelImage maps = still_maps();
    for (int frame = 0; frame < 14; ++frame)
        sequence.add(frame, checkers(frame < 13 ? 1e-5f : 0.3f), grey(0.5f), {.visible = &maps});
    EXPECT_FALSE(sequence.frames().back().visible.has_value()) << "frames after it may matter";
    sequence.finish();
    ASSERT_EQ(received.size(), 14u);
    EXPECT_EQ(received.back(), 13);
    EXPECT_TRUE(sequence.frames()[0].same);
    EXPECT_EQ(sequence.frames()[0].visible->seen, 0.0);
    EXPECT_FALSE(sequence.frames().back().same);
    EXPECT_EQ(sequence.frames().back().visible->seen, 100.0);
    EXPECT_EQ(sequence.frames().back().visible->flicker, 100.0);
    EXPECT_FALSE(sequence.frames().back().visible->noticed.has_value()) << "the maps have no saliency";
    EXPECT_GE(sequence.summary().visible->seen, 100.0 / 14.0);
}

TEST(CompareSequence, NothingFlickersAcrossCuts) {
    const auto flicker = [](std::vector<std::int64_t> cuts) {
        SequenceComparison sequence({.tolerance = unlimited}, std::move(cuts));
        const ChannelImage maps = still_maps();
        for (int frame = 0; frame < 2; ++frame)
            sequence.add(frame, checkers(frame == 0 ? 0.3f : -0.3f), grey(0.5f), {.visible = &maps});
        sequence.finish();
        return sequence.summary().visible->flicker;
    };
    EXPECT_EQ(flicker({}), 100.0);
    EXPECT_EQ(flicker({1}), 0.0);
}

TEST(CompareSequence, SharesAreWeighedBySaliency) {
    ChannelImage maps = still_maps(), picture = checkers(0.0f), reference = checkers(0.0f);
    maps.channels.push_back({"saliency.Y", Image<float>(picture_width, picture_height, 0.25f)});
    maps.channels.back().values(0, 0) = 1.0f;
    for (ChannelImage* each : {&picture, &reference}) each->channels[0].values(0, 0) = float_nan;
    SequenceComparison sequence({.tolerance = unlimited});
    sequence.add(0, picture, reference, {.visible = &maps});
    sequence.finish();
    const VisibleShares shares = sequence.frames().front().visible.value();
    EXPECT_NEAR(shares.seen, 100.0 / 80.0, 1e-9);
    EXPECT_NEAR(shares.noticed.value(), 100.0 / (0.25 * 79.0 + 1.0), 1e-4);
}

constexpr int track_width = 40, track_height = 30;

MotionMaps uniform(float u, float v, float object = 1.0f) {
    return {Image<float>(track_width, track_height, u), Image<float>(track_width, track_height, v),
            Image<float>(track_width, track_height, 1.0f), Image<float>(track_width, track_height, object)};
}

TEST(SurfaceTrack, UniformMotionAddsUp) {
    const MotionMaps maps = uniform(1.25f, 0.5f);
    const std::vector<const MotionMaps*> motion(7, &maps);
    const auto [after, before] = track_surfaces(motion, 3);
    ASSERT_EQ(after.size(), 3u);
    ASSERT_EQ(before.size(), 3u);
    for (int k = 1; k <= 3; ++k) {
        const glm::vec2 next = after[static_cast<std::size_t>(k - 1)](12, 13);
        EXPECT_FLOAT_EQ(next.x, 12.0f + 1.25f * static_cast<float>(k));
        EXPECT_FLOAT_EQ(next.y, 13.0f - 0.5f * static_cast<float>(k)) << "v points upwards";
        const glm::vec2 last = before[static_cast<std::size_t>(k - 1)](12, 13);
        EXPECT_FLOAT_EQ(last.x, 12.0f - 1.25f * static_cast<float>(k));
        EXPECT_FLOAT_EQ(last.y, 13.0f + 0.5f * static_cast<float>(k));
    }
    EXPECT_TRUE(std::isnan(after[2](track_width - 1, 10).x)) << "leaves the picture";
    EXPECT_TRUE(std::isnan(before[2](0, 10).x)) << "was not in the picture";
}

TEST(SurfaceTrack, ZoomAndItsInverseMeet) {
    MotionMaps zoom = uniform(0.0f, 0.0f);
    for (const auto [x, y] : all_pixels(track_width, track_height)) {
        zoom.u(x, y) = 0.1f * static_cast<float>(x - 20);
        zoom.v(x, y) = -0.1f * static_cast<float>(y - 15);
    }
    const std::vector<const MotionMaps*> motion(2, &zoom);
    const glm::vec2 source = track_surfaces(motion, 1).before[0](31, 4);
    EXPECT_NEAR(source.x, 20.0f + 11.0f / 1.1f, 2e-3f);
    EXPECT_NEAR(source.y, 15.0f - 11.0f / 1.1f, 2e-3f);
}

TEST(SurfaceTrack, EndsWhereSomethingElseIsInFront) {
    MotionMaps now = uniform(2.0f, 0.0f), next = uniform(2.0f, 0.0f);
    next.object(14, 10) = 2.0f;
    const std::vector<const MotionMaps*> motion{&now, &next};
    const TrackImage after = track_surfaces(motion, 0).after.at(0);
    EXPECT_TRUE(std::isnan(after(12, 10).x));
    EXPECT_FALSE(std::isnan(after(13, 10).x));
    EXPECT_TRUE(std::isnan(track_surfaces(motion, 1).before.at(0)(14, 10).x)) << "the object in front was not there";
}

TEST(SurfaceTrack, InvalidMotionLeadsNowhere) {
    MotionMaps maps = uniform(1.0f, 0.0f);
    maps.valid(5, 5) = -4.0f;
    const std::vector<const MotionMaps*> motion(2, &maps);
    EXPECT_TRUE(std::isnan(track_surfaces(motion, 0).after.at(0)(5, 5).x));
    EXPECT_TRUE(std::isnan(track_surfaces(motion, 1).before.at(0)(6, 5).x));
}

TEST(SurfaceTrack, MapsWithoutMotionAreAtRest) {
    const MotionMaps maps = read_motion({{{"threshold.Y", Image<float>(3, 2, 1.0f)}}, {}});
    EXPECT_EQ(maps.u.width, 3);
    EXPECT_EQ(maps.v.height, 2);
    EXPECT_EQ(maps.valid(2, 1), 1.0f);
}

}  // namespace
}  // namespace aleph
