// Sequences of small pictures with known differences.

#include "render/compare/compare_sequence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/base/errors.h"
#include "tests/support/grey_image.h"

namespace aleph {
namespace {

constexpr int picture_width = 10, picture_height = 8;
constexpr std::size_t pixels = picture_width * picture_height;

ChannelImage grey(float value, int w = picture_width, int h = picture_height) {
    return grey_image(w, h, value);
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
        const FrameComparison comparison = sequence.add(frame, grey(0.5f + step), grey(0.5f), nullptr);
        EXPECT_EQ(comparison.frame, frame);
        EXPECT_EQ(comparison.same, step < 0.15f);
        EXPECT_FALSE(comparison.flicker.has_value());
    }
    const SequenceSummary summary = sequence.summary();
    EXPECT_EQ(summary.frames, 3u);
    EXPECT_EQ(summary.different, 1u);
    EXPECT_EQ(summary.worst_frame, 4);
    EXPECT_NEAR(summary.max_abs, 0.2, 1e-6);
    EXPECT_NEAR(summary.rms, std::sqrt((0.04 + 0.01) / 3.0), 1e-6);
    EXPECT_NEAR(summary.percent(summary.beyond), 100.0 / 3.0, 1e-9);
    EXPECT_FALSE(summary.threshold.has_value());
    EXPECT_FALSE(summary.flicker.has_value());
    EXPECT_FALSE(summary.same());
}

TEST(CompareSequence, ConstantErrorIsSeenButDoesNotFlicker) {
    SequenceComparison sequence({});
    const ChannelImage maps = still_maps();
    for (int frame = 0; frame < 4; ++frame) {
        const FrameComparison comparison = sequence.add(frame, grey(0.53f), grey(0.5f), &maps);  // 3 cd/m2
        EXPECT_EQ(comparison.result.threshold->beyond, pixels);
        EXPECT_EQ(comparison.flicker.has_value(), frame > 0);
        EXPECT_FALSE(comparison.same);
    }
    const SequenceSummary summary = sequence.summary();
    EXPECT_EQ(summary.threshold->pixels, 4 * pixels);
    EXPECT_NEAR(summary.threshold->worst, 3.0, 1e-5);
    EXPECT_NEAR(summary.threshold->percentile_99, 3.0, 0.016);
    EXPECT_EQ(summary.flicker_pairs, 3u);
    EXPECT_EQ(summary.flicker->rest.pixels, 3 * pixels);
    EXPECT_EQ(summary.flicker->rest.worst, 0.0);
    EXPECT_FALSE(summary.flicker->own_threshold);
}

TEST(CompareSequence, ErrorOfAlternatingSignDiffersByItsFlickerAlone) {
    SequenceComparison sequence({});
    const ChannelImage maps = still_maps();
    for (int frame = 0; frame < 3; ++frame) {  // .8 cd/m2 stays below the threshold, its change of 1.6 does not
        const float step = frame % 2 ? -0.008f : 0.008f;
        const FrameComparison comparison = sequence.add(frame, grey(0.5f + step), grey(0.5f), &maps);
        EXPECT_TRUE(comparison.result.same);
        EXPECT_EQ(comparison.same, frame == 0);
    }
    EXPECT_NEAR(sequence.summary().flicker->rest.worst, 1.6, 1e-4);
    EXPECT_EQ(sequence.summary().flicker->percent_beyond(), 100.0);
    EXPECT_EQ(sequence.summary().different, 2u);
}

TEST(CompareSequence, NothingFlickersAcrossGapsAndCuts) {
    SequenceComparison sequence({}, {7});
    const ChannelImage maps = still_maps();
    for (const int frame : {1, 3, 4, 6, 7, 8}) {
        const FrameComparison comparison = sequence.add(frame, grey(0.5f), grey(0.5f), &maps);
        EXPECT_EQ(comparison.flicker.has_value(), frame == 4 || frame == 8) << frame;
    }
    EXPECT_EQ(sequence.summary().flicker_pairs, 2u);
    EXPECT_TRUE(sequence.summary().same());
}

TEST(CompareSequence, OneFrameHasNoFlicker) {
    SequenceComparison sequence({});
    const ChannelImage maps = still_maps();
    EXPECT_TRUE(sequence.add(5, grey(0.5f), grey(0.5f), &maps).same);
    EXPECT_FALSE(sequence.summary().flicker.has_value());
    EXPECT_TRUE(sequence.summary().same());
}

TEST(CompareSequence, MapsWithoutMotionGiveErrorsOnly) {
    SequenceComparison sequence({});
    const ChannelImage maps{{{"threshold.Y", Image<float>(picture_width, picture_height, 1.0f)}}, {}};
    for (int frame = 0; frame < 2; ++frame) sequence.add(frame, grey(0.5f), grey(0.5f), &maps);
    EXPECT_TRUE(sequence.summary().threshold.has_value());
    EXPECT_FALSE(sequence.summary().flicker.has_value());
    const ChannelImage no_threshold{{{"Z", Image<float>(picture_width, picture_height, 1.0f)}}, {}};
    EXPECT_THROW(sequence.add(2, grey(0.5f), grey(0.5f), &no_threshold), InputError);
}

TEST(CompareSequence, NanIsDifferentAndStaysOutOfTheFlicker) {
    SequenceComparison sequence({.share = 100.0});
    const ChannelImage maps = still_maps();
    ChannelImage broken = grey(0.5f);
    broken.channels[1].values(2, 2) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(sequence.add(0, grey(0.5f), grey(0.5f), &maps).same);
    const FrameComparison comparison = sequence.add(1, broken, grey(0.5f), &maps);
    EXPECT_FALSE(comparison.same);
    EXPECT_EQ(comparison.result.threshold->beyond, 1u);
    EXPECT_EQ(comparison.flicker->left_out, 1u);
    EXPECT_EQ(sequence.summary().a.nan, 1u);
}

TEST(CompareSequence, SizesMayNotChangeWithinAShot) {
    SequenceComparison sequence({});
    const ChannelImage maps = still_maps();
    sequence.add(0, grey(0.5f), grey(0.5f), &maps);
    ChannelImage small_maps = maps;
    for (Channel& channel : small_maps.channels) channel.values = Image<float>(4, 4, 1.0f);
    EXPECT_THROW(sequence.add(1, grey(0.5f, 4, 4), grey(0.5f, 4, 4), &small_maps), InputError);
    EXPECT_THROW(SequenceComparison({}).add(0, grey(0.5f), grey(0.5f, 4, 4), nullptr), InputError);
}

}  // namespace
}  // namespace aleph
