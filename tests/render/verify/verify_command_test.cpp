// `aleph render --verify`, and shares with their intervals from counts in blocks.

#include "render/cli/write_frames.h"
#include "render/verify/probe.h"
#include "tests/render/cli/answers.h"
#include "tests/render/expect_fields.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

class VerifyCommand : public RenderCommand {
  protected:
    int run(const std::vector<std::string>& more) {
        return RenderCommand::run({"--size", "8x6", "--fps", "8", "--frames", "8", "-o", file("a.exr")}, more);
    }
};

TEST_F(VerifyCommand, WrongOnesAreRefused) {
    for (const char* text : {"0", "-1", "nan", "inf", "", "8 probes"}) {
        EXPECT_EQ(run({"--verify", text}), exit_bad_input) << text;
        EXPECT_THAT(errors, HasSubstr("--verify"));
        EXPECT_FALSE(fs::exists(file("a.exr"))) << text;
    }
    EXPECT_EQ(run({"--verify", "1", "--integrator", "path"}), exit_bad_input);
    EXPECT_THAT(errors, HasSubstr("give one of the two"));
    EXPECT_FALSE(fs::exists(file("a.exr")));
}

TEST_F(VerifyCommand, PrintsAndKeepsWhatItFound) {
    ASSERT_EQ(run({"--error", "8", "--verify", "0.01", "--stats", file("a.json")}), exit_done) << errors;
    EXPECT_THAT(out, HasSubstr("aleph: verified: "));
    EXPECT_THAT(out, HasSubstr("4 blocks in 1 frame"));
    const auto verified = nlohmann::json::parse(read_bytes(file("a.json"))).at("verified");
    expect_fields(verified, R"({"error": 8, "blocks": 4, "window": 3})");
    EXPECT_LE(verified.at("beyond").at("share"), verified.at("seen").at("share"));
    EXPECT_LE(verified.at("seen").at("low"), verified.at("seen").at("share"));
    EXPECT_TRUE(verified.at("estimated_beyond").is_number());
}

TEST(VerifiedText, HasShareIntervalAndEstimate) {
    VerifiedStatistics verified;
    verified.beyond = verified.seen = {0.008, 0.003, 0.016};
    verified.flicker = {0.002, 0.0, 0.01};
    verified.lasting = {0.005, 0.0, 0.01};
    verified.blocks = 23;
    verified.frames = 12;
    verified.window = 9;
    verified.estimated = 0.009;
    EXPECT_EQ(describe_verified(verified),
              "aleph: verified: 0.8 % of the pixels are seen to differ (95 %: 0.3 to 1.6 %, 23 blocks in 12 frames), "
              "estimated: 0.9 %\n"
              "aleph: verified: 0.2 % flicker, 0.5 % last; by paths of 16 bounces or more, over 9 frames\n");
    verified.unsettled = 1;
    EXPECT_THAT(describe_verified(verified), HasSubstr("in 1 block noise"));
    verified.error = 2.0;
    EXPECT_THAT(describe_verified(verified), HasSubstr("differ by more than 2 visible differences"));
}

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
