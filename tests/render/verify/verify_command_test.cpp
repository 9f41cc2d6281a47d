// `aleph render --verify`.

#include <nlohmann/json.hpp>

#include "render/cli/write_frames.h"
#include "tests/render/cli/answers.h"
#include "tests/render/expect_fields.h"
#include "tests/support/read_bytes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

class VerifyCommand : public RenderCommand {
  protected:
    /// @return the exit code
    int run(const std::vector<std::string>& more) {
        return RenderCommand::run({"--size", "8x6", "--fps", "8", "--frames", "20", "-o", file("a.exr")}, more);
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

}  // namespace
}  // namespace aleph
