// `aleph render --verify`, and shares with their intervals from counts in blocks.

#include <thread>

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

TEST_F(VerifyCommand, ASignalEndsItWithWhatIsMeasured) {
    const std::string scene = (source_folder() / "scenes/cornell/scene.json").string(), log = file("log");
    std::ofstream{log};
    StartedProgram program({"render", scene, "--size", "8x6", "--frames", "8", "--error", "8", "--verify", "1e6", "-o",
                            file("a.exr"), "--stats", file("a.json"), "--progress", "json"},
                           log);
    while (read_bytes(log).find(" block") == std::string::npos)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    program.send(SIGINT);
    expect_answer(program.wait(), 130, "all frames are written, and checked as far as said");
    EXPECT_GE(nlohmann::json::parse(read_bytes(file("a.json"))).at("verified").at("blocks"), 1);
}

TEST_F(VerifyCommand, StrictEndsWithACodeOfItsOwn) {
    EXPECT_EQ(run({"--error", "8", "--strict"}), exit_done) << errors;
    EXPECT_EQ(run({"--error", "0.2", "--spp", "4", "--strict"}), exit_beyond);
    EXPECT_THAT(errors,
                HasSubstr("--strict: in 1 of 1 frames more than 1 % of the pixels err by more than was asked for"));
    EXPECT_TRUE(fs::exists(file("a.exr"))) << "all is written";
    EXPECT_EQ(run({"--error", "0.2", "--spp", "1", "--strict"}), exit_beyond) << "one sample tells nothing";
    EXPECT_EQ(run({"--error", "0.2", "--spp", "1", "--strict", "--verify", "0.01", "-o", file("b.exr")}), exit_beyond);
    EXPECT_THAT(errors, HasSubstr("; measured over all frames: "));
    EXPECT_THAT(out, HasSubstr("aleph: verified: "));
    EXPECT_EQ(run({"--spp", "4", "--strict"}), exit_bad_input);
    EXPECT_THAT(errors, HasSubstr("no error is asked for"));
    EXPECT_EQ(run({"--resume", "--strict"}), exit_bad_input);
    EXPECT_THAT(errors, HasSubstr("--resume: files of frames do not tell"));
}

TEST(VerifiedText, HasShareIntervalAndEstimate) {
    VerifiedStatistics verified;
    verified.beyond = verified.seen = {0.008, 0.003, 0.016};
    verified.flicker = {0.002, 0.0, 0.01};
    verified.lasting = {0.005, 0.0, 0.01};
    verified.blocks = 23;
    verified.frames = 12;
    verified.window = 9;
    verified.estimated = 0.012;
    EXPECT_EQ(describe_verified(verified),
              "aleph: verified: 0.8 % of the pixels are seen to differ (95 %: 0.3 to 1.6 %, 23 blocks in 12 frames), "
              "estimated: about 1.2 %\n"
              "aleph: verified: 0.2 % flicker, 0.5 % last; by paths of 16 bounces or more, over 9 frames\n");
    verified.unsettled = 1;
    verified.estimated = 0.009;
    EXPECT_THAT(describe_verified(verified), AllOf(HasSubstr("in 1 block noise"), HasSubstr("about 1 % or less\n")));
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

TEST(ShareInterval, IsStudentsOfTheBlocksSharesAndOneMore) {
    // Shares .1, .2, .3, .4 and the square root of .4: mean .3265, deviation of the mean .09138, times 2.776. Those not
    // counted, .9, .8, .7, .6 and the square root of .9: mean .7897, deviation of the mean .06387.
    const std::vector<BlockCount> blocks = {{100, 10}, {100, 20}, {100, 30}, {100, 40}};
    const VerifiedShare share = estimate_share(blocks);
    EXPECT_NEAR(share.share, 0.25, 1e-12);
    EXPECT_NEAR(share.low, 1.0 - 0.7897 - 0.1773, 2e-4);
    EXPECT_NEAR(share.high, 0.3265 + 0.2537, 2e-4);
}

TEST(ShareInterval, WeighsBlocksByTheirPixels) {
    const std::vector<BlockCount> blocks = {{300, 30}, {100, 50}};
    EXPECT_NEAR(estimate_share(blocks).share, 0.2, 1e-12);
}

TEST(ShareInterval, WhereNothingWasFoundIsThatOfTheRuleOfThree) {
    for (const std::size_t count : {4, 10, 30, 300}) {
        const VerifiedShare none = estimate_share(std::vector<BlockCount>(count, {256, 0}));
        EXPECT_EQ(none.share, 0.0);
        EXPECT_NEAR(none.low, 0.0, 1e-12);
        EXPECT_NEAR(none.high * static_cast<double>(count), 3.0, 0.07) << count;
        const VerifiedShare all = estimate_share(std::vector<BlockCount>(count, {256, 256}));
        EXPECT_NEAR(all.low, 1.0 - none.high, 1e-12) << "few blocks do not say that it is everywhere";
        EXPECT_EQ(all.high, 1.0);
    }
    EXPECT_EQ(estimate_share(std::vector<BlockCount>(2, {256, 0})).high, 1.0);
}

TEST(ShareInterval, OnePixelThatIsFoundDoesNotSayThatBlocksHaveNoMore) {
    std::vector<BlockCount> blocks(10, {256, 0});
    blocks[3].counted = 1;
    EXPECT_GT(estimate_share(blocks).high, 0.015) << "Student's t alone has .0013";
    EXPECT_LT(estimate_share(blocks).high, estimate_share(std::vector<BlockCount>(10, {256, 0})).high);
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

/// Errors of some blocks, and errors of which a few blocks have most.
TEST(ShareInterval, HoldsTheTrueShareAsOftenAsItSays) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit;
    std::normal_distribution<double> normal;
    const auto expect = [&](const char* what, double truth, const auto& draw) {
        for (const int count : {4, 12, 40}) {
            int held = 0;
            constexpr int trials = 2000;
            for (int trial = 0; trial < trials; ++trial) {
                std::vector<BlockCount> blocks;
                for (int i = 0; i < count; ++i) blocks.push_back({256, std::round(256.0 * draw())});
                const VerifiedShare share = estimate_share(blocks);
                if (share.low <= truth && truth <= share.high) ++held;
            }
            EXPECT_GE(held, 0.95 * trials) << what << ", " << count << " blocks";
        }
    };
    for (const double affected : {1.0, 0.5, 0.2})
        expect("some blocks", 0.2 * affected, [&] { return unit(random) < affected ? 0.4 * unit(random) : 0.0; });
    // The mean of exp(normal(m, s)) is exp(m + s^2 / 2); what is cut at 1 is .0001 of it.
    expect("skewed", std::exp(-5.0 + 0.5), [&] { return std::min(1.0, std::exp(-5.0 + normal(random))); });
    expect("more skewed", 0.0205, [&] { return std::min(1.0, std::exp(-5.0 + 1.5 * normal(random))); });
}

}  // namespace
}  // namespace aleph
