// `aleph render --budget`.

#include <nlohmann/json.hpp>

#include "render/cli/budget.h"
#include "tests/render/cli/answers.h"
#include "tests/support/read_bytes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

class Budgets : public RenderCommand {
  protected:
    /// @return the exit code
    int run(const std::vector<std::string>& more) { return RenderCommand::run({"--size", "8x6", "-t", "1"}, more); }
};

TEST_F(Budgets, WrongOnesAreRefused) {
    for (const char* text : {"0", "-1", "nan", "inf", "", "1 s", "1e-400x"}) {
        EXPECT_EQ(run({"--frames", "0", "-o", file("a.exr"), "--budget", text}), exit_bad_input) << text;
        EXPECT_THAT(errors, HasSubstr("--budget"));
        EXPECT_FALSE(fs::exists(file("a.exr"))) << text;
    }
}

TEST_F(Budgets, ChooseTheErrorAlone) {
    for (const Words& beside : {Words{"--error", "1"}, {"--set", "error=1"}, {"--cache", file("light")}}) {
        EXPECT_EQ(run(joined({"--frames", "0", "-o", file("a.exr"), "--budget", "5"}, beside)), exit_bad_input)
            << beside.front();
        EXPECT_THAT(errors, HasSubstr("give one of the two"));
        EXPECT_FALSE(fs::exists(file("a.exr")));
    }
}

TEST_F(Budgets, TheErrorMakesTheSameBytesAgain) {
    for (const char* budget : {"1e-9", "1e9"}) {
        ASSERT_EQ(run({"--frames", "3", "--budget", budget, "-o", file("a.exr"), "--stats", file("a.json")}), exit_done)
            << errors;
        const auto json = nlohmann::json::parse(read_bytes(file("a.json")));
        const double error = json.at("budget").at("error");
        EXPECT_EQ(error, std::string(budget) == "1e9" ? least_budget_error : most_budget_error);
        EXPECT_EQ(json.at("settings").at("error"), error);
        EXPECT_GT(json.at("budget").at("took"), json.at("budget").at("pilot"));
        EXPECT_GT(json.at("budget").at("predicted"), 0.0);
        ASSERT_EQ(run({"--frames", "3", "--error", fmt::format("{:g}", error), "-o", file("b.exr"), "--stats",
                       file("b.json")}),
                  exit_done);
        EXPECT_EQ(read_bytes(file("a.exr")), read_bytes(file("b.exr"))) << error;
        EXPECT_FALSE(nlohmann::json::parse(read_bytes(file("b.json"))).contains("budget"));
    }
}

TEST(BudgetText, SaysWhatWasPredictedAndWhatItTook) {
    BudgetStatistics budget{60.0, 1.3, 55.0, 58.0, 2.1};
    EXPECT_EQ(describe_budget(budget), "aleph: budget 60 s: error 1.3 chosen, predicted 55 s, took 58 s\n");
    EXPECT_THAT(describe_choice(budget), Not(HasSubstr("warning")));
    budget.predicted = 90.0;
    EXPECT_THAT(describe_choice(budget), HasSubstr("predicted to take 90 s"));
}

}  // namespace
}  // namespace aleph
