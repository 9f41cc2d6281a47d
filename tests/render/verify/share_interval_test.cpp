// Shares and their intervals from counts in blocks.

#include "render/verify/probe.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(ShareInterval, HasStudentsPercentiles) {
    EXPECT_NEAR(student_95(1), 12.706, 1e-3);
    EXPECT_NEAR(student_95(5), 2.571, 5e-3);
    EXPECT_NEAR(student_95(10), 2.228, 1e-3);
    EXPECT_NEAR(student_95(30), 2.042, 1e-3);
    EXPECT_NEAR(student_95(1000000), 1.960, 1e-3);
}

TEST(ShareInterval, IsStudentsOfTheBlocksShares) {
    // Shares .1, .2, .3, .4: mean .25, standard deviation .1291, of the mean .06455, times 3.182.
    const std::vector<BlockCount> blocks = {{100, 10}, {100, 20}, {100, 30}, {100, 40}};
    const VerifiedShare share = estimate_share(blocks);
    EXPECT_NEAR(share.share, 0.25, 1e-12);
    EXPECT_NEAR(share.low, 0.25 - 0.2054, 1e-3);
    EXPECT_NEAR(share.high, 0.25 + 0.2054, 1e-3);
}

TEST(ShareInterval, WeighsBlocksByTheirPixels) {
    const std::vector<BlockCount> blocks = {{300, 30}, {100, 50}};
    EXPECT_NEAR(estimate_share(blocks).share, 0.2, 1e-12);
}

TEST(ShareInterval, WhereNothingWasFoundIsThatOfTheRuleOfThree) {
    const std::vector<BlockCount> blocks(30, {256, 0});
    const VerifiedShare share = estimate_share(blocks);
    EXPECT_EQ(share.share, 0.0);
    EXPECT_EQ(share.low, 0.0);
    EXPECT_NEAR(share.high, 0.1, 1e-12);
    EXPECT_EQ(estimate_share(std::vector<BlockCount>(2, {256, 0})).high, 1.0);
}

TEST(ShareInterval, WhereAllWasSeenFewBlocksDoNotSayThatItIsEverywhere) {
    EXPECT_NEAR(estimate_share(std::vector<BlockCount>(4, {256, 256})).low, 0.25, 1e-12);
    EXPECT_NEAR(estimate_share(std::vector<BlockCount>(30, {256, 256})).low, 0.9, 1e-12);
    EXPECT_EQ(estimate_share(std::vector<BlockCount>(30, {256, 256})).high, 1.0);
}

TEST(ShareInterval, OfOneBlockOrNoneSaysNothing) {
    for (const std::size_t count : {0u, 1u}) {
        const VerifiedShare share = estimate_share(std::vector<BlockCount>(count, {256, 128}));
        EXPECT_EQ(share.low, 0.0);
        EXPECT_EQ(share.high, 1.0);
    }
}

TEST(ShareInterval, StaysWithinTheShares) {
    const VerifiedShare share = estimate_share(std::vector<BlockCount>{{10, 10}, {10, 0}, {10, 10}});
    EXPECT_GE(share.low, 0.0);
    EXPECT_LE(share.high, 1.0);
}

/// A share of the blocks has errors, in an even share of 0 to .4 of their pixels.
TEST(ShareInterval, HoldsTheTrueShareAboutAsOftenAsItSays) {
    for (const double affected : {1.0, 0.5, 0.2}) {
        for (const int count : {12, 40}) {
            std::mt19937 random(7);
            std::uniform_real_distribution<double> unit;
            int held = 0;
            constexpr int trials = 2000;
            for (int trial = 0; trial < trials; ++trial) {
                std::vector<BlockCount> blocks;
                for (int i = 0; i < count; ++i)
                    blocks.push_back({256, unit(random) < affected ? std::round(256.0 * 0.4 * unit(random)) : 0.0});
                const VerifiedShare share = estimate_share(blocks);
                if (share.low <= 0.2 * affected && 0.2 * affected <= share.high) ++held;
            }
            EXPECT_GE(held, 0.85 * trials) << affected << " of " << count;
        }
    }
}

}  // namespace
}  // namespace aleph
